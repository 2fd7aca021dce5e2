#pragma once
// What layers, sheets and hero clouds amount to, measured on the field itself.
#include <cstddef>
#include <vector>

#include "welkin/density/field.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::app {

// Least vertical optical depth of a column that counts as cloudy: for layers what satellites see as cloud (ISCCP,
// Rossow and Schiffer 1999), for sheets what the eye sees (Sassen and Cho 1992).
inline constexpr double kCloudyLayer = 0.3, kCloudySheet = 0.03;

struct CloudStatistics {
  double cover = 0.0;               // share of the sky with cloudy columns, in [0, 1]
  double base = 0.0, top = 0.0;     // m; 2 % of the cloudy columns begin lower, 2 % end higher
  double meanOpticalDepth = 0.0;    // vertical, over the whole area
  double cloudyOpticalDepth = 0.0;  // mean over the cloudy columns
  double medianOpticalDepth = 0.0;  // over the cloudy columns
};

struct SkyStatistics {
  std::vector<CloudStatistics> layers, sheets;
  std::vector<CloudColumn> classical, heroes;  // over the middle of each
};

// Over a few thousand stratified columns at the scene's time. They cover twelve of a layer's largest patterns in each
// direction round the camera; a front, which stands in one place, four cluster sizes round the nearest place on its
// line; a picture, what it covers.
SkyStatistics measureSky(const Scene& scene);

// The scene's clouds with the pictures that it names; `textures` as of DensityField. Throws Error (badInput) for a
// picture that cannot be read.
DensityField densityField(const Scene& scene, DensityTextures textures = {});

}  // namespace welkin::app
