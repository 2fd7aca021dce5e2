#include "welkin/trace/path_tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <utility>

#include "welkin/atmosphere/params.hpp"
#include "welkin/atmosphere/moon.hpp"
#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/scene/rain.hpp"
#include "welkin/scene/scatterers.hpp"
#include "welkin/scene/surface.hpp"

namespace welkin::trace {

namespace {

constexpr int kTile = 16;
constexpr int kFirstSamples = 16;     // before the first estimate of a tile's noise
constexpr double kMiddleGrey = 0.18;  // luminance, white = 1
constexpr std::size_t kGroup = 32;    // tiles between two looks at the clock
constexpr float kAureole = 2.0f;      // 1/sr, where the forward peak ends: 25 times isotropic scattering

// Largest extinction of the air in each step of altitude; beyond the last there is none.
std::vector<float> airBounds(const law::AtmosphereParams& air) {
  std::vector<float> bounds(static_cast<std::size_t>(air.thickness / kAirStep) + 2, 0.0f);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    // Molecules and aerosol are densest at the lower edge, ozone at its middle or the nearest edge; a metre of slack.
    const float low = std::max(static_cast<float>(i) * kAirStep - 1.0f, 0.0f), high = low + kAirStep + 2.0f;
    const glm::vec3 bottom = law::airDensity(air, low);
    // A step may climb by kAirClimb or half of its altitude.
    const float climbed = high + std::max(kAirClimb, 0.51f * high);
    const float middle = law::airDensity(air, std::clamp(air.ozoneHeight, low, climbed)).z;
    const glm::vec3 sigma =
        glm::vec3(air.rayleigh) * bottom.x + glm::vec3(air.mieExtinction) * bottom.y + glm::vec3(air.ozone) * middle;
    bounds[i] = 1.0001f * std::max({sigma.x, sigma.y, sigma.z});
  }
  return bounds;
}

}  // namespace

struct PathTracer::Totals {
  double radiance[3] = {}, single[3] = {}, square = 0, clear = 0, depth = 0;

  double luminance() const { return 0.2126 * radiance[0] + 0.7152 * radiance[1] + 0.0722 * radiance[2]; }
};

struct PathTracer::Baked {
  CloudCache clouds;
  SkyTablesCpu sky;
  std::vector<PhaseTable> phases;
  SkyDistribution skyLight;
  KernelScene kernel;

  int phaseOf(PhaseTable table) {
    phases.push_back(std::move(table));
    return static_cast<int>(phases.size()) - 1;
  }
};

