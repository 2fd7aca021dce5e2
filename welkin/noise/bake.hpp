#pragma once
// The SIMD kernels behind textures.hpp and params.hpp.
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/noise/law.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin::bake {

// Fill a volume of the right size. Its channel count chooses between the texels and their packed form.
void fillBaseShape(const law::BaseShapeParams& params, Volume& volume);
void fillDetail(const law::DetailParams& params, Volume& volume);
void fillCurl(const law::CurlParams& params, Volume& volume);
void fillProfileBase(const law::ProfileBaseParams& params, Volume& volume);
void fillProfileDetail(const law::ProfileDetailParams& params, Volume& volume);
void fillProfileWarp(const law::ProfileWarpParams& params, Volume& volume);
void fillBillows(int cells, std::uint32_t seed, Volume& volume);

// The raw channels at points of the tile.
std::vector<glm::vec2> measureProfileBase(const law::ProfileBaseParams& params, std::span<const glm::vec3> points);
std::vector<glm::vec2> measureProfileDetail(const law::ProfileDetailParams& params, std::span<const glm::vec3> points);
std::vector<glm::vec2> measureProfileWarp(const law::ProfileWarpParams& params, std::span<const glm::vec3> points);

}  // namespace welkin::bake
