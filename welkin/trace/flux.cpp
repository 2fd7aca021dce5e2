#include "welkin/trace/flux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/trace/flux_job.hpp"

namespace welkin {

namespace {

using flux::Job, flux::Tally, flux::kFaces, flux::kTop, flux::kBottom;

constexpr std::uint64_t kBatches = 256;  // for standard errors; their own error is then 4 %
constexpr double kLowest = 89.9;         // degrees from the zenith
constexpr std::size_t kMostColumns = std::size_t(1) << 23, kMostBricks = std::size_t(1) << 22;
constexpr std::size_t kBatchMemory = std::size_t(256) << 20;  // bytes, for batches that run at the same time

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::badInput, "", what); }

void requireIn(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high)) refuse(fmt::format("{} {} is not in [{:g}, {:g}]", name, value, low, high));
}

void check(const VoxelGrid& grid, const VoxelGrid* albedo, const FluxSettings& s) {
  requireIn("albedo", s.albedo, 0.0, 1.0);
  requireIn("surface albedo", s.surfaceAlbedo, 0.0, 1.0);
  requireIn("sun zenith", s.sun.zenith, 0.0, kLowest);
  if (!std::isfinite(s.sun.azimuth)) refuse("the sun's azimuth is not a number");
  for (const FluxDirection& v : s.views) {
    requireIn("view zenith", v.zenith, 0.0, 180.0);
    if (v.zenith > kLowest && v.zenith < 180.0 - kLowest)
      refuse(fmt::format("a view {} degrees from the zenith runs along the layer: stay {:g} away from 90", v.zenith,
                         90.0 - kLowest));
    if (!std::isfinite(v.azimuth)) refuse("the azimuth of a view is not a number");
  }
  if (s.photons < 2) refuse("at least two photons are needed: a standard error is wanted too");
  if (std::size_t(grid.dims().x) * std::size_t(grid.dims().y) > kMostColumns)
    refuse(fmt::format("{} x {} columns are more than 2^23: use a coarser grid", grid.dims().x, grid.dims().y));
  if (grid.values().size() / VoxelGrid::kBrickVoxels > kMostBricks)
    refuse("more than 2^22 bricks of 8^3 voxels have content: use a coarser grid");
  if (!albedo) return;
  if (albedo->dims() != grid.dims())
    refuse(fmt::format("the albedo has {} x {} x {} voxels, the extinction {} x {} x {}", albedo->dims().x,
                       albedo->dims().y, albedo->dims().z, grid.dims().x, grid.dims().y, grid.dims().z));
  requireIn("albedo of a voxel", albedo->maximum(), 0.0, 1.0);
}

glm::dvec3 unitVector(const FluxDirection& d) {
  const double zenith = d.zenith * std::numbers::pi / 180.0, azimuth = d.azimuth * std::numbers::pi / 180.0;
  return {std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith)};
}

