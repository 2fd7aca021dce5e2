#pragma once
// From linear light to 8-bit pictures; the curves are the law in tone.glsl.
#include <cstdint>
#include <vector>

#include "welkin/base/fields.hpp"
#include "welkin/base/image.hpp"
#include "welkin/base/law_tone.hpp"

namespace welkin {

enum class ToneCurve { agx, aces, filmic, none };
template <>
struct ChoiceNames<ToneCurve> {
  static constexpr std::array<std::string_view, 4> names{"agx", "aces", "filmic", "none"};
};

struct ToneSettings {
  float ev = 14.6f;              // EV100, compensation taken off
  float whiteBalance = 6504.0f;  // K
  float saturation = 1.0f;
  ToneCurve curve = ToneCurve::agx;
};

// What the law needs. Light of luminance 1.2 * 2^ev cd/m^2 exposes the film to 1 (Lagarde and de Rousiers 2014, 4.1.2:
// saturation-based sensitivity with a lens of 65 %).
law::ToneParameters toneParameters(const ToneSettings& settings);

// The matrix, applied to linear Rec.709, that turns light of a colour temperature (K) into D65 (Bradford adaptation).
glm::mat3 whiteBalanceMatrix(double kelvin);

// The EV100 at which a meter calibrated to 12.5 cd/m^2 would expose the picture (kcd/m^2): log-average luminance of all
// but the darkest 5 % and brightest 10 %, so that neither a sun nor a black border sways it. Below 1 cd/m^2 the picture
// is left darker, as the eye sees the night: by up to 2.4 stops (the key of Krawczyk, Myszkowski and Seidel 2005, eq.
// 11). Pixels that are not finite or not positive are left out; 15 when none remain.
double automaticEv(const Image& light);

// Tone-mapped to sRGB values in [0, 1]; channels as in displayBytes. NaN becomes black.
Image displayValues(const Image& light, const ToneSettings& settings);

// The same as rows of bytes, dithered by half a step from a hash of the pixel. 1 or 2 channels count as grey
// (and alpha), a last channel of 2 or 4 is alpha; it is not tone-mapped.
std::vector<std::uint8_t> displayBytes(const Image& light, const ToneSettings& settings);

}  // namespace welkin
