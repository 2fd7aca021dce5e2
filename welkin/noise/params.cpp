#include "welkin/noise/params.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/noise/bake.hpp"

namespace welkin {

namespace {

template <class T>
void check(const T& settings) {
  for (const Field& field : fieldsOf<T>()) {
    FieldValue value = field.get(&settings);
    if (const std::string wrong = checkField(field, value); !wrong.empty())
      throw Error(ErrorKind::badInput, "", std::string("noise: ") + field.name + " " + wrong);
  }
}

// Seeds that differ by one share no octaves.
std::uint32_t scattered(int seed) { return law::hashUint(static_cast<std::uint32_t>(seed)); }

struct Weights {
  float low, mid, high, top;
};
Weights normalised(float low, float mid, float high) {
  const float sum = low + mid + high;
  if (sum <= 0)
    throw Error(ErrorKind::badInput, "", "noise: low_weight, mid_weight and high_weight are all 0; raise one of them");
  return {low / sum, mid / sum, high / sum, low + mid > 0 ? low / (low + mid) : 0.5f};
}

// 4096 texel centres of a size^3 tile, spread by the additive recurrence of the root of x^4 = x + 1 (M. Roberts 2018).
std::vector<glm::vec3> spreadTexels(int size) {
  std::vector<glm::vec3> points(4096);
  constexpr double kRoot = 1.2207440846057596;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double x = 0.5 + static_cast<double>(i) * std::pow(kRoot, -(axis + 1));
      const auto texel = std::min(static_cast<int>((x - std::floor(x)) * size), size - 1);
      points[i][axis] = (static_cast<float>(texel) + 0.5f) / static_cast<float>(size);
    }
  return points;
}

struct Stretch {
  float low, scale;
};
float quantile(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
std::vector<float> channel(const std::vector<glm::vec2>& raw, int c) {
  std::vector<float> values(raw.size());
  std::transform(raw.begin(), raw.end(), values.begin(), [c](const glm::vec2& v) { return v[c]; });
  return values;
}
// From the 2 % and 98 % quantiles to 0 and 1.
Stretch stretchOf(const std::vector<glm::vec2>& raw, int c) {
  std::vector<float> values = channel(raw, c);
  const float low = quantile(values, 0.02), high = quantile(values, 0.98);
  return {low, 1.0f / std::max(high - low, 1e-6f)};
}
// The same, but from the mean to 1/2 and with the wider side of the two.
Stretch centredStretchOf(const std::vector<glm::vec2>& raw, int c) {
  std::vector<float> values = channel(raw, c);
  double sum = 0;
  for (const float v : values) sum += v;
  const auto mean = static_cast<float>(sum / static_cast<double>(values.size()));
  const float reach = std::max({mean - quantile(values, 0.02), quantile(values, 0.98) - mean, 1e-6f});
  return {mean - reach, 0.5f / reach};
}
template <class Params>
void apply(const Stretch& r, const Stretch& g, Params& p) {
  p.lowR = r.low;
  p.scaleR = r.scale;
  p.lowG = g.low;
  p.scaleG = g.scale;
}

}  // namespace

law::BaseShapeParams baseShapeParams(const BaseShapeSettings& s) {
  check(s);
  const Weights w = normalised(s.lowWeight, s.midWeight, s.highWeight);
  law::BaseShapeParams p{};
  p.perlinCells = s.perlinFrequency;
  p.perlinOctaves = s.perlinOctaves;
  p.perlinGain = s.perlinGain;
  p.worleyCells = s.worleyCells;
  p.lowWeight = w.low;
  p.midWeight = w.mid;
  p.highWeight = w.high;
  p.topWeight = w.top;
  p.combination = static_cast<int>(s.combination);
  p.inverseGamma = 1.0f / s.gamma;
  p.seed = scattered(s.seed);
  return p;
}

law::DetailParams detailParams(const DetailSettings& s) {
  check(s);
  const Weights w = normalised(s.lowWeight, s.midWeight, s.highWeight);
  law::DetailParams p{};
  p.worleyCells = s.worleyCells;
  p.lowWeight = w.low;
  p.midWeight = w.mid;
  p.highWeight = w.high;
  p.topWeight = w.top;
  p.inverseGamma = 1.0f / s.gamma;
  p.seed = scattered(s.seed);
  return p;
}

law::CurlParams curlParams(const CurlSettings& s) {
  check(s);
  law::CurlParams p{};
  p.cells = s.frequency;
  p.octaves = s.octaves;
  p.gain = s.gain;
  p.amplitude = s.amplitude;
  p.seed = scattered(s.seed);
  return p;
}

law::ProfileBaseParams profileBaseParams(const ProfileNoiseSettings& s, float billowMix) {
  check(s);
  law::ProfileBaseParams p{};
  p.perlinCells = s.perlinFrequency;
  p.perlinOctaves = s.perlinOctaves;
  p.perlinGain = s.gain;
  p.billowCells = s.billowCells;
  p.billowOctaves = s.billowOctaves;
  p.billowGain = s.gain;
  p.seed = scattered(s.seed);
  p.billowMix = billowMix;
  const auto raw = bake::measureProfileBase(p, spreadTexels(s.baseSize));
  apply(stretchOf(raw, 0), stretchOf(raw, 1), p);
  return p;
}

law::ProfileDetailParams profileDetailParams(const ProfileNoiseSettings& s) {
  check(s);
  law::ProfileDetailParams p{};
  p.cells = s.detailCells;
  p.octaves = s.detailOctaves;
  p.gain = s.gain;
  p.ridgeSlope = s.ridgeSlope;
  p.seed = scattered(s.seed) + 0x3C6EF372u;
  const auto raw = bake::measureProfileDetail(p, spreadTexels(s.detailSize));
  apply(stretchOf(raw, 0), stretchOf(raw, 1), p);
  return p;
}

law::ProfileWarpParams profileWarpParams(const ProfileNoiseSettings& s) {
  check(s);
  law::ProfileWarpParams p{};
  p.cells = s.warpFrequency;
  p.octaves = s.warpOctaves;
  p.gain = s.gain;
  p.seed = scattered(s.seed) + 0x78DDE6E4u;
  const auto raw = bake::measureProfileWarp(p, spreadTexels(s.warpSize));
  apply(centredStretchOf(raw, 0), centredStretchOf(raw, 1), p);
  return p;
}

}  // namespace welkin
