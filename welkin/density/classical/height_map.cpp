#include "welkin/density/classical/height_map.hpp"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.hpp"
#include "welkin/noise/law.hpp"

namespace welkin {

namespace {

constexpr std::size_t kRows = 32;  // least number of rows for a thread

// Values of n x n squares in [0, 1], row by row. Each is random, but no farther from those to the left and below, and
// from the first of its row and column on the way round the edge, than `step` a square: such bounds always leave room,
// because any two of them do.
std::vector<float> squareValues(int n, float step, std::uint32_t seed) {
  std::vector<float> values(std::size_t(n) * n);
  const auto at = [&](int x, int y) -> float& { return values[std::size_t(y) * n + x]; };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      float low = 0.0f, high = 1.0f;
      const auto near = [&](float value, float reach) {
        low = std::max(low, value - reach);
        high = std::min(high, value + reach);
      };
      if (x > 0) near(at(x - 1, y), step), near(at(0, y), step * static_cast<float>(n - x));
      if (y > 0) near(at(x, y - 1), step), near(at(x, 0), step * static_cast<float>(n - y));
      // Rounding may turn bounds that touch about.
      at(x, y) = std::min(std::max(law::unitFromHash(law::hashCell2(x, y, seed)), low), std::max(low, high));
    }
  return values;
}

// What `times` means over three make of a step from 0 to 1, less the step itself: for the places -times to times - 1
// behind it. Elsewhere nothing changes, and so squares are smoothed where they border on each other only.
std::vector<float> roundedStep(int times) {
  std::vector<double> weights{1.0};
  for (int i = 0; i < times; ++i) {
    std::vector<double> next(weights.size() + 2);
    for (std::size_t k = 0; k < weights.size(); ++k)
      for (std::size_t j = 0; j < 3; ++j) next[k + j] += weights[k] / 3.0;
    weights = std::move(next);
  }
  std::vector<float> difference(2 * std::size_t(times));
  double sum = 0.0;
  for (int k = 0; k < 2 * times; ++k) {
    sum += weights[std::size_t(k)];
    difference[std::size_t(k)] = static_cast<float>(sum - (k < times ? 0.0 : 1.0));
  }
  return difference;
}

// One octave: squares of a side, the last ones cut off by the map's edge.
struct Octave {
  int side, across;
  std::vector<float> values;
  const float* row(int j) const { return values.data() + std::size_t(j) * across; }
};

}  // namespace

float HeightMap::at(double x, double y) const {
  const auto split = [&](double u, int& first, int& second) {
    const double n = size, v = u - 0.5 - n * std::floor((u - 0.5) / n), whole = std::floor(v);
    first = std::min(static_cast<int>(whole), size - 1);
    second = first + 1 == size ? 0 : first + 1;
    return static_cast<float>(v - whole);
  };
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  const float fx = split(x, x0, x1), fy = split(y, y0, y1);
  const auto row = [&](int j) {
    const float* r = heights.data() + std::size_t(j) * size;
    return r[x0] + fx * (r[x1] - r[x0]);
  };
  const float a = row(y0);
  return a + fy * (row(y1) - a);
}

HeightMap bakeHeightMap(const HeightMapSettings& s, std::uint32_t seed) {
  const int n = s.elements, reach = s.smoothing;
  const std::vector<float> rounded = roundedStep(reach);
  std::vector<Octave> octaves;
  for (int k = 0; k < s.octaves; ++k) {
    const int side = std::max(s.squares >> k, 1), across = (n + side - 1) / side;
    Octave octave{side, across, squareValues(across, s.step, seed + static_cast<std::uint32_t>(k))};
    const float share = s.amplitude * std::exp2(-static_cast<float>(k)) / static_cast<float>(s.octaves);
    for (float& v : octave.values) v *= share;
    octaves.push_back(std::move(octave));
  }
  // Calls visit(i, left, place) for every border between squares i - 1 (`left`, round the edge) and i that is within
  // reach of u: `place` is where in `rounded`.
  const auto forBorders = [&](const Octave& o, int u, const auto& visit) {
    for (int around = -1; around <= 1; ++around) {
      const int v = u - around * n;
      const int first = std::max((v - reach + o.side) / o.side, 0), last = std::min((v + reach) / o.side, o.across - 1);
      if (v + reach < 0) continue;
      for (int i = first; i <= last; ++i)
        if (const int place = v - i * o.side + reach; place >= 0 && place < 2 * reach)
          visit(i, i > 0 ? i - 1 : o.across - 1, static_cast<std::size_t>(place));
    }
  };
  HeightMap map{n, std::vector<float>(std::size_t(n) * n)};
  parallelFor(std::size_t(n), kRows, [&](std::size_t begin, std::size_t end) {
    std::vector<float> line, wide(std::size_t(n) + 2 * std::size_t(reach));
    for (int y = int(begin); y < int(end); ++y) {
      std::fill(wide.begin(), wide.end(), 0.0f);
      float* row = wide.data() + reach;
      for (const Octave& o : octaves) {
        line.assign(o.row(y / o.side), o.row(y / o.side) + o.across);
        forBorders(o, y, [&](int j, int below, std::size_t place) {
          for (int i = 0; i < o.across; ++i) line[std::size_t(i)] += rounded[place] * (o.row(j)[i] - o.row(below)[i]);
        });
        for (int i = 0; i < o.across; ++i) {
          const float value = line[std::size_t(i)];
          const int first = i * o.side, stop = std::min(first + o.side, n);
          for (int x = first; x < stop; ++x) row[x] += value;
          const float jump = value - line[std::size_t(i > 0 ? i - 1 : o.across - 1)];
          for (int k = 0; k < 2 * reach; ++k) row[first + k - reach] += jump * rounded[static_cast<std::size_t>(k)];
        }
      }
      // What lies beyond the ends belongs to the other side.
      for (int k = 1; k <= reach; ++k) row[n - k] += row[-k];
      for (int k = 0; k < reach; ++k) row[k] += row[n + k];
      std::copy_n(row, n, map.heights.data() + std::size_t(y) * n);
    }
  });
  return map;
}

float heightOfCover(const HeightMap& map, float cover) {
  if (cover >= 1.0f) return 0.0f;
  std::vector<float> heights = map.heights;
  const auto at =
      heights.begin() + static_cast<std::ptrdiff_t>((1.0 - cover) * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

}  // namespace welkin