PathTracer::PathTracer(const Scene& scene, const TraceInputs& inputs, const TraceSettings& settings)
    : baked_(std::make_unique<Baked>()), settings_(settings),
      seed_(static_cast<std::uint32_t>(scene.seed) + 0x9e3779b9u * static_cast<std::uint32_t>(settings.frame)) {
  if (settings.width < 1 || settings.height < 1 || settings.samples < 1)
    throw Error(ErrorKind::badInput, "", "a traced picture needs at least one pixel and one sample");
  Baked& b = *baked_;
  const glm::dvec3 eye = scene.camera.position;
  b.clouds = bakeCloudCache({.layers = scene.layers,
                             .sheets = scene.sheets,
                             .noise = scene.noise,
                             .drift = {scene.wind.speed, scene.wind.from, scene.time},
                             .seed = scene.seed,
                             .grids = inputs.grids,
                             .classical = scene.classical,
                             .heroes = scene.heroes,
                             .weatherMaps = inputs.weatherMaps},
                            {}, eye, settings.clouds);
  KernelScene& k = b.kernel;
  k.planet = planetParams(eye);
  const Heavens heavens = heavensOf(scene.sun, scene.moon, scene.night);
  b.sky = bakeSky(scene.atmosphere, heavens.lights, std::max(k.planet.altitude, 0.0f), airSurface(scene), inputs.sky);
  k.clouds = &b.clouds;
  k.air = b.sky.params.air;
  k.airScatters = settings.air == AirModel::medium && scene.atmosphere.model == SkyKind::physical && !inputs.sky;
  k.airBounds = airBounds(k.air);
  k.transmittance = b.sky.air.transmittance.view();
  k.skyView = b.sky.skyView.view();
  k.aerialInscatter = b.sky.aerialInscatter.view();
  k.aerialTransmittance = b.sky.aerialTransmittance.view();
  if (!k.airScatters) {
    b.skyLight = SkyDistribution([&](const glm::vec3& way) { return luminance(law::lookupSky(k.skyView, k.air, way)); },
                                 luminance(glm::vec3(k.air.sunIrradiance)));
    k.sky = b.skyLight.view();
  }
  for (const Layer& layer : scene.layers)
    k.components.push_back({layer.cloud.albedo, b.phaseOf(PhaseTable::mie(phaseOf(layer.cloud)))});
  for (const Sheet& sheet : scene.sheets) {
    const bool water = sheet.kind == SheetKind::altocumulus;
    k.components.push_back({1.0f, b.phaseOf(water ? PhaseTable::mie(phaseOf(CloudLayer{}))
                                                  : PhaseTable::henyeyGreenstein(law::kIceAsymmetry))});
    // sheetOpticalDepth is at most 1.4 times the sheet's own.
    k.sheetBounds.push_back(1.4001f * sheet.opticalDepth / kSheetThickness);
  }
  // Named grids only: those without a file are no clouds.
  std::vector<GridCloud> named;
  for (const GridCloud& grid : scene.grids)
    if (!grid.file.empty()) named.push_back(grid);
  named.resize(inputs.grids.size());
  for (const GridCloud& grid : named) k.components.push_back({grid.albedo, b.phaseOf(PhaseTable::mie(phaseOf(grid)))});
  for (const Classical& cloud : scene.classical)
    k.components.push_back({cloud.cloud.albedo, b.phaseOf(PhaseTable::mie(phaseOf(cloud.cloud)))});
  for (const Hero& hero : scene.heroes)
    k.components.push_back({hero.cloud.albedo, b.phaseOf(PhaseTable::mie(phaseOf(hero.cloud)))});
  const float freezing = freezingLevel(scene.precipitation);
  for (std::size_t i = 0; i < scene.layers.size(); ++i)
    for (const bool snow : {false, true}) {
      const Layer& layer = scene.layers[i];
      const bool occurs =
          snow ? law::snowShare(rainTop(layer), freezing) > 0.0f : law::snowShare(0.0f, freezing) < 1.0f;
      if (!occurs || !rains(scene, layer)) continue;
      k.rain.push_back({i, snow, rainParams(scene, layer), rainTop(layer), rainBound(scene, layer)});
      k.components.push_back(
          {1.0f, b.phaseOf(PhaseTable::henyeyGreenstein(snow ? law::kSnowAsymmetry : law::kRainAsymmetry))});
    }
  k.aerosolPhase = b.phaseOf(PhaseTable::henyeyGreenstein(scene.atmosphere.mieG));
  for (const PhaseTable& table : b.phases) k.phases.push_back(table.view());
  if (!k.components.empty()) {
    const PhaseTable& table = b.phases[static_cast<std::size_t>(k.components.front().phase)];
    float low = 0.01f, high = 1.0f;
    for (int i = 0; i < 20; ++i) {
      const float middle = 0.5f * (low + high);
      (table.evaluate(table.sample(middle).versine) > kAureole ? low : high) = middle;
    }
    k.aureoleShare = low;
    k.aureole = table.sample(low).versine;
  }

  k.camera = cameraParams(scene.camera, static_cast<double>(settings.width) / settings.height);
  k.sunDisc = settings.sunDisc == SunDisc::seen;
  k.night = heavens.night;
  k.moonShows = heavens.moonShows;
  k.starsShow = heavens.starsShow;
  k.glows = heavens.lights.airglow > 1e-6 * roughSkyLuminance(heavens.lights.light);
  const double half = scene.camera.projection == Projection::equirectangular
                          ? static_cast<double>(k.camera.angles.z)
                          : static_cast<double>(glm::length(glm::vec3(k.camera.right)));
  // A pixel's samples spread over it and widen the spots of stars by themselves.
  k.pixelAngle = static_cast<float>(0.7 * 2.0 * half / settings.width);
  if (settings.scatterings > 0) k.mostScatterings = static_cast<float>(settings.scatterings);

  totals_.resize(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
  tilesAcross_ = (settings.width + kTile - 1) / kTile;
  for (int y = 0; y < settings.height; y += kTile)
    for (int x = 0; x < settings.width; x += kTile)
      tiles_.push_back({x, y, std::min(kTile, settings.width - x), std::min(kTile, settings.height - y)});
}

PathTracer::~PathTracer() = default;

double PathTracer::meanOf(const Tile& tile) const {
  double sum = 0.0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      sum += totals_[static_cast<std::size_t>(y) * settings_.width + x].luminance();
    }
  return sum / (static_cast<double>(tile.width) * tile.height * std::max(tile.samples, 1));
}

double PathTracer::sampleVarianceOf(const Tile& tile) const {
  double sum = 0.0;
  const double n = tile.samples;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const Totals& t = totals_[static_cast<std::size_t>(y) * settings_.width + x];
      const double mean = t.luminance() / n;
      sum += std::max(t.square / n - mean * mean, 0.0) * n / (n - 1.0);
    }
  return sum / (static_cast<double>(tile.width) * tile.height);
}

