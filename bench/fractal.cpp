// Area-perimeter dimension of cumulus fields seen from above (Lovejoy 1982: P ~ A^(D/2), D = 1.35 +- 0.05 for clouds
// and rain of 1 to 10^6 km^2). The default preset's layer over a square of land, as vertical optical depth in square
// pixels; cloudy where that exceeds kCloudy. Clouds are what hangs together by sides of pixels; those that touch the
// border are left out. A: pixels; P: sides between cloud and clear air, holes included. D is twice the slope of log P
// over log A, least squares over the clouds of all seeds from kLeastPixels on, where pixels no longer round an outline
// off. Discs (D = 1) and Koch's snowflakes (D = log 4 / log 3) go through the same ruler. `bench_fractal --help` tells
// how to look at other skies and scales.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "bench/harness.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/field.hpp"
#include "welkin/density/weather_map.hpp"
#include "welkin/io/sky_file.hpp"

namespace welkin {
namespace {

constexpr double kStep = 10.0;             // m, along the columns
constexpr double kCloudy = 0.3;            // vertical optical depth, as `welkin info` counts cover
constexpr double kThick = 5.0;             // another one: how much D hangs on it
constexpr std::size_t kLeastPixels = 128;  // area; discs from there on have D = 1.00

struct Options {
  std::string sky = WELKIN_SOURCE_DIR "/presets/cumulus.sky.toml";
  int seeds = 4, across = 1536;  // pixels of an edge
  double pixel = 20.0;           // m
};

struct Picture {
  int across;
  std::vector<float> values;
  float at(int x, int y) const { return values[static_cast<std::size_t>(y) * across + x]; }
};

struct Outline {
  double area = 0.0, perimeter = 0.0;  // pixels, sides
};

// Of everything above the threshold that hangs together and does not touch the border.
std::vector<Outline> outlinesOf(const Picture& picture, float threshold) {
  const int n = picture.across;
  const auto cloudy = [&](int x, int y) { return picture.at(x, y) > threshold; };
  std::vector<char> seen(picture.values.size());
  std::vector<Outline> outlines;
  std::vector<std::pair<int, int>> open;
  for (int y0 = 0; y0 < n; ++y0)
    for (int x0 = 0; x0 < n; ++x0) {
      if (seen[static_cast<std::size_t>(y0) * n + x0] || !cloudy(x0, y0)) continue;
      Outline outline;
      bool whole = true;
      const auto visit = [&](int x, int y) {
        char& here = seen[static_cast<std::size_t>(y) * n + x];
        if (!here) open.emplace_back(x, y);
        here = 1;
      };
      visit(x0, y0);
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        outline.area += 1.0;
        for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
          const int i = x + dx, j = y + dy;
          if (i < 0 || j < 0 || i >= n || j >= n)
            whole = false;
          else if (cloudy(i, j))
            visit(i, j);
          else
            outline.perimeter += 1.0;
        }
      }
      if (whole) outlines.push_back(outline);
    }
  return outlines;
}

// Twice the slope of log P over log A; NaN for fewer than two sizes.
double dimensionOf(const std::vector<Outline>& outlines, double least, double most = 1e300) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Outline& o : outlines) {
    if (o.area < least || o.area >= most) continue;
    const double a = std::log(o.area), p = std::log(o.perimeter);
    n += 1.0, x += a, y += p, xx += a * a, xy += a * p;
  }
  return 2.0 * (n * xy - x * y) / (n * xx - x * x);
}

// The clouds of every seed.
using Skies = std::vector<std::vector<Outline>>;

std::vector<Outline> pooled(const Skies& skies, std::size_t leftOut) {
  std::vector<Outline> all;
  for (std::size_t i = 0; i < skies.size(); ++i)
    if (i != leftOut) all.insert(all.end(), skies[i].begin(), skies[i].end());
  return all;
}

// Of the clouds of all seeds together; its standard error by leaving out one seed after another (jackknife).
struct Estimate {
  double dimension = 0.0, error = 0.0;

