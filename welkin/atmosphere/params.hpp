#pragma once
// From settings to the uniform values of the atmosphere's laws.
#include <glm/vec3.hpp>

#include "welkin/atmosphere/law.hpp"
#include "welkin/atmosphere/settings.hpp"

namespace welkin {

// Irradiance of the sun outside the atmosphere on a plane facing it, klx in linear Rec.709. Its luminance is 128; its
// colour is that of the extraterrestrial spectrum of ASTM G173 (xy .3218 .3311) seen by the CIE 1931 observer.
inline constexpr glm::vec3 kSunIrradiance{139.512f, 125.120f, 122.634f};
inline constexpr double kSunAngularDiameter = 0.533 * 3.14159265358979323846 / 180.0;  // rad
inline constexpr glm::vec3 kDefaultGroundAlbedo{0.13f, 0.15f, 0.08f};

// Luminance of linear Rec.709.
inline float luminance(const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// A light so far away that it comes from one direction everywhere. `irradiance`: outside the atmosphere on a plane that
// faces it, klx in linear Rec.709.
struct FarLight {
  glm::vec3 direction{0.0f, 0.0f, 1.0f};
  glm::vec3 irradiance{0.0f};
};

// What lights the air besides sun and air: the ground, and clouds, which send a share of the light back up; air below
// them is lit by their undersides and sides (albedoRound).
struct AirSurface {
  glm::vec3 ground = kDefaultGroundAlbedo;    // albedo
  float clouds = 0.0f;                        // share of the light of an evenly bright sky that they reflect
  float cloudBottom = 0.0f, cloudTop = 0.0f;  // m

  AirSurface() = default;
  AirSurface(const glm::vec3& albedo) : ground(albedo) {}
};

// What lights a sky.
struct SkyLights {
  FarLight light;        // of clouds, ground and air: the sun, or at night the moon
  FarLight second;       // of the air alone, at dusk; black: there is none
  float airglow = 0.0f;  // of the air itself at the zenith, kcd/m^2
  bool isSun = true;     // whether `light` is seen as the sun's disc

  // The sun alone.
  SkyLights(const glm::vec3& sunDirection) : light{sunDirection, kSunIrradiance} {}
};

// About how bright the sky is that a light makes: kcd/m^2, good to a factor of 2 and smooth through twilight.
double roughSkyLuminance(const FarLight& light);

// Everything that the laws of the air need. Directions are unit vectors, `cameraAltitude` in m above the ground (taken
// as at least 1 m).
law::AtmosphereParams makeAtmosphereParams(const Atmosphere& atmosphere, const SkyLights& lights, double cameraAltitude,
                                           const AirSurface& surface = {});

// Preetham's sky of this turbidity (1.8 to 10). Below the horizon, where the model ends, the sun's sky is that of
// sunset dimmed by 2^(1.1 elevation in degrees), as twilight is. The moon's is the sun's, as much fainter as its light.
law::PreethamParams makePreethamParams(double turbidity, const SkyLights& lights);

law::GradientParams makeGradientParams(const Atmosphere& atmosphere);

}  // namespace welkin
