#include "welkin/trace/validation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/angle.hpp"
#include "welkin/trace/published.hpp"

namespace welkin {

namespace {

constexpr double kFluxGate = 1e-3, kRadianceGate = 0.01;

double degreesOf(double cosine) { return std::acos(cosine) * 180.0 / kPi; }

// A horizontal slab of one voxel, 1 km thick.
VoxelGrid slabOf(double depth) {
  VoxelGrid grid({1, 1, 1}, glm::dvec3(0.0), glm::dvec3(1000.0));
  grid.set({0, 0, 0}, static_cast<float>(depth / 1000.0));
  return grid;
}

// A sphere of radius 1 m in a box of 2 m; a voxel holds what its share inside holds, so that every column has the mean
// of the chords through it.
class Sphere {
 public:
  explicit Sphere(const glm::ivec3& dims) : dims_(dims) {
    constexpr int kCuts = 8;  // of a column, along x and y
    const glm::dvec3 voxel = 2.0 / glm::dvec3(dims);
    shares_.resize(std::size_t(dims.x) * dims.y * dims.z);
    for (int column = 0; column < dims.x * dims.y; ++column)
      for (int cut = 0; cut < kCuts * kCuts; ++cut) {
        const double x = (column % dims.x + (cut % kCuts + 0.5) / kCuts) * voxel.x - 1.0;
        const double y = (column / dims.x + (cut / kCuts + 0.5) / kCuts) * voxel.y - 1.0;
        const double half = std::sqrt(std::max(1.0 - x * x - y * y, 0.0));
        for (int z = int((1.0 - half) / voxel.z); z * voxel.z < 1.0 + half && z < dims.z; ++z) {
          const double low = z * voxel.z - 1.0, inside = std::min(half, low + voxel.z) - std::max(-half, low);
          shares_[std::size_t(z) * dims.x * dims.y + column] += float(inside / voxel.z / (kCuts * kCuts));
        }
      }
  }
  // `depth` is that of the diameter.
  VoxelGrid filled(double depth) const {
    VoxelGrid grid(dims_, glm::dvec3(-1.0), 2.0 / glm::dvec3(dims_));
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      const int column = int(i % (std::size_t(dims_.x) * dims_.y)), z = int(i / (std::size_t(dims_.x) * dims_.y));
      grid.set({column % dims_.x, column / dims_.x, z}, std::max(float(0.5 * depth) * shares_[i], 0.0f));
    }
    return grid;
  }

 private:
  glm::ivec3 dims_;
  std::vector<float> shares_;
};

// A box that is cloudy here and there, 4 x 5 x 6 m.
VoxelGrid brokenCloud() {
  VoxelGrid grid({12, 10, 16}, glm::dvec3(0.0), {4.0 / 12, 5.0 / 10, 6.0 / 16});
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 12; ++x)
        if ((x / 3 + y / 2 + z / 4) % 2 == 0) grid.set({x, y, z}, 0.3f * float(1 + (x * 7 + y * 3 + z) % 8));
  return grid;
}

class Suite {
 public:
  Suite(const ValidationSettings& settings, const Progress& progress) : settings_(settings), progress_(progress) {}

  std::vector<ValidationRow> run() {
    phaseFunctions();
    slabs();
    halfSpaces();
    furnace();
    spheres();
    stepCloud();
    report(progress_, 1.0);
    return std::move(rows_);
  }

 private:
  std::uint64_t photons(double full) const {
    return static_cast<std::uint64_t>(settings_.effort == ValidationEffort::full ? full : full / 20.0);
  }
  // Each run with a seed of its own, so that rows do not err together.
  FluxResult trace(const VoxelGrid& grid, double g, FluxSettings s) {
    report(progress_, double(runs_++) / kRuns);
    s.seed = static_cast<std::uint32_t>(runs_);
    return traceFlux(grid, nullptr, settings_.henyeyGreenstein(g), s);
  }

  void row(std::string name, const char* source, const FluxEstimate& ours, double theirs, double gate) {
    rows_.push_back({section_, std::move(name), source, ours, theirs, gate});
  }
  void flux(std::string name, const char* source, const FluxEstimate& ours, double theirs, double gate = kFluxGate) {
    row(std::move(name), source, ours, theirs, std::max(4.0 * ours.se, gate));
  }
  void radiance(std::string name, const char* source, const FluxEstimate& ours, double theirs) {
    row(std::move(name), source, ours, theirs, std::max(4.0 * ours.se, kRadianceGate * theirs));
  }

