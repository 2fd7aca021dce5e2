#pragma once
// Plain values that describe the sun and the sky.
#include <glm/vec3.hpp>
#include <string>

#include "welkin/base/fields.hpp"

namespace welkin {

inline constexpr Unit kHours{"h", 3600.0};

// How the sun's place in the sky is given: by its angles, or by date, time and place on Earth.
enum class SunMode { angles, place };
template <>
struct ChoiceNames<SunMode> {
  static constexpr std::array<std::string_view, 2> names{"angles", "place"};
};

struct Sun {
  SunMode mode = SunMode::angles;
  float elevation = 0.7f;           // rad
  float azimuth = 1.92f;            // rad, compass
  std::string date = "2026-06-21";  // year-month-day, Gregorian
  std::string time = "12:00:00";    // civil time
  float utcOffset = 0.0f;           // s, civil time less universal time
  float latitude = 0.8727f;         // rad, north
  float longitude = 0.2531f;        // rad, east
};
template <>
struct FieldTable<Sun> {
  static auto make() {
    return fieldRows(
        field<&Sun::mode>("mode", "angles takes elevation and azimuth, place computes them from date, time and place"),
        field<&Sun::elevation, kDegrees>("elevation", {-90, 90}, {-10, 90}, "angle above the horizon"),
        field<&Sun::azimuth, kDegrees>("azimuth", {0, 360}, {}, "compass heading toward the sun"),
        field<&Sun::date>("date", "for place: \"2026-06-21\""),
        field<&Sun::time>("time", "for place: civil time, \"18:30\" or \"18:30:00\""),
        field<&Sun::utcOffset, kHours>("utc_offset", {-14, 14}, {}, "for place: civil time minus universal time"),
        field<&Sun::latitude, kDegrees>("latitude", {-90, 90}, {}, "for place: north is positive"),
        field<&Sun::longitude, kDegrees>("longitude", {-180, 180}, {}, "for place: east is positive"));
  }
};

// How the moon's place and phase are given: by the sun's date, time and place where the sun has them, and no moon where
// it stands by angles; by angles of its own; or no moon at all.
enum class MoonMode { automatic, angles, off };
template <>
struct ChoiceNames<MoonMode> {
  static constexpr std::array<std::string_view, 3> names{"automatic", "angles", "off"};
};

struct Moon {
  MoonMode mode = MoonMode::automatic;
  float elevation = 0.6109f;  // rad
  float azimuth = 3.1416f;    // rad, compass
  float phase = 1.0f;
  float brightness = 1.0f;
};
template <>
struct FieldTable<Moon> {
  static auto make() {
    return fieldRows(
        field<&Moon::mode>("mode",
                           "automatic computes place and phase from the sun's date, time and place, and shows no moon "
                           "when the sun's mode is angles; angles takes the values below; off shows none"),
        field<&Moon::elevation, kDegrees>("elevation", {-90, 90}, {-10, 90}, "for angles: angle above the horizon"),
        field<&Moon::azimuth, kDegrees>("azimuth", {0, 360}, {}, "for angles: compass heading toward the moon"),
        field<&Moon::phase>("phase", {0, 1}, {}, "for angles: share of the disc that is lit, 0.5 is half a moon"),
        field<&Moon::brightness>("brightness", {0, 1000}, {0, 10}, "its light as a multiple, 1 is real"));
  }
};

// What shines at night besides the moon.
struct Night {
  float stars = 1.0f;
  float milkyWay = 1.0f;
  float airglow = 1.0f;
  float siderealTime = 61200.0f;  // s: 17 h, when the Milky Way stands high in northern summer
};
template <>
struct FieldTable<Night> {
  static auto make() {
    return fieldRows(
        field<&Night::stars>("stars", {0, 1000}, {0, 10}, "light of the stars as a multiple, 0 shows none"),
        field<&Night::milkyWay>("milky_way", {0, 1000}, {0, 10}, "light of the Milky Way as a multiple"),
        field<&Night::airglow>("airglow", {0, 1000}, {0, 10}, "the air's own faint light as a multiple"),
        field<&Night::siderealTime, kHours>("sidereal_time", {0, 24}, {},
                                            "turn of the stars when the sun's mode is angles; its latitude counts"));
  }
};

// physical: scattering by air (Hillaire 2020). preetham: Preetham, Shirley and Smits 1999. gradient: two shades.
enum class SkyKind { physical, preetham, gradient };
template <>
struct ChoiceNames<SkyKind> {
  static constexpr std::array<std::string_view, 3> names{"physical", "preetham", "gradient"};
};

// What the three channels of the air's coefficients stand for. rec709: what the spectra of scattering and absorption do
// to sunlight seen through the Rec.709 primaries. hillaire: the published values at 680, 550 and 440 nm, taken for
// primaries as they are; skies come out more saturated and twilight purple.
enum class AirCoefficients { rec709, hillaire };
template <>
struct ChoiceNames<AirCoefficients> {
  static constexpr std::array<std::string_view, 2> names{"rec709", "hillaire"};
};

struct Atmosphere {
  SkyKind model = SkyKind::physical;
  AirCoefficients coefficients = AirCoefficients::rec709;
  float rayleigh = 1.0f;
  float mie = 1.0f;
  float mieG = 0.8f;
  float ozone = 1.0f;
  float haze = 0.0f;          // 1/m
  float hazeHeight = 300.0f;  // m
  float turbidity = 3.0f;
  glm::vec3 gradientHorizon{4.0f, 5.5f, 8.0f};  // kcd/m^2
  glm::vec3 gradientZenith{0.5f, 1.4f, 4.5f};   // kcd/m^2
  glm::vec3 gradientGlow{12.0f, 10.5f, 8.5f};   // kcd/m^2
  float gradientGlowExponent = 60.0f;
};
template <>
struct FieldTable<Atmosphere> {
  static auto make() {
    return fieldRows(
        field<&Atmosphere::model>("model",
                                  "what the sky is painted with; the light of the sun and the air in front of "
                                  "clouds are physical with every model"),
        field<&Atmosphere::coefficients>("coefficients",
                                         "rec709 is fitted to spectra seen through the picture's primaries; hillaire "
                                         "takes three wavelengths as published: twilight turns purple"),
        field<&Atmosphere::rayleigh>("rayleigh", {0, 20}, {0, 4}, "amount of air molecules, 1 is Earth"),
        field<&Atmosphere::mie>("mie", {0, 100}, {0, 12}, "amount of aerosol: 1 very clear, 4 usual, 12 hazy"),
        field<&Atmosphere::mieG>("mie_g", {-0.95, 0.95}, {0.5, 0.9}, "mean cosine of scattering by aerosol"),
        field<&Atmosphere::ozone>("ozone", {0, 20}, {0, 4}, "amount of ozone, 1 is Earth: blue at dusk"),
        field<&Atmosphere::haze, kPerMetre>("haze", {0, 0.05}, {0, 0.001},
                                            "extinction at the ground of a low haze; visibility is about 3.9 / haze"),
        field<&Atmosphere::hazeHeight, kMetres>("haze_height", {20, 5000}, {50, 1500},
                                                "height over which the haze falls to 0.37"),
        field<&Atmosphere::turbidity>("turbidity", {1.8, 10}, {2, 8}, "for preetham: 2 clear, 6 hazy"),
        field<&Atmosphere::gradientHorizon>("gradient_horizon", {0, 1000}, {0, 20},
                                            "for gradient: colour at the horizon in kcd/m^2"),
        field<&Atmosphere::gradientZenith>("gradient_zenith", {0, 1000}, {0, 20},
                                           "for gradient: colour overhead in kcd/m^2"),
        field<&Atmosphere::gradientGlow>("gradient_glow", {0, 10000}, {0, 100},
                                         "for gradient: glow round the sun in kcd/m^2"),
        field<&Atmosphere::gradientGlowExponent>("gradient_glow_exponent", {1, 10000}, {4, 1000},
                                                 "for gradient: narrowness of the glow"));
  }
};

}  // namespace welkin
