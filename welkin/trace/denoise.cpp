#include "welkin/trace/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"

namespace welkin::trace {

namespace {

constexpr int kSearch = 9, kPatch = 1;  // half the sides of window and patch, in pixels
// What makes a unit of distance: these many standard errors of a difference of luminance or transmittance, this
// difference of the logarithm of the depth. Chosen by the least relMSE of the default sky with 32 paths.
constexpr float kLightScale = 0.7f, kEdgeScale = 2.0f, kDepthScale = 0.1f;
constexpr float kFarthest = 8.0f;  // weights are 0 from this distance on
constexpr int kBand = 16;          // rows that one thread filters at a time

float squared(float x) { return x * x; }

// A channel with a margin of zeros, so that windows may reach over the border.
class Plane {
 public:
  Plane(int width, int height, int margin)
      : margin_(margin), stride_(width + 2 * margin),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * margin)) {}

  float* row(int y) { return values_.data() + static_cast<std::ptrdiff_t>(y + margin_) * stride_ + margin_; }
  const float* row(int y) const {
    return values_.data() + static_cast<std::ptrdiff_t>(y + margin_) * stride_ + margin_;
  }

 private:
  int margin_, stride_;
  std::vector<float> values_;
};

// What the filter reads of every pixel.
struct Planes {
  int width, height;
  Plane present;  // 1 where there are samples, 0 elsewhere and in the margin
  Plane red, green, blue;
  Plane luminance, variance;  // variance of the luminance
  Plane transmittance, transmittanceVariance;
  Plane logDepth;

  Planes(int w, int h, int m)
      : width(w), height(h), present(w, h, m), red(w, h, m), green(w, h, m), blue(w, h, m), luminance(w, h, m),
        variance(w, h, m), transmittance(w, h, m), transmittanceVariance(w, h, m), logDepth(w, h, m) {}
};

Planes planesOf(const TraceLayers& layers) {
  Planes p(layers.radiance.width, layers.radiance.height, kSearch + kPatch);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const float n = *layers.samples.at(x, y);
      if (n < 1.0f) continue;
      const float* c = layers.radiance.at(x, y);
      p.present.row(y)[x] = 1.0f;
      p.red.row(y)[x] = c[0];
      p.green.row(y)[x] = c[1];
      p.blue.row(y)[x] = c[2];
      p.luminance.row(y)[x] = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
      p.variance.row(y)[x] = *layers.variance.at(x, y);
      // A share of n paths; with one more of either kind, so that 0 and 1 of a few paths are not certain.
      const float clear = *layers.transmittance.at(x, y), likely = (clear * n + 1.0f) / (n + 2.0f);
      p.transmittance.row(y)[x] = clear;
      p.transmittanceVariance.row(y)[x] = likely * (1.0f - likely) / n;
      p.logDepth.row(y)[x] = std::log(std::max(*layers.depth.at(x, y), 1.0f));
    }
  return p;
}

// A few paths that found the sun make a pixel far brighter than its neighbours, and its variance tells: the excess is
// about one standard error of a pixel with one such path, two with four. A pixel that exceeds, by less than two of its
// standard errors, what all but two of its eight neighbours may be (their luminance and two standard errors) is taken
// for one that looks like the third of them: taken for as bright as it may be, it would be like none of them, and stay
// a speck. Two, because such pixels come in pairs. What is bright for certain, like the sun's disc, stays. Where they
// are to be spread this is for the weights alone: the mean is taken of what was traced, so that no light is lost.
void dimOutliers(Planes& p, Outliers outliers) {
  const Planes from = p;
  parallelFor(static_cast<std::size_t>(p.height), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < p.width; ++x) {
        std::array<std::pair<float, float>, 8> limits{};  // luminance, variance
        int count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, p.height - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, p.width - 1); ++u)
            if ((u != x || v != y) && from.present.row(v)[u] > 0.0f) {
              const float variance = from.variance.row(v)[u];
              limits[static_cast<std::size_t>(count++)] = {from.luminance.row(v)[u] + 2.0f * std::sqrt(variance),
                                                           variance};
            }
        if (count < 3) continue;
        const int rank = count < 8 ? 1 : 2;
        std::partial_sort(limits.begin(), limits.begin() + rank + 1, limits.begin() + count, std::greater<>());
        const auto [limit, variance] = limits[static_cast<std::size_t>(rank)];
        const float excess = p.luminance.row(y)[x] - limit;
        if (excess <= 0.0f || squared(excess) >= 4.0f * p.variance.row(y)[x]) continue;
        const float dimmed = limit - 2.0f * std::sqrt(variance);
        if (outliers == Outliers::dimmed)
          for (Plane* colour : {&p.red, &p.green, &p.blue}) colour->row(y)[x] *= dimmed / p.luminance.row(y)[x];
        p.luminance.row(y)[x] = dimmed;
        p.variance.row(y)[x] = variance;
      }
  });
}