  void phaseFunctions() {
    using namespace published;
    section_ = "phase functions";
    const auto versine = [](double degrees) { return static_cast<float>(1.0 - std::cos(degrees * kPi / 180.0)); };
    for (const HenyeyGreenstein& h : kHenyeyGreenstein) {
      const PhaseTable table = settings_.henyeyGreenstein(h.asymmetry);
      for (int i = 0; i < 5; ++i)
        row(fmt::format("Henyey-Greenstein g {:g} at {} degrees", h.asymmetry, 45 * i), kClosedForm,
            {table.evaluate(versine(45.0 * i)), 0.0}, h.values[i], 1e-7 + 2e-6 * h.values[i]);
      integrals(table, fmt::format("Henyey-Greenstein g {:g}", h.asymmetry), kClosedForm, h.asymmetry);
    }
    for (const Droplets& d : kDroplets) {
      const PhaseTable table = PhaseTable::mie(computeMiePhase(d.diameter));
      const double angles[] = {0.0, 45.0, 90.0, 180.0};
      // Five digits are printed.
      for (int i = 0; i < 4; ++i)
        row(fmt::format("droplets of {:g} um at {:g} degrees", d.diameter, angles[i]), kJendersie,
            {table.evaluate(versine(angles[i])), 0.0}, d.values[i], 5e-5 * d.values[i]);
      integrals(table, fmt::format("droplets of {:g} um", d.diameter), kJendersie, d.meanCosine);
    }
  }

  // By the table's own samples, at the midpoints of 2^18 strata.
  void integrals(const PhaseTable& table, const std::string& name, const char* source, double meanCosine) {
    constexpr int kStrata = 1 << 18;
    double sum = 0.0, cosine = 0.0;
    for (int i = 0; i < kStrata; ++i) {
      const PhaseTable::Sample s = table.sample((float(i) + 0.5f) / float(kStrata));
      const double weight = double(table.evaluate(s.versine)) / double(s.pdf) / kStrata;
      sum += weight;
      cosine += weight * (1.0 - double(s.versine));
    }
    row(name + ", integral", published::kClosedForm, {sum, 0.0}, 1.0, 1e-5);
    row(name + ", mean cosine", source, {cosine, 0.0}, meanCosine, 1e-5);
  }

  void slabs() {
    section_ = "slabs";
    for (const published::Slab& s : published::kSlabs) {
      FluxSettings f{.sides = FluxSides::periodic, .albedo = s.albedo, .photons = photons(4e6)};
      if (s.mu0 > 0.0)
        f.sun.zenith = degreesOf(s.mu0);
      else
        f.light = FluxLight::diffuse;
      const FluxResult r = trace(slabOf(s.depth), s.asymmetry, f);
      const std::string name = fmt::format("g {:g}, w {:g}, depth {:g}, {}", s.asymmetry, s.albedo, s.depth,
                                           s.mu0 > 0.0 ? fmt::format("mu0 {:g}", s.mu0) : "diffuse light");
      flux(name + ": R", s.source, r.reflected, s.reflected);
      if (!std::isnan(s.transmitted)) flux(name + ": T", s.source, r.transmitted, s.transmitted);
    }
  }

  void halfSpaces() {
    section_ = "half-space";
    for (const published::HalfSpace& s : published::kHalfSpaces) {
      const FluxSettings f{.sides = FluxSides::periodic,
                           .albedo = s.albedo,
                           .photons = photons(s.albedo < 1.0 ? 4e6 : 2e5),
                           .views = {{0.0, 0.0}}};
      const FluxResult r = trace(slabOf(s.depth), 0.0, f);
      const std::string name = fmt::format("isotropic, w {:g}, mu0 1", s.albedo);
      if (s.albedo < 1.0)
        flux(name + ": R", published::kChandrasekhar, r.reflected, 1.0 - std::sqrt(1.0 - s.albedo) * s.h);
      radiance(name + ": BRF, mu 1", published::kChandrasekhar, r.radiance[0], s.albedo * s.h * s.h / 8.0);
    }
  }