  explicit Estimate(const Skies& skies) : dimension(dimensionOf(pooled(skies, skies.size()), kLeastPixels)) {
    const double n = static_cast<double>(skies.size());
    std::vector<double> without;
    double mean = 0.0;
    for (std::size_t i = 0; i < skies.size(); ++i) {
      without.push_back(dimensionOf(pooled(skies, i), kLeastPixels));
      mean += without.back() / n;
    }
    for (const double d : without) error += (d - mean) * (d - mean);
    error = std::sqrt(error * (n - 1.0) / n);
  }
};

// Polygons whose radius grows by a fifth, each alone in a picture; filled by the even-odd rule along rows.
template <class PolygonOf>
double dimensionOfShapes(const PolygonOf& polygonOf) {
  std::vector<Outline> all;
  for (double radius = 7.0; radius < 600.0; radius *= 1.2) {
    const int n = 2 * static_cast<int>(1.3 * radius) + 8;
    Picture picture{n, std::vector<float>(static_cast<std::size_t>(n) * n)};
    const std::vector<std::complex<double>> corners = polygonOf(radius);
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      // No corner stands on the middle of a row.
      const std::complex<double> a = corners[i] + std::complex(0.5 * n, 0.5 * n + 0.1234567);
      const std::complex<double> b = corners[(i + 1) % corners.size()] + std::complex(0.5 * n, 0.5 * n + 0.1234567);
      const double low = std::min(a.imag(), b.imag()), high = std::max(a.imag(), b.imag());
      for (int y = static_cast<int>(std::ceil(low - 0.5)); y + 0.5 < high; ++y)
        crossings[static_cast<std::size_t>(y)].push_back(a.real() + (y + 0.5 - a.imag()) / (b.imag() - a.imag()) *
                                                                        (b.real() - a.real()));
    }
    for (int y = 0; y < n; ++y) {
      std::vector<double>& row = crossings[static_cast<std::size_t>(y)];
      std::sort(row.begin(), row.end());
      for (std::size_t i = 0; i + 1 < row.size(); i += 2)
        for (int x = static_cast<int>(std::ceil(row[i] - 0.5)); x + 0.5 < row[i + 1]; ++x)
          picture.values[static_cast<std::size_t>(y) * n + x] = 1.0f;
    }
    // What hangs on it by corners of pixels only is not counted.
    const std::vector<Outline> outlines = outlinesOf(picture, 0.5f);
    all.push_back(*std::max_element(outlines.begin(), outlines.end(),
                                    [](const Outline& a, const Outline& b) { return a.area < b.area; }));
  }
  return dimensionOf(all, kLeastPixels);
}

std::vector<std::complex<double>> disc(double radius) {
  std::vector<std::complex<double>> corners;
  for (int i = 0; i < 2000; ++i) corners.push_back(std::polar(radius, i * std::numbers::pi / 1000.0));
  return corners;
}

// Down to sides of half a pixel.
std::vector<std::complex<double>> snowflake(double radius) {
  std::vector<std::complex<double>> corners;
  for (int i = 0; i < 3; ++i) corners.push_back(std::polar(radius, 0.2 + 2.0 * std::numbers::pi * i / 3.0));
  const std::complex<double> turn = std::polar(1.0, -std::numbers::pi / 3.0);
  for (double side = radius * std::numbers::sqrt3; side > 0.5; side /= 3.0) {
    std::vector<std::complex<double>> finer;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::complex<double> a = corners[i], third = (corners[(i + 1) % corners.size()] - a) / 3.0;
      finer.insert(finer.end(), {a, a + third, a + third + third * turn, a + 2.0 * third});
    }
    corners = std::move(finer);
  }
  return corners;
}

