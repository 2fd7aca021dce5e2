#pragma once
// Radiative transfer for researchers: photons followed forward through a grid of extinction.
//
// The extinction is constant inside each voxel. Free paths are sampled by delta tracking (Woodcock et al. 1965) against
// the maximum of each brick of 8^3 voxels, absorption by weights, radiances by local estimation (Marchuk et al. 1980).
// Nothing is cut off: paths go on until they leave; a weight below 1/16 plays roulette with a compensated survival. In
// a conservative medium weights stay 1 and so does the variance: a roulette on the number of events would let them
// grow.
#include <cstdint>
#include <optional>
#include <vector>

#include "welkin/base/progress.hpp"
#include "welkin/density/voxel_grid.hpp"
#include "welkin/trace/phase_table.hpp"

namespace welkin {

enum class FluxSides { open, periodic };  // of x and y; top and bottom are always open
enum class FluxLight {
  beam,       // parallel, onto every face of the box that it can reach: with periodic sides the top alone
  diffuse,    // isotropic, through the top
  isotropic,  // isotropic, through every open face: the white furnace
};

// A direction toward the sun or a viewer: degrees from +z, and counter-clockwise from +x.
struct FluxDirection {
  double zenith = 0.0, azimuth = 0.0;
};

struct FluxSettings {
  FluxSides sides = FluxSides::open;
  FluxLight light = FluxLight::beam;
  FluxDirection sun = {};      // zenith in [0, 89.9]: with periodic sides the beam must come down
  double albedo = 1.0;         // of single scattering, unless a grid gives it
  double surfaceAlbedo = 0.0;  // of the Lambertian surface under the box
  std::uint64_t photons = 1000000;
  std::uint32_t seed = 1;
  std::vector<FluxDirection> views = {};  // zenith in [0, 89.9] from above, [90.1, 180] from below
  // Biased, for measuring what others do: a path that would scatter once more than this is dropped and counted as lost.
  std::optional<std::uint32_t> dropAfter = {};
};

struct FluxEstimate {
  double mean = 0.0, se = 0.0;  // standard error, from batches of photons
};

// Per column of voxels, x fastest; the mean over columns is the estimate over the domain.
struct FluxField : FluxEstimate {
  std::vector<double> columns, columnsSe;
};

// Everything but radiances and path is a fraction of the light that enters the box. What is not reflected, absorbed or
// lost leaves: R + A + (1 - surfaceAlbedo) T + sides + lost = 1.
struct FluxResult {
  FluxField reflected;                 // leaves through the top
  FluxField transmitted;               // comes down to the surface, as often as it does
  FluxField absorbed;                  // in the medium
  FluxEstimate faces[6];               // leaves through x-, x+, y-, y+, bottom (comes down to it), top
  double incident[6] = {};             // share of the entering light, by face
  std::vector<FluxEstimate> radiance;  // per view: mean over the top (below: bottom) of the radiance that leaves there,
                                       // pi I / (mu0 F); I / I0 of light that is not a beam
  FluxEstimate unscattered;            // leaves without any event
  FluxEstimate lost;                   // by dropAfter
  FluxEstimate scatterings;            // events for each photon, weighted
  FluxEstimate path;                   // way inside the box for each photon, weighted, m
};

// Follows the photons. `albedo`, when given, has the grid's dims and holds each voxel's single-scattering albedo. The
// same seed gives the same bits on any number of threads. Throws Error (badInput) for settings out of range, an albedo
// that does not fit, more than 2^22 bricks with content or 2^23 columns; Cancelled as `progress` does.
FluxResult traceFlux(const VoxelGrid& extinction, const VoxelGrid* albedo, const PhaseTable& phase,
                     const FluxSettings& settings, const Progress& progress = {});

}  // namespace welkin