double PathTracer::errorOf(const Tile& tile, double sampleVariance) const {
  const double mean = meanOf(tile);
  if (mean <= 0.0) return 0.0;
  // d sqrt(x) = dx / (2 sqrt(x)) for luminance x as a share of white.
  return 0.5 * std::sqrt(sampleVariance / tile.samples * kMiddleGrey / (grey_ * mean));
}

// Plans from whole rounds only, so that a picture taken up again ends as one that was never interrupted.
bool PathTracer::planRound() {
  const bool first = tiles_.front().samples == 0;
  const bool adaptive = settings_.noise > 0.0 && !first;
  std::vector<double> variances;
  if (adaptive) {
    std::vector<double> means;
    for (const Tile& tile : tiles_) {
      means.push_back(meanOf(tile));
      variances.push_back(sampleVarianceOf(tile));
    }
    if (grey_ == 0.0) {
      const auto middle = means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2);
      std::nth_element(means.begin(), middle, means.end());
      // Half of the picture may be black.
      grey_ = *middle > 0.0 ? *middle : std::max(*std::max_element(middle, means.end()), 1e-30);
    }
  }
  bool any = false;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    const int left = settings_.samples - tile.samples;
    if (left <= 0) continue;
    int samples = kFirstSamples;
    if (adaptive) {
      double variance = variances[i];
      if (tile.samples == kFirstSamples) {
        // Where the rare bright paths have not come yet, a tile looks finished; its neighbours know better.
        const int across = tilesAcross_, down = static_cast<int>(tiles_.size()) / across;
        const int column = static_cast<int>(i) % across, row = static_cast<int>(i) / across;
        double sum = 0.0, count = 0.0;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, down - 1); ++y)
          for (int x = std::max(column - 1, 0); x <= std::min(column + 1, across - 1); ++x, ++count)
            sum += variances[static_cast<std::size_t>(y) * across + x];
        variance = std::max(variance, sum / count);
      }
      const double share = errorOf(tile, variance) / settings_.noise;
      // The error falls with the root of the samples. Never more than there are already: the estimate is noisy itself.
      samples = share <= 1.0 ? 0
                             : static_cast<int>(std::clamp(std::ceil(tile.samples * (share * share - 1.0)), 4.0,
                                                           static_cast<double>(tile.samples)));
    }
    tile.planned = std::min(left, samples);
    any = any || tile.planned > 0;
  }
  return any;
}

void PathTracer::traceTile(Tile& tile) {
  std::vector<PixelSums> sums(static_cast<std::size_t>(tile.width) * tile.height, PixelSums{});
  const TileJob job{tile.x,           tile.y,       tile.width,   tile.height, settings_.width,
                    settings_.height, tile.samples, tile.planned, seed_};
  const KernelStatistics found = trace::traceTile(baked_->kernel, job, sums);
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      const PixelSums& from = sums[static_cast<std::size_t>(y) * tile.width + x];
      Totals& to = totals_[static_cast<std::size_t>(tile.y + y) * settings_.width + tile.x + x];
      for (int c = 0; c < 3; ++c) {
        to.radiance[c] += from.radiance[c];
        to.single[c] += from.single[c];
      }
      to.square += from.square;
      to.clear += from.clear;
      to.depth += from.depth;
    }
  tile.samples += std::exchange(tile.planned, 0);
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  statistics_.paths += found.paths;
  statistics_.lookups += found.lookups;
  statistics_.turns += found.turns;
  statistics_.scatterings += found.scatterings;
  statistics_.overBound += found.overBound;
  statistics_.notFinite += found.notFinite;
}

bool PathTracer::run(const Progress& progress, const std::function<void()>& checkpoint) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto saved = start;
  const auto since = [](Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
  // What is done and what is left, in samples a pixel summed over tiles.
  const auto share = [&] {
    double done = 0.0, left = 0.0;
    for (const Tile& tile : tiles_) {
      done += tile.samples;
      const double most = settings_.samples - tile.samples;
      if (settings_.noise > 0.0 && grey_ > 0.0) {
        const double error = errorOf(tile, sampleVarianceOf(tile)) / settings_.noise;
        left += std::clamp(tile.samples * (error * error - 1.0), static_cast<double>(tile.planned), most);
      } else {
        left += most;
      }
    }
    const double byWork = done + left > 0.0 ? done / (done + left) : 1.0;
    return settings_.seconds > 0.0 ? std::max(byWork, std::min(since(start) / settings_.seconds, 1.0)) : byWork;
  };
  do {
    for (std::size_t first = 0; first < tiles_.size(); first += kGroup) {
      std::vector<Tile*> work;
      for (std::size_t i = first; i < std::min(first + kGroup, tiles_.size()); ++i)
        if (tiles_[i].planned > 0) work.push_back(&tiles_[i]);
      if (work.empty()) continue;
      parallelFor(work.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) traceTile(*work[i]);
      });
      if (checkpoint && since(saved) > settings_.checkpointSeconds) {
        checkpoint();
        saved = Clock::now();
      }
      if (progress && !progress(share())) return false;
      if (settings_.seconds > 0.0 && since(start) > settings_.seconds) return true;
    }
  } while (planRound());
  if (progress) progress(1.0);
  return true;
}

