#pragma once
// The question that everything asks of the clouds, answered on the CPU: extinction at a point of the world. The weather
// is the pure function itself, not a cached map; the noise is that of the GPU's half float textures.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "welkin/density/classical/clouds.hpp"
#include "welkin/density/grid_cloud.hpp"
#include "welkin/density/hero_body.hpp"
#include "welkin/density/noise_settings.hpp"
#include "welkin/density/params.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin {

// What a DensityField is made of: the parts of a scene that clouds depend on. Copied.
struct DensityParts {
  std::span<const Layer> layers{};
  std::span<const Sheet> sheets{};
  NoiseSettings noise{};
  Drift drift{};
  int seed = 1;
  std::span<const PlacedGrid> grids{};
  std::span<const Classical> classical{};
  std::span<const Hero> heroes{};
  std::span<const Volume>
      weatherMaps{};  // one for each layer that names a map, at the layer's index; RGBA, south first
};

// Textures that replace the baked ones where they are not empty; packed as noise/textures.hpp says.
struct DensityTextures {
  Volume profileBase, profileDetail, profileWarp, nubisBase, nubisDetail, curl, heroBillows;
};

// The noise that the shapes of these layers and hero clouds need, as half floats hold it; what `given` has already is
// kept. Throws Error (badInput) for settings out of range.
DensityTextures bakeDensityTextures(const DensityParts& parts, DensityTextures given);

// A layer's cloud over one place.
struct CloudColumn {
  float opticalDepth = 0.0f;      // vertical, of the whole layer
  float base = 0.0f, top = 0.0f;  // m, lowest and highest altitude with cloud; both 0 where there is none
};

// Safe to ask from many threads. Points are (east, north, altitude above the ground) in m: cloud space, whose plane
// touches the ground at the world's origin. Every answer has the same bits on any number of threads; anchors are chosen
// among the points asked for, so that it is as precise 10^6 m from the origin as at it.
class DensityField {
 public:
  // Bakes the noise that the shapes of these layers need. Throws Error (badInput) for settings out of range and missing
  // weather maps.
  explicit DensityField(const DensityParts& parts, DensityTextures textures = {});

  // Goes to another time; not while others ask.
  void setDrift(const Drift& drift);
  const Drift& drift() const { return drift_; }

  std::size_t layerCount() const { return layers_.size(); }
  std::size_t sheetCount() const { return sheets_.size(); }
  const std::vector<Layer>& layers() const { return layers_; }

  // Those given, then classical clouds.
  const std::vector<PlacedGrid>& grids() const { return grids_; }
  const std::vector<HeroBody>& heroes() const { return bodies_; }
  // The tile of billows that they share.
  TextureView heroBillows() const { return textures_.heroBillows.view(); }

  // Extinction in 1/m of all layers, grids, classical and hero clouds together; detail finer than `footprint` (m) is
  // replaced by its mean, 0 is the truth.
  float extinction(const glm::dvec3& point, float footprint = 0.0f) const;
  std::vector<float> extinction(std::span<const glm::dvec3> points, float footprint = 0.0f) const;
  // The same of one layer.
  std::vector<float> layerExtinction(std::size_t layer, std::span<const glm::dvec3> points,
                                     float footprint = 0.0f) const;

  // Vertical optical depth between the altitudes `low` and `high` over a place, without sheets, by the midpoint rule
  // with steps of at most `step` m.
  double opticalDepth(const glm::dvec2& place, double low, double high, double step = 10.0) const;

  // The same along the ray from a point toward a unit vector (east, north, up at the world's origin), out of the clouds
  // or into the ground, with steps of at most `step` m; at most 200 km far.
  double opticalDepthToward(const glm::dvec3& point, const glm::dvec3& direction, double step = 20.0) const;

  // The weather of a layer in the column of a point, leaned and warped as its cloud is: for the shape "profile" (height
  // of the top above the base in m, shift of the base in m, anvil, precipitation), for "nubis" (coverage, type,
  // precipitation, shift of the base in m).
  glm::vec4 weather(std::size_t layer, const glm::dvec3& point) const;

  // One layer over many places: the integral of its extinction over its whole shell, midpoints of steps of at most
  // `step` m. Its base and top are where the extinction exceeds a twentieth of the layer's own.
  std::vector<CloudColumn> columns(std::size_t layer, std::span<const glm::dvec2> places, double step = 15.0) const;

  // Vertical optical depth of a sheet over places.
  std::vector<float> sheetOpticalDepth(std::size_t sheet, std::span<const glm::dvec2> places) const;

 private:
  void addHeroes(std::span<const glm::dvec3> points, float footprint, std::span<float> sum) const;
  void addGrids(std::span<const glm::dvec3> points, std::span<float> sum) const;
  void addLayer(std::size_t layer, std::span<const glm::dvec3> points, float footprint, std::span<float> sum) const;

  std::vector<Layer> layers_;
  std::vector<Sheet> sheets_;
  std::vector<PlacedGrid> grids_;
  std::size_t given_;  // of the grids
  std::vector<Classical> classical_;
  ClassicalClouds classicalClouds_;  // at the time of the drift
  std::vector<Hero> heroes_;
  std::vector<HeroBody> bodies_;  // of the heroes, at the time of the drift
  std::vector<Volume> maps_;
  Drift drift_;
  int seed_;
  DensityTextures textures_;
};

}  // namespace welkin