  // Conservative and in uniform light: as bright as its surroundings, with a mean path of 4 V / S.
  void furnace() {
    section_ = "finite clouds";
    const FluxSettings f{
        .light = FluxLight::isotropic, .photons = photons(2e6), .views = {{0.0, 0.0}, {60.0, 30.0}, {130.0, 200.0}}};
    const VoxelGrid grid = brokenCloud();
    const FluxResult r = trace(grid, 0.85, f);
    const char* source = "exact";
    for (std::size_t v = 0; v < f.views.size(); ++v)
      radiance(fmt::format("furnace: radiance at {:g}, {:g}", f.views[v].zenith, f.views[v].azimuth), source,
               r.radiance[v], 1.0);
    const char* names[] = {"x-", "x+", "y-", "y+", "bottom", "top"};
    for (std::size_t face = 0; face < 6; ++face)
      flux(fmt::format("furnace: leaves through {}", names[face]), source, r.faces[face], r.incident[face]);
    const glm::dvec3 size = glm::dvec3(grid.dims()) * grid.voxel();
    const double meanPath = 2.0 / (1.0 / size.x + 1.0 / size.y + 1.0 / size.z);  // 4 V / S
    flux("mean path in a box / (4 V / S)", "Blanco and Fournier 2003", {r.path.mean / meanPath, r.path.se / meanPath},
         1.0);
  }

  void spheres() {
    // From photons of the box to photons of the sphere, in a beam.
    const double perHit = 4.0 / kPi;
    // Short chords at the rim make most of what is unscattered: fine columns, for an error of 3e-4 at depth 10.
    const Sphere fine({512, 512, 32}), sphere(glm::ivec3(128));
    for (const double depth : {2.0, 10.0}) {
      const FluxResult r = trace(fine.filled(depth), 0.85, {.photons = photons(4e6)});
      const double exact = 2.0 * (1.0 - (1.0 + depth) * std::exp(-depth)) / (depth * depth);
      flux(fmt::format("sphere, depth {:g}: unscattered fraction", depth), "exact",
           {1.0 - perHit * (1.0 - r.unscattered.mean), perHit * r.unscattered.se}, exact);
      // In isotropic light scatterings count the path: extinction times 4 R / 3, of the photons that hit the sphere.
      const FluxResult all =
          trace(sphere.filled(depth), 0.85, {.light = FluxLight::isotropic, .photons = photons(4e6)});
      const double scale = (6.0 / kPi) / (0.5 * depth * 4.0 / 3.0);
      flux(fmt::format("sphere, depth {:g}: mean path / (4 R / 3)", depth), "Blanco and Fournier 2003",
           {scale * all.scatterings.mean, scale * all.scatterings.se}, 1.0);
    }
    for (const published::StoppedPaths& s : published::kStoppedPaths) {
      const FluxResult r = trace(sphere.filled(s.depth), 0.85, {.photons = photons(2e6), .dropAfter = s.scatterings});
      flux(fmt::format("sphere, depth {:g}: lost after {} scatterings", s.depth, s.scatterings),
           published::kStoppedPathsSource, {perHit * r.lost.mean, perHit * r.lost.se}, s.lost,
           published::kStoppedPathsError);
    }
  }

  void stepCloud() {
    using namespace published;
    section_ = "I3RC case 1";
    VoxelGrid grid({32, 1, 1}, glm::dvec3(0.0), {15.625, 500.0, 250.0});
    for (int x = 0; x < 32; ++x) grid.set({x, 0, 0}, (x < 16 ? 2.0f : 18.0f) / 250.0f);
    const FluxResult r =
        trace(grid, 0.85, {.sides = FluxSides::periodic, .photons = photons(1e7), .views = {{0.0, 0.0}}});
    flux("R", kI3rc, r.reflected, kI3rcReflected);
    flux("T", kI3rc, r.transmitted, kI3rcTransmitted);
    radiance("nadir pi I / (mu0 F)", kI3rc, r.radiance[0], kI3rcNadir);
    for (std::size_t x = 0; x < 32; ++x)
      flux(fmt::format("R of column {}", x), kI3rcColumnsSource, {r.reflected.columns[x], r.reflected.columnsSe[x]},
           kI3rcColumns[x]);
  }

  static constexpr int kRuns = 37;  // calls of trace
  const ValidationSettings& settings_;
  const Progress& progress_;
  std::string section_;
  std::vector<ValidationRow> rows_;
  int runs_ = 0;
};

}  // namespace

bool ValidationRow::passes() const { return std::abs(ours.mean - theirs) <= gate; }
double ValidationRow::differenceInSe() const { return ours.se > 0.0 ? (ours.mean - theirs) / ours.se : 0.0; }

std::vector<ValidationRow> validate(const ValidationSettings& settings, const Progress& progress) {
  return Suite(settings, progress).run();
}

}  // namespace welkin