TraceLayers PathTracer::layers() const {
  const int w = settings_.width, h = settings_.height;
  TraceLayers layers{Image(w, h, 3), Image(w, h, 1), Image(w, h, 3), Image(w, h, 3),
                     Image(w, h, 1), Image(w, h, 1), Image(w, h, 1)};
  for (const Tile& tile : tiles_) {
    if (tile.samples == 0) continue;
    const double n = tile.samples;
    for (int y = tile.y; y < tile.y + tile.height; ++y)
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const Totals& t = totals_[static_cast<std::size_t>(y) * w + x];
        for (int c = 0; c < 3; ++c) {
          layers.radiance.at(x, y)[c] = static_cast<float>(t.radiance[c] / n);
          layers.direct.at(x, y)[c] = static_cast<float>(t.single[c] / n);
          layers.multiple.at(x, y)[c] = static_cast<float>((t.radiance[c] - t.single[c]) / n);
        }
        const double mean = t.luminance() / n;
        *layers.variance.at(x, y) =
            n > 1.0 ? static_cast<float>(std::max(t.square / n - mean * mean, 0.0) / (n - 1.0)) : 0.0f;
        *layers.transmittance.at(x, y) = static_cast<float>(t.clear / n);
        const double met = n - t.clear;
        *layers.depth.at(x, y) = met > 0.5 ? static_cast<float>(t.depth / met) : 0.0f;
        *layers.samples.at(x, y) = static_cast<float>(n);
      }
  }
  return layers;
}

namespace {
constexpr char kMagic[8] = {'W', 'E', 'L', 'K', 'I', 'N', 'T', '3'};
}

std::vector<std::byte> PathTracer::state() const {
  const std::size_t head = sizeof kMagic + 2 * sizeof(int) + sizeof(double);
  std::vector<std::byte> bytes(head + tiles_.size() * 2 * sizeof(int) + totals_.size() * sizeof(Totals));
  std::byte* at = bytes.data();
  const auto put = [&](const void* from, std::size_t size) {
    std::memcpy(at, from, size);
    at += size;
  };
  put(kMagic, sizeof kMagic);
  put(&settings_.width, sizeof(int));
  put(&settings_.height, sizeof(int));
  put(&grey_, sizeof grey_);
  for (const Tile& tile : tiles_) {
    put(&tile.samples, sizeof(int));
    put(&tile.planned, sizeof(int));
  }
  put(totals_.data(), totals_.size() * sizeof(Totals));
  return bytes;
}

void PathTracer::restore(std::span<const std::byte> bytes) {
  if (bytes.size() != state().size() || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    throw Error(ErrorKind::badInput, "", "this is not a checkpoint of a picture of this size; delete it to start anew");
  const std::byte* at = bytes.data() + sizeof kMagic;
  const auto take = [&](void* to, std::size_t size) {
    std::memcpy(to, at, size);
    at += size;
  };
  int size[2];
  take(size, sizeof size);
  if (size[0] != settings_.width || size[1] != settings_.height)
    throw Error(ErrorKind::badInput, "",
                fmt::format("the checkpoint is of a picture of {}x{} pixels, not {}x{}", size[0], size[1],
                            settings_.width, settings_.height));
  take(&grey_, sizeof grey_);
  if (!(grey_ >= 0.0) || !std::isfinite(grey_))
    throw Error(ErrorKind::badInput, "", "the checkpoint is damaged; delete it to start anew");
  for (Tile& tile : tiles_) {
    take(&tile.samples, sizeof(int));
    take(&tile.planned, sizeof(int));
    if (tile.samples < 0 || tile.planned < 0 || tile.planned > settings_.samples)
      throw Error(ErrorKind::badInput, "", "the checkpoint is damaged; delete it to start anew");
  }
  take(totals_.data(), totals_.size() * sizeof(Totals));
}

}  // namespace welkin::trace
