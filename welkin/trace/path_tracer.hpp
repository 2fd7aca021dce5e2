#pragma once
// The reference: a Monte Carlo path tracer for skies, without bias in its transport.
//
// Distances in cloud are drawn by delta tracking and the sun's light is dimmed by ratio tracking (Novak et al. 2014)
// under local bounds (density/cloud_cache.hpp); the air is a medium of its own whose colour is handled by balancing
// over the channels (Wilkie et al. 2014, Kutz et al. 2017). Roulette is compensated and no number of scatterings is the
// last. What is not the law itself: the weather is cached on a fine lattice (20 m nearby) and bilinear in between, and
// the air's transmittance to the sun comes from the table (3e-3 of it at most).
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/base/image.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/scene/scene.hpp"
#include "welkin/trace/kernel.hpp"

namespace welkin::trace {

// medium: light is scattered by the air as by the clouds. tables: the sky and the air between the camera and what it
// sees come from the real-time renderer's tables, as if there were no clouds: biased, faster, less noise. Skies that
// are not physical are always taken from tables.
enum class AirModel { medium, tables };

// Whether the camera sees the sun itself.
enum class SunDisc { seen, leftOut };

struct TraceSettings {
  int width = 1280, height = 720;
  int samples = 64;  // of a pixel; with `noise` the most
  // > 0: each tile of 16 x 16 pixels until its standard error (root mean square over the tile) falls below this, as the
  // eye sees it: on a scale from black, 0, to white, 1, where brightness goes as the root of luminance and the median
  // tile is middle grey (luminance .18 of white). There an error of x is a share x / .21 of the luminance.
  double noise = 0.0;
  double seconds = 0.0;  // > 0: stop then
  AirModel air = AirModel::medium;
  SunDisc sunDisc = SunDisc::seen;
  int scatterings = 0;  // > 0: paths end at the next scattering after so many, which makes the picture too dark
  double checkpointSeconds = 5.0;  // at least this long between two calls of `checkpoint`
  CloudCacheExtent clouds{};       // how finely the weather is cached
  int frame = 0;                   // of a film: each has noise of its own
};

// What a scene names in files.
struct TraceInputs {
  std::span<const Volume> weatherMaps{};  // the authoring picture of every layer that names one, at its index
  std::span<const PlacedGrid> grids{};    // the scene's grids that name a file, in order
  const SkyModel* sky = nullptr;          // paints the sky in place of atmosphere.model; air comes from tables then
};

// What a traced picture consists of; all linear, kcd/m^2.
struct TraceLayers {
  Image radiance;       // RGB
  Image variance;       // 1: variance of the mean of the luminance
  Image direct;         // RGB: the sun's disc, and light that was scattered once
  Image multiple;       // RGB: the rest
  Image transmittance;  // 1: share of paths that meet no cloud
  Image depth;          // 1: mean distance in m at which the others do; 0 where none does
  Image samples;        // 1
};

class PathTracer {
 public:
  // Throws Error (badInput).
  PathTracer(const Scene& scene, const TraceInputs& inputs, const TraceSettings& settings);
  ~PathTracer();

  // Traces until the settings are met. `checkpoint`, if given, is called now and then between tiles. Cancelled by
  // `progress`, it returns false; the picture so far is valid.
  bool run(const Progress& progress, const std::function<void()>& checkpoint = {});

  TraceLayers layers() const;
  const KernelStatistics& statistics() const { return statistics_; }

  // All that has been summed up so far. Restoring it into a tracer made from the same scene and settings goes on to the
  // very same picture. restore throws Error (badInput) for anything that is not such a state.
  std::vector<std::byte> state() const;
  void restore(std::span<const std::byte> state);

 private:
  struct Totals;
  struct Tile {
    int x, y, width, height;
    int samples = 0;
    int planned = 0;  // samples of this round that are not traced yet
  };
  void traceTile(Tile& tile);
  bool planRound();                                 // false: enough everywhere
  double meanOf(const Tile& tile) const;            // luminance
  double sampleVarianceOf(const Tile& tile) const;  // of one sample's luminance, mean over the pixels
  double errorOf(const Tile& tile, double sampleVariance) const;

  struct Baked;
  std::unique_ptr<Baked> baked_;
  TraceSettings settings_;
  std::uint32_t seed_;
  std::vector<Totals> totals_;  // of every pixel
  std::vector<Tile> tiles_;     // row by row
  int tilesAcross_ = 0;
  double grey_ = 0.0;  // luminance of the median tile after the first round; 0 until then
  KernelStatistics statistics_;
};

}  // namespace welkin::trace