// Where a layer of shape "profile" can hold cloud, in squares of kSquare: the greatest height in reach of each, m above
// the base, or nothing. Looking there alone is six times as fast as looking everywhere.
class Reach {
 public:
  Reach(const Layer& layer, const Drift& drift, int seed, double edge)
      : across_(static_cast<int>(std::ceil(edge / kSquare)) + 2 * kMargin) {
    const Volume weather = bakeWeather(layer, glm::dvec2(0.0), kSquare * across_, across_, drift, seed);
    const double sideways = 0.5 * layer.profile.warp + std::abs(layer.cloud.shear) + 2.0 * kSquare;
    const int far = std::min(static_cast<int>(std::ceil(sideways / kSquare)), kMargin);
    // The greatest along x, then along y.
    std::vector<float> rows(weather.texels.size() / 4);
    heights_.resize(rows.size());
    const auto greatest = [&](const auto& at, int i) {
      float most = 0.0f;
      for (int k = std::max(i - far, 0); k <= std::min(i + far, across_ - 1); ++k) most = std::max(most, at(k));
      return most;
    };
    for (int y = 0; y < across_; ++y)
      for (int x = 0; x < across_; ++x) rows[index(x, y)] = greatest([&](int k) { return weather.at(k, y, 0)[0]; }, x);
    for (int y = 0; y < across_; ++y)
      for (int x = 0; x < across_; ++x) heights_[index(x, y)] = greatest([&](int k) { return rows[index(x, k)]; }, y);
  }
  float height(const glm::dvec2& place) const {
    const glm::ivec2 i(glm::floor(place / kSquare + 0.5 * across_));
    return heights_[index(i.x, i.y)];
  }

 private:
  static constexpr double kSquare = 40.0;  // m
  static constexpr int kMargin = 32;
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * across_ + x; }
  int across_;
  std::vector<float> heights_;
};

// Vertical optical depth over places, midpoints of steps of kStep.
std::vector<float> opticalDepths(const DensityField& field, const Reach& reach, std::span<const glm::dvec2> places) {
  const Layer& layer = field.layers().front();
  const ProfileSettings& p = layer.profile;
  const double low = layer.cloud.base - p.baseVariation - 2.0 * p.baseRagged;
  std::vector<glm::dvec3> points;
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float height = reach.height(places[i]);
    if (height <= 0.0f) continue;
    const double high = layer.cloud.base + p.baseVariation + height + p.fineDetail;
    for (double z = low + 0.5 * kStep; z < high; z += kStep) {
      points.emplace_back(places[i], z);
      owners.push_back(i);
    }
  }
  std::vector<double> sums(places.size());
  const std::vector<float> sigma = field.layerExtinction(0, points);
  for (std::size_t k = 0; k < points.size(); ++k) sums[owners[k]] += kStep * sigma[k];
  return {sums.begin(), sums.end()};
}

Picture opticalDepths(const Scene& scene, int seed, const Options& options) {
  const Drift drift{scene.wind.speed, scene.wind.from, scene.time};
  const DensityField field({.layers = scene.layers, .noise = scene.noise, .drift = drift, .seed = seed});
  const int across = options.across;
  const Reach reach(field.layers().front(), drift, seed, options.pixel * across);
  Picture picture{across, {}};
  std::vector<glm::dvec2> row(static_cast<std::size_t>(across));
  double whole = 0.0, missed = 0.0;
  for (int y = 0; y < across; ++y) {
    for (int x = 0; x < across; ++x)
      row[static_cast<std::size_t>(x)] = options.pixel * (glm::dvec2(x, y) + 0.5 - 0.5 * across);
    const std::vector<float> depths = opticalDepths(field, reach, row);
    picture.values.insert(picture.values.end(), depths.begin(), depths.end());
    // Now and then the whole shell is looked through.
    if (y % 256 != 100) continue;
    const std::vector<CloudColumn> columns = field.columns(0, row, kStep);
    for (std::size_t x = 0; x < row.size(); ++x) {
      whole += columns[x].opticalDepth > kCloudy;
      missed += columns[x].opticalDepth > kCloudy && depths[x] == 0.0f;
    }
  }
  if (missed > 0.005 * whole)
    throw Error(ErrorKind::failed, options.sky, "cloud stands where the weather has none: the search is wrong for it");
  return picture;
}

// Every second pixel: the same land at half the resolution.
Picture halved(const Picture& picture) {
  Picture half{picture.across / 2, {}};
  for (int y = 0; y < half.across; ++y)
    for (int x = 0; x < half.across; ++x) half.values.push_back(picture.at(2 * x, 2 * y));
  return half;
}

