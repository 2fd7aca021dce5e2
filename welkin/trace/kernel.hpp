#pragma once
// What the path tracer's SIMD kernel reads and writes.
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/density/cloud_cache.hpp"
#include "welkin/scene/camera.hpp"
#include "welkin/trace/phase_table.hpp"
#include "welkin/trace/sky_distribution.hpp"

namespace welkin::trace {

// Upper bounds of the air's extinction (1/m, largest channel) in steps of kAirStep of altitude.
inline constexpr float kAirStep = 100.0f;    // m
inline constexpr float kAirClimb = 1000.0f;  // m, by which a step may change its altitude; high up by half of it

// A sheet is a slab of this height above Sheet::height; its law knows a vertical optical depth only.
inline constexpr float kSheetThickness = 200.0f;  // m

// What scatters besides the air: the layers, then the sheets, the grids and the hero clouds.
struct Component {
  float albedo;
  int phase;  // index of its table
};

struct KernelScene {
  const CloudCache* clouds = nullptr;
  std::vector<Component> components;
  std::vector<PhaseTableView> phases;
  std::vector<float> sheetBounds;  // 1/m
  std::vector<float> airBounds;
  law::PlanetParams planet{};
  law::AtmosphereParams air{};
  bool airScatters = true;  // the air is a medium; else its tables stand for it
  TextureView transmittance, skyView, aerialInscatter, aerialTransmittance;
  SkyDistributionView sky{};  // of skyView; asked where the air does not scatter
  int aerosolPhase = 0;       // table of the air's aerosol
  float aureole =
      0.0f;  // versine within which the first component's forward peak lies, and its share of the scattering
  float aureoleShare = 1.0f;
  law::CameraParams camera{};
  bool sunDisc = true;       // whether the camera sees it
  law::NightParams night{};  // what else the camera sees, where it shows
  bool moonShows = false, starsShow = false, glows = false;
  float pixelAngle = 0.0f;       // rad
  float mostScatterings = 1e6f;  // by cloud, air and ground; paths end at the next one
};

// Sums over the samples of one pixel.
struct PixelSums {
  float radiance[3];  // kcd/m^2
  float single[3];    // the part that was scattered once
  float square;       // of the luminance
  float clear;        // samples that met no cloud
  float depth;        // m, to the first scattering in cloud, summed over those that met one
};

struct KernelStatistics {
  std::uint64_t paths = 0, lookups = 0, scatterings = 0;
  std::uint64_t turns = 0;      // each asks for the density once, for all lanes together
  std::uint64_t overBound = 0;  // samples that exceeded their majorant: must be 0
  std::uint64_t notFinite = 0;  // paths that were dropped: must be 0
};

struct TileJob {
  int x, y, width, height;  // pixels
  int imageWidth, imageHeight;
  int firstSample, samples;  // of every pixel
  std::uint32_t seed;
};

// Adds the paths of a tile to the sums of its pixels (row by row). The same bits on any number of threads, for one SIMD
// target.
KernelStatistics traceTile(const KernelScene& scene, const TileJob& job, std::span<PixelSums> pixels);

// Paths that are traced side by side by one core of this machine.
std::size_t laneCount();

}  // namespace welkin::trace