std::array<float, 3> floats(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Constant inside a voxel: neighbours of a brick do not matter.
std::vector<float> ownMaxima(const VoxelGrid& grid) {
  std::vector<float> maxima;
  for (const std::uint32_t brick : grid.brickIndex()) {
    const auto values = grid.values().subspan(std::size_t(brick) * VoxelGrid::kBrickVoxels, VoxelGrid::kBrickVoxels);
    maxima.push_back(*std::max_element(values.begin(), values.end()));
  }
  return maxima;
}

// The share of the light that enters through each face.
std::array<double, kFaces> litShares(const VoxelGrid& grid, const FluxSettings& s) {
  const glm::dvec3 size = glm::dvec3(grid.dims()) * grid.voxel(), sun = unitVector(s.sun);
  const glm::dvec3 area(size.y * size.z, size.x * size.z, size.x * size.y);
  std::array<double, kFaces> shares{};
  double total = 0.0;
  for (int face = 0; face < kFaces; ++face) {
    const int axis = face / 2;
    const double cosine = s.light == FluxLight::beam ? (face % 2 == 1 ? sun[axis] : -sun[axis]) : 1.0;
    const bool open = (axis == 2 || s.sides == FluxSides::open) && (s.light != FluxLight::diffuse || face == kTop);
    // A cosine of rounding, like that of azimuth 180 with y, lights nothing.
    shares[std::size_t(face)] = open && cosine > 1e-12 ? area[axis] * cosine : 0.0;
    total += shares[std::size_t(face)];
  }
  for (double& share : shares) share /= total;
  return shares;
}

Job describe(const VoxelGrid& grid, const VoxelGrid* albedo, const std::vector<float>& maxima, const PhaseTable& phase,
             const FluxSettings& s, const std::array<double, kFaces>& shares) {
  const glm::ivec3 n = grid.dims(), bricks = grid.brickDims();
  Job job{.medium = {.dims = {n.x, n.y, n.z},
                     .bricks = {bricks.x, bricks.y, bricks.z},
                     .voxel = floats(grid.voxel()),
                     .brickIndex = grid.brickIndex().data(),
                     .values = grid.values().data(),
                     .majorants = maxima.data(),
                     .albedo = static_cast<float>(s.albedo),
                     .albedoIndex = albedo ? albedo->brickIndex().data() : nullptr,
                     .albedoValues = albedo ? albedo->values().data() : nullptr},
          .phase = phase.view(),
          .periodic = s.sides == FluxSides::periodic,
          .diffuse = s.light != FluxLight::beam,
          .countAbsorption = albedo != nullptr || s.albedo < 1.0,
          .beam = floats(-unitVector(s.sun)),
          .lit = {},
          .surfaceAlbedo = static_cast<float>(s.surfaceAlbedo),
          .dropAfter = s.dropAfter ? static_cast<float>(*s.dropAfter) : std::numeric_limits<float>::infinity(),
          .seed = s.seed,
          .views = {}};
  double sum = 0.0;
  int lastLit = 0;
  for (int face = 0; face < kFaces; ++face) {
    sum += shares[std::size_t(face)];
    job.lit[std::size_t(face)] = static_cast<float>(sum);
    if (shares[std::size_t(face)] > 0.0) lastLit = face;
  }
  for (int face = lastLit; face < kFaces; ++face) job.lit[std::size_t(face)] = 1.0f;
  for (const FluxDirection& v : s.views) {
    const glm::dvec3 d = unitVector(v);
    job.views.push_back({floats(d), static_cast<float>(std::numbers::pi / std::abs(d.z))});
  }
  return job;
}

// Everything of a tally but its columns, in a row.
std::vector<double> scalarsOf(const Tally& t) {
  std::vector<double> all(t.faces, t.faces + kFaces);
  all.insert(all.end(), {t.absorbed, t.lost, t.unscattered, t.scatterings, t.path});
  all.insert(all.end(), t.radiance.begin(), t.radiance.end());
  return all;
}

// Sums over batches of photons, and what their standard errors need.
struct Sums {
  std::vector<double> sum, square, cross;  // of s, s^2 and n s, n the batch's photons
  double photons = 0.0, photonsSquared = 0.0, batches = 0.0;

  explicit Sums(std::size_t count) : sum(count), square(count), cross(count) {}
  void add(const std::vector<double>& s, double n) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      sum[i] += s[i];
      square[i] += s[i] * s[i];
      cross[i] += n * s[i];
    }
    photons += n;
    photonsSquared += n * n;
    batches += 1.0;
  }
  FluxEstimate estimate(std::size_t i, double scale = 1.0) const {
    const double mean = sum[i] / photons;
    const double spread = square[i] - 2.0 * mean * cross[i] + mean * mean * photonsSquared;
    const double variance = std::max(spread, 0.0) * batches / ((batches - 1.0) * photons * photons);
    return {scale * mean, scale * std::sqrt(variance)};
  }
};

FluxField field(const FluxEstimate& mean, const Sums& columns, std::size_t plane, std::size_t count) {
  FluxField f{mean, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const FluxEstimate e = columns.estimate(plane * count + i, double(count));
    f.columns.push_back(e.mean);
    f.columnsSe.push_back(e.se);
  }
  return f;
}

}  // namespace

FluxResult traceFlux(const VoxelGrid& extinction, const VoxelGrid* albedo, const PhaseTable& phase,
                     const FluxSettings& settings, const Progress& progress) {
  check(extinction, albedo, settings);
  const std::vector<float> maxima = ownMaxima(extinction);
  const std::array<double, kFaces> shares = litShares(extinction, settings);
  const Job job = describe(extinction, albedo, maxima, phase, settings, shares);
  const std::size_t columns = std::size_t(extinction.dims().x) * std::size_t(extinction.dims().y);

  const std::uint64_t batches = std::min(kBatches, settings.photons);
  const std::size_t together = std::clamp<std::size_t>(kBatchMemory / (3 * sizeof(double) * columns), 2, 16);
  const auto firstOf = [&](std::uint64_t batch) {
    return settings.photons / batches * batch + std::min(batch, settings.photons % batches);
  };
  std::vector<Tally> tallies(together);
  Sums scalars(11 + job.views.size()), fields(3 * columns);
  for (std::uint64_t begin = 0; begin < batches; begin += together) {
    const std::size_t count = std::min<std::size_t>(together, batches - begin);
    parallelFor(count, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        tallies[i] = {};
        tallies[i].radiance.assign(job.views.size(), 0.0);
        tallies[i].columns.assign(3 * columns, 0.0);
        followPhotons(job, firstOf(begin + i), firstOf(begin + i + 1), tallies[i]);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto photons = static_cast<double>(firstOf(begin + i + 1) - firstOf(begin + i));
      scalars.add(scalarsOf(tallies[i]), photons);
      fields.add(tallies[i].columns, photons);
    }
    report(progress, double(begin + count) / double(batches));
  }

  FluxResult result;
  result.reflected = field(scalars.estimate(kTop), fields, 0, columns);
  result.transmitted = field(scalars.estimate(kBottom), fields, 1, columns);
  result.absorbed = field(scalars.estimate(6), fields, 2, columns);
  for (std::size_t face = 0; face < kFaces; ++face) {
    result.faces[face] = scalars.estimate(face);
    result.incident[face] = shares[face];
  }
  result.lost = scalars.estimate(7);
  result.unscattered = scalars.estimate(8);
  result.scatterings = scalars.estimate(9);
  result.path = scalars.estimate(10);
  for (std::size_t v = 0; v < job.views.size(); ++v)
    result.radiance.push_back(scalars.estimate(11 + v, double(job.views[v].scale) / shares[kTop]));
  return result;
}

}  // namespace welkin