void run(const Options& options) {
  const double discs = dimensionOfShapes(disc), flakes = dimensionOfShapes(snowflake);
  fmt::print("the ruler: discs {:.3f}, Koch's snowflakes {:.3f} (1.262)\n", discs, flakes);
  std::fflush(stdout);
  const Scene scene = loadSky(options.sky);
  if (scene.layers.empty() || scene.layers.front().cloud.shape != LayerShape::profile)
    throw Error(ErrorKind::badInput, options.sky, "the first layer must be of shape profile");
  Skies plain, thick, coarse;
  double share = 0.0;
  const double cpu = bench::cpuSeconds();
  for (int seed = 1; seed <= options.seeds; ++seed) {
    const Picture picture = opticalDepths(scene, seed, options);
    for (const float tau : picture.values) share += tau > kCloudy;
    plain.push_back(outlinesOf(picture, kCloudy));
    thick.push_back(outlinesOf(picture, kThick));
    coarse.push_back(outlinesOf(halved(picture), kCloudy));
    fmt::print("seed {}: D {:.3f}\n", seed, dimensionOf(plain.back(), kLeastPixels));
    std::fflush(stdout);
  }
  const std::vector<Outline> all = pooled(plain, plain.size());
  share /= options.seeds * double(options.across) * options.across;
  fmt::print("clouds by size, all seeds; \"slope\" is D from these clouds alone\n{:>12} {:>7} {:>10} {:>6}\n",
             "root A, m", "clouds", "P/sqrt A", "slope");
  double largest = 0.0;
  std::size_t clouds = 0;
  for (const Outline& o : all) {
    largest = std::max(largest, o.area);
    clouds += o.area >= kLeastPixels;
  }
  for (double low = 8.0; low < largest; low *= 4.0) {
    std::size_t count = 0;
    double ratio = 0.0;
    for (const Outline& o : all)
      if (o.area >= low && o.area < 4.0 * low) {
        ++count;
        ratio += o.perimeter / std::sqrt(o.area);
      }
    if (count > 2)
      fmt::print("{:>5.0f} - {:<4.0f} {:>7} {:>10.2f} {:>6.2f}\n", options.pixel * std::sqrt(low),
                 2.0 * options.pixel * std::sqrt(low), count, ratio / double(count), dimensionOf(all, low, 4.0 * low));
  }
  const Estimate d(plain), dThick(thick), dCoarse(coarse);
  fmt::print(
      "{{\"bench\": \"fractal\", \"dimension\": {:.4f}, \"standard_error\": {:.4f}, "
      "\"abs_difference_from_1_35\": {:.4f}, \"dimension_thick\": {:.4f}, \"dimension_half_resolution\": {:.4f}, "
      "\"clouds\": {}, \"smallest_m\": {:.0f}, \"largest_m\": {:.0f}, \"cover\": {:.3f}, \"discs\": {:.4f}, "
      "\"snowflakes\": {:.4f}, \"cpu_s\": {:.1f}}}\n",
      d.dimension, d.error, std::abs(d.dimension - 1.35), dThick.dimension, dCoarse.dimension, clouds,
      options.pixel * std::sqrt(double(kLeastPixels)), options.pixel * std::sqrt(largest), share, discs, flakes,
      bench::cpuSeconds() - cpu);
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  welkin::Options options;
  CLI::App app("area-perimeter dimension of cumulus fields");
  app.add_option("--sky", options.sky, "its first layer is looked at")->capture_default_str();
  app.add_option("--seeds", options.seeds, "skies of the preset")->check(CLI::Range(2, 1000))->capture_default_str();
  app.add_option("--across", options.across, "pixels of an edge")->check(CLI::Range(64, 16384))->capture_default_str();
  app.add_option("--pixel", options.pixel, "its edge in metres")->check(CLI::Range(1.0, 1000.0))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    welkin::run(options);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_fractal: {}\n", e.what());
    return 1;
  }
}
