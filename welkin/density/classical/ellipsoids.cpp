#include "welkin/density/classical/ellipsoids.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/density/hero_shape.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/noise/law.hpp"

namespace welkin {

namespace {
constexpr float kSoft = 0.25f;  // of the texture, over which the density rises; by choice
}  // namespace

float spectralTexture(const glm::vec3& p, int octaves, float contrast, float phase) {
  // Each factor is 1 + the sum over its amplitude at most; the phase of each octave hangs on the octave before along
  // the other axis (Gardner's PX = pi/2 sin(FY Y / 2)), on the height, and on a constant that tells clouds apart.
  float sumX = 0.0f, sumY = 0.0f, amplitude = 1.0f, total = 0.0f, f = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    const float own = phase * static_cast<float>(i + 1);
    const float shiftX = 0.5f * kPiFloat * std::sin(0.5f * f * p.y + own) + kPiFloat * std::sin(0.5f * f * p.z);
    const float shiftY =
        0.5f * kPiFloat * std::sin(0.5f * f * p.x - own) + kPiFloat * std::sin(0.5f * f * p.z + 0.5f * kPiFloat);
    sumX += amplitude * std::sin(f * p.x + shiftX + own);
    sumY += amplitude * std::sin(f * p.y + shiftY - own);
    total += amplitude;
    amplitude *= contrast;
    f *= 2.0f;
  }
  return 0.25f * (1.0f + sumX / total) * (1.0f + sumY / total);
}

TexturedEllipsoids::TexturedEllipsoids(const EllipsoidSettings& settings, const glm::vec3& size, std::uint32_t seed)
    : settings_(settings), ellipsoids_(makeEllipsoids(settings.count, size, seed)), waves_(settings.frequency / size.x),
      seed_(seed) {
  HeroDice dice(seed ^ 0x9E3779B9u);
  phase_ = dice(0.0f, 2.0f * kPiFloat);
}

float TexturedEllipsoids::texture(const glm::vec3& p) const {
  if (settings_.texture == EllipsoidTexture::spectral)
    // The square root evens out the product's many small values.
    return std::sqrt(spectralTexture(p * (2.0f * kPiFloat * waves_), settings_.octaves, settings_.contrast, phase_));
  const float n = law::perlinFbm3(p * (2.0f * waves_), 0, settings_.octaves, 2, settings_.contrast, seed_);
  return std::clamp(0.5f + 1.2f * n, 0.0f, 1.0f);
}

float TexturedEllipsoids::density(const glm::vec3& p) const {
  float least = 2.0f;  // squared share of the way to a surface
  for (const Ellipsoid& e : ellipsoids_) {
    const glm::vec3 d = (p - e.centre) / e.axes;
    least = std::min(least, glm::dot(d, d));
  }
  if (least >= 1.0f) return 0.0f;
  const float threshold = settings_.middle + (settings_.rim - settings_.middle) * least;
  // At the rim nothing is left, whatever its threshold.
  return std::clamp((texture(p) - threshold) / kSoft, 0.0f, 1.0f) * std::min(5.0f * (1.0f - least), 1.0f);
}

}  // namespace welkin
