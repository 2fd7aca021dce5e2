#pragma once
// From a Scene to the parameters of the march.
#include <span>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/density/params.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::realtime {

// `clear`: light of the sky without clouds. `gridExtinction`: greatest of the grids, 1/m. `pixelAngle`: rad of one
// pixel. `drawGround`: whether rays end on Welkin's own ground.
law::MarchParams marchParams(const Scene& scene, const law::PlanetParams& planet, const glm::vec3& sunDirection,
                             const SkyLight& clear, float pixelAngle, bool drawGround,
                             std::span<const Shell> grids = {}, float gridExtinction = 0.0f);

}  // namespace welkin::realtime