// The estimates of the variance are noisy themselves, and 0 where a few samples happen to agree: their mean over 5 x 5
// pixels. 0 stays where all of them are 0.
void smoothVariance(Planes& p) {
  const Plane from = p.variance;
  parallelFor(static_cast<std::size_t>(p.height), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < p.width; ++x) {
        if (p.present.row(y)[x] <= 0.0f) continue;
        float sum = 0.0f, count = 0.0f;
        for (int v = y - 2; v <= y + 2; ++v)
          for (int u = x - 2; u <= x + 2; ++u) {
            sum += from.row(v)[u];  // 0 in the margin and without samples
            count += p.present.row(v)[u];
          }
        p.variance.row(y)[x] = sum / count;
      }
  });
}

// Squared difference of two values less what their variances make of it, in units of `scale` standard errors.
float distance(float a, float b, float variance, float scale) {
  constexpr float kLeast = 1e-20f;  // of a variance, so that equal values without any have the distance 0
  return (squared(a - b) - variance) / (squared(scale) * variance + kLeast);
}

// Distances of the pixels of row y, from x = -kPatch on, to those `dx`, `dy` away; 0 where one of them is absent.
void rowDistances(const Planes& p, int y, int dx, int dy, std::vector<float>& out) {
  const auto here = [&](const Plane& plane) { return plane.row(y) - kPatch; };
  const auto there = [&](const Plane& plane) { return plane.row(y + dy) + dx - kPatch; };
  const float *present = here(p.present), *presentThere = there(p.present);
  const float *l = here(p.luminance), *lq = there(p.luminance), *lv = here(p.variance), *lvq = there(p.variance);
  const float *t = here(p.transmittance), *tq = there(p.transmittance);
  const float *tv = here(p.transmittanceVariance), *tvq = there(p.transmittanceVariance);
  const float *z = here(p.logDepth), *zq = there(p.logDepth);
  for (std::size_t x = 0; x < out.size(); ++x) {
    const float opacity = 1.0f - std::max(t[x], tq[x]);  // clear sky has no depth
    const float all = distance(l[x], lq[x], lv[x] + lvq[x], kLightScale) +
                      distance(t[x], tq[x], tv[x] + tvq[x], kEdgeScale) +
                      opacity * squared((z[x] - zq[x]) / kDepthScale);
    out[x] = present[x] * presentThere[x] * all;
  }
}

// Weighted sums of one row, and the greatest weight.
struct RowSums {
  std::vector<float> red, green, blue, weight, greatest;
  explicit RowSums(std::size_t width) : red(width), green(width), blue(width), weight(width), greatest(width) {}
};

// How much a pixel so far away can weigh: a window without edges, or what is spread would stand in squares.
float windowOf(int dx, int dy) {
  const float share = static_cast<float>(dx * dx + dy * dy) / static_cast<float>((kSearch + 1) * (kSearch + 1));
  return squared(std::max(1.0f - share, 0.0f));
}

