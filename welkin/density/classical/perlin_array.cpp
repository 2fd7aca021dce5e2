#include "welkin/density/classical/perlin_array.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "welkin/noise/law.hpp"

namespace welkin {

namespace {

// Each value but those at the sides becomes the mean of the 27 round it (001 ch. 5.1.3).
void smoothValues(std::vector<float>& values, int points) {
  const std::size_t n = static_cast<std::size_t>(points), strides[] = {1, n, n * n};
  for (const std::size_t stride : strides) {
    std::vector<float> before = values;
    for (std::size_t i = stride; i + stride < values.size(); ++i)
      values[i] = (before[i - stride] + before[i] + before[i + stride]) / 3.0f;
  }
}

}  // namespace

float interpolated(ArrayInterpolation interpolation, float v0, float v1, float v2, float v3, float x) {
  if (interpolation == ArrayInterpolation::cubic) {
    const float p = (v3 - v2) - (v0 - v1);
    return ((p * x + ((v0 - v1) - p)) * x + (v2 - v0)) * x + v1;
  }
  const float f = interpolation == ArrayInterpolation::linear ? x : 0.5f * (1.0f - std::cos(x * 3.14159265f));
  return v1 * (1.0f - f) + v2 * f;
}

float filteredNoise(float noise, float cover, float sharpness) {
  const float c = 255.0f * (noise - cover);
  return c > 0.0f ? 1.0f - std::pow(sharpness, c) : 0.0f;
}

PerlinArray::PerlinArray(const PerlinArraySettings& settings, std::uint32_t seed) : settings_(settings) {
  float weight = 1.0f, total = 0.0f;
  for (int k = 0; k < settings.octaves; ++k) {
    Array array{(settings.cells << k) + 1, weight, {}};
    const int n = array.points;
    array.values.resize(std::size_t(n) * n * n);
    const auto inside = [&](int i) { return i > 0 && i + 1 < n; };
    const auto forAll = [&](const auto& visit) {
      for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
          for (int x = 0; x < n; ++x)
            visit(array.values[(std::size_t(z) * n + y) * n + x], inside(x) && inside(y) && inside(z), x, y, z);
    };
    forAll([&](float& v, bool in, int x, int y, int z) {
      v = in ? law::unitFromHash(law::hashCell3(x, y, z, seed + static_cast<std::uint32_t>(k))) : 0.0f;
    });
    for (int i = 0; i < settings.smoothing; ++i) {
      smoothValues(array.values, n);
      forAll([](float& v, bool in, int, int, int) { v = in ? v : 0.0f; });
    }
    total += weight;
    weight *= settings.persistence;
    arrays_.push_back(std::move(array));
  }
  for (Array& array : arrays_) array.weight /= total;
}

float PerlinArray::Array::at(int x, int y, int z) const {
  const auto outside = [&](int i) { return i < 0 || i >= points; };
  return outside(x) || outside(y) || outside(z) ? 0.0f : values[(std::size_t(z) * points + y) * points + x];
}

float PerlinArray::octave(const Array& array, const glm::vec3& p) const {
  const float last = static_cast<float>(array.points - 1);
  const glm::vec3 q = glm::clamp(p, 0.0f, 1.0f) * last, low = glm::min(glm::floor(q), glm::vec3(last - 1.0f));
  const glm::ivec3 i(low);
  const glm::vec3 f = q - low;
  const ArrayInterpolation how = settings_.interpolation;
  const int reach = how == ArrayInterpolation::cubic ? 1 : 0;  // neighbours that count beside the two
  const auto along = [&](float x, const auto& value) {
    float v[4] = {};
    for (int k = -reach; k <= 1 + reach; ++k) v[k + 1] = value(k);
    return interpolated(how, v[0], v[1], v[2], v[3], x);
  };
  return along(f.z, [&](int z) {
    return along(f.y, [&](int y) { return along(f.x, [&](int x) { return array.at(i.x + x, i.y + y, i.z + z); }); });
  });
}

float PerlinArray::noise(const glm::vec3& p) const {
  float sum = 0.0f;
  for (const Array& array : arrays_) sum += array.weight * octave(array, p);
  return sum;
}

}  // namespace welkin
