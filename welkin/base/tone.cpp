#include "welkin/base/tone.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

#include "welkin/base/parallel.hpp"

namespace welkin {

namespace {

using glm::dmat3, glm::dvec3;

struct Chromaticity {
  double x, y;
};

// CIE D series, 4000 K and up (CIE 15:2004, eq. 3.3).
Chromaticity daylight(double t) {
  const double u = 1e3 / t;
  const double x = t <= 7000 ? ((-4.6070 * u + 2.9678) * u + 0.09911) * u + 0.244063
                             : ((-2.0064 * u + 1.9018) * u + 0.24748) * u + 0.237040;
  return {x, (-3.0 * x + 2.870) * x - 0.275};
}

// Black body, 1667 K to 4000 K (Kim et al., US patent 7024034, 2002).
Chromaticity blackBody(double t) {
  const double u = 1e3 / t;
  const double x = ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910;
  const double y = t < 2222 ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                            : ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
  return {x, y};
}

// Below 4000 K the black body, moved by its distance to the daylight locus there, so that a slider does not jump.
Chromaticity whiteOf(double t) {
  if (t >= 4000) return daylight(t);
  const Chromaticity body = blackBody(t), from = blackBody(4000), to = daylight(4000);
  return {body.x + to.x - from.x, body.y + to.y - from.y};
}

dvec3 xyzOf(const Chromaticity& c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

std::uint32_t hash(std::uint32_t x) {
  x = x * 747796405u + 2891336453u;
  x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
  return (x >> 22) ^ x;
}

std::uint8_t quantise(float value, std::uint32_t random) {
  const float dither = static_cast<float>(random >> 8) * 0x1p-24f - 0.5f;
  const float step = std::floor(value * 255.0f + 0.5f + dither);
  return step >= 0.0f ? static_cast<std::uint8_t>(std::min(step, 255.0f)) : std::uint8_t{0};  // NaN becomes black
}

}  // namespace

glm::mat3 whiteBalanceMatrix(double kelvin) {
  // Columns first. Linear Rec.709 to XYZ, and Bradford's cones.
  const dmat3 xyzFromRgb(0.4123908, 0.2126390, 0.0193308, 0.3575843, 0.7151687, 0.1191948, 0.1804808, 0.0721923,
                         0.9505322);
  const dmat3 conesFromXyz(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  const dvec3 from = conesFromXyz * xyzOf(whiteOf(kelvin)), to = conesFromXyz * xyzOf(whiteOf(6504));
  dmat3 gain(1.0);
  for (int i = 0; i < 3; ++i) gain[i][i] = to[i] / from[i];
  const dmat3 conesFromRgb = conesFromXyz * xyzFromRgb;
  return glm::mat3(glm::inverse(conesFromRgb) * gain * conesFromRgb);
}

law::ToneParameters toneParameters(const ToneSettings& settings) {
  const glm::mat3 m = whiteBalanceMatrix(settings.whiteBalance);
  law::ToneParameters p{};
  p.balanceR = {m[0][0], m[1][0], m[2][0], 0.0f};
  p.balanceG = {m[0][1], m[1][1], m[2][1], 0.0f};
  p.balanceB = {m[0][2], m[1][2], m[2][2], 0.0f};
  p.exposure = static_cast<float>(1000.0 / (1.2 * std::exp2(settings.ev)));
  p.saturation = settings.saturation;
  p.curve = static_cast<int>(settings.curve);
  return p;
}

namespace {

// How many stops darker than a meter wants it a night of this luminance (cd/m^2) is shown.
double nightStops(double luminance) {
  const auto key = [](double y) { return 1.03 - 2.0 / (2.0 + std::log10(y + 1.0)); };
  return std::log2(key(1.0) / key(std::min(luminance, 1.0)));
}

}  // namespace

double automaticEv(const Image& light) {
  std::vector<float> logs;
  const std::size_t count = static_cast<std::size_t>(light.width) * light.height;
  logs.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* c = light.pixels.data() + i * light.channels;
    const float y = light.channels < 3 ? c[0] : law::luminanceOf({c[0], c[1], c[2]});
    if (std::isfinite(y) && y > 0) logs.push_back(std::log2(y));
  }
  if (logs.empty()) return 15.0;
  std::sort(logs.begin(), logs.end());
  const std::size_t begin = logs.size() / 20, end = std::max(begin + 1, logs.size() - logs.size() / 10);
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += logs[i];
  const double mean = sum / static_cast<double>(end - begin);
  return mean + std::log2(1000.0 * 100.0 / 12.5) + nightStops(1000.0 * std::exp2(mean));
}

Image displayValues(const Image& light, const ToneSettings& settings) {
  const law::ToneParameters parameters = toneParameters(settings);
  const int channels = light.channels, colours = channels < 3 ? 1 : 3;
  Image out(light.width, light.height, channels);
  parallelFor(static_cast<std::size_t>(light.height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * light.width; i < end * light.width; ++i) {
      const float* c = light.pixels.data() + i * channels;
      const glm::vec3 shown = law::toneMap(colours == 1 ? glm::vec3(c[0]) : glm::vec3(c[0], c[1], c[2]), parameters);
      for (int k = 0; k < channels; ++k) {
        const float value = k < colours ? shown[k] : c[k];
        out.pixels[i * channels + k] = value >= 0.0f ? std::min(value, 1.0f) : 0.0f;
      }
    }
  });
  return out;
}

std::vector<std::uint8_t> displayBytes(const Image& light, const ToneSettings& settings) {
  const Image shown = displayValues(light, settings);
  std::vector<std::uint8_t> bytes(shown.pixels.size());
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint32_t random = hash(static_cast<std::uint32_t>(i / light.channels));
    for (int k = 0; k < light.channels; ++k, ++i, random = hash(random)) bytes[i] = quantise(shown.pixels[i], random);
  }
  return bytes;
}

}  // namespace welkin