// Adds to each pixel of row y the one `dx`, `dy` away, not itself. `distances` are those of the rows from y - kPatch to
// y + kPatch.
void addNeighbours(const Planes& p, int y, int dx, int dy, const std::vector<float>* distances, RowSums& sums) {
  const float window = windowOf(dx, dy);
  constexpr int kSide = 2 * kPatch + 1;
  const auto there = [&](const Plane& plane) { return plane.row(y + dy) + dx; };
  const float *present = there(p.present), *r = there(p.red), *g = there(p.green), *b = there(p.blue);
  for (std::size_t x = 0; x < sums.weight.size(); ++x) {
    float sum = 0.0f;
    for (int row = 0; row < kSide; ++row)
      for (std::size_t column = 0; column < kSide; ++column) sum += distances[row][x + column];
    // exp(-d) to .07 and never negative: (1 - d/8)^8.
    const float d = std::clamp(sum / static_cast<float>(kSide * kSide), 0.0f, kFarthest);
    const float near = squared(squared(squared(1.0f - d / kFarthest))) * window * present[x];
    sums.red[x] += near * r[x];
    sums.green[x] += near * g[x];
    sums.blue[x] += near * b[x];
    sums.weight[x] += near;
    sums.greatest[x] = std::max(sums.greatest[x], near);
  }
}

// Rows [begin, end) of `out`.
void filterBand(const Planes& p, int begin, int end, Image& out) {
  const auto width = static_cast<std::size_t>(p.width), rows = static_cast<std::size_t>(end - begin);
  std::vector<std::vector<float>> distances(rows + 2 * kPatch, std::vector<float>(width + 2 * kPatch));
  std::vector<RowSums> sums(rows, RowSums(width));
  for (int dy = -kSearch; dy <= kSearch; ++dy)
    for (int dx = -kSearch; dx <= kSearch; ++dx) {
      if ((dx == 0 && dy == 0) || windowOf(dx, dy) <= 0.0f) continue;
      for (std::size_t i = 0; i < distances.size(); ++i)
        rowDistances(p, begin + static_cast<int>(i) - kPatch, dx, dy, distances[i]);
      for (std::size_t i = 0; i < rows; ++i)
        addNeighbours(p, begin + static_cast<int>(i), dx, dy, &distances[i], sums[i]);
    }
  for (std::size_t i = 0; i < rows; ++i) {
    const int y = begin + static_cast<int>(i);
    for (std::size_t x = 0; x < width; ++x) {
      if (p.variance.row(y)[x] <= 0.0f) continue;
      // A pixel is like itself, noise included. It weighs no more than the one most like it, or what is like none of
      // the others would keep its noise.
      const float own = std::max(sums[i].greatest[x], 1e-6f);
      const float all = sums[i].weight[x] + own;
      float* to = out.at(static_cast<int>(x), y);
      to[0] = (sums[i].red[x] + own * p.red.row(y)[x]) / all;
      to[1] = (sums[i].green[x] + own * p.green.row(y)[x]) / all;
      to[2] = (sums[i].blue[x] + own * p.blue.row(y)[x]) / all;
    }
  }
}

}  // namespace

Image denoise(const TraceLayers& layers, Outliers outliers) {
  for (const Image* layer : {&layers.variance, &layers.transmittance, &layers.depth, &layers.samples})
    if (layer->width != layers.radiance.width || layer->height != layers.radiance.height || layer->channels != 1 ||
        layers.radiance.channels != 3)
      throw Error(
          ErrorKind::badInput, "",
          "a picture can be denoised only with a variance, transmittance, depth and sample count of each pixel");
  Image out = layers.radiance;
  if (out.pixels.empty()) return out;
  Planes p = planesOf(layers);
  dimOutliers(p, outliers);
  smoothVariance(p);
  const auto bands = static_cast<std::size_t>((p.height + kBand - 1) / kBand);
  parallelFor(bands, 1, [&](std::size_t first, std::size_t last) {
    for (auto band = static_cast<int>(first); band < static_cast<int>(last); ++band)
      filterBand(p, band * kBand, std::min((band + 1) * kBand, p.height), out);
  });
  return out;
}

}  // namespace welkin::trace
