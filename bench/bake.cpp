// Voxels a second of a hero cloud baked as `welkin vdb` bakes it: 512^3 voxels in the box of the cloud alone, so that
// none of them lies beside it. Made ready (smooth shape, billows) and baked; not written to a file. bench_bake
// [SPECIES...], "all" for every one; the figures of the JSON are those of the first, congestus if none is named.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/harness.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/voxel_bake.hpp"

namespace welkin {
namespace {

constexpr int kEdge = 512;

struct Bake {
  double seconds = 0.0, cpu = 0.0, ready = 0.0;  // wall, of all threads, wall before the first voxel
  double active = 0.0, mean = 0.0;               // share of voxels with cloud; mean extinction, 1/m
};

Bake bake(HeroSpecies species) {
  Bake result;
  const double wall = bench::wallSeconds(), cpu = bench::cpuSeconds();
  const Hero hero = heroPreset(species);
  const DensityField field({.seed = 1, .heroes = std::span(&hero, 1)});
  const HeroBody& body = field.heroes().front();
  result.ready = bench::wallSeconds() - wall;
  const VoxelBox box{glm::ivec3(kEdge), body.lowest(), (body.highest() - body.lowest()) / double(kEdge)};
  const VoxelGrid grid = bakeVoxels(field, box, {});
  result.seconds = bench::wallSeconds() - wall;
  result.cpu = bench::cpuSeconds() - cpu;
  for (const float v : grid.values()) {
    result.active += v > 0.0f;
    result.mean += v;
  }
  const double voxels = double(kEdge) * kEdge * kEdge;
  result.active /= voxels;
  result.mean /= voxels;
  return result;
}

HeroSpecies speciesNamed(const std::string& name) {
  const auto& names = ChoiceNames<HeroSpecies>::names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<HeroSpecies>(i);
  throw Error(ErrorKind::badInput, name, "is not a species of hero clouds; `welkin fields` lists them");
}

void run(std::vector<std::string> wanted) {
  if (wanted.empty()) wanted.emplace_back("congestus");
  if (wanted == std::vector<std::string>{"all"})
    wanted.assign(ChoiceNames<HeroSpecies>::names.begin(), ChoiceNames<HeroSpecies>::names.end());
  std::vector<HeroSpecies> species;
  for (const std::string& name : wanted) species.push_back(speciesNamed(name));
  const double voxels = double(kEdge) * kEdge * kEdge;
  Bake first;
  fmt::print("{:<24} {:>8} {:>8} {:>8} {:>10} {:>12}\n", "", "s", "CPU s", "ready s", "M voxels/s", "with cloud, %");
  for (std::size_t i = 0; i < species.size(); ++i) {
    const Bake b = bake(species[i]);
    if (i == 0) first = b;
    fmt::print("{:<24} {:>8.2f} {:>8.2f} {:>8.2f} {:>10.1f} {:>12.1f}\n", wanted[i], b.seconds, b.cpu, b.ready,
               1e-6 * voxels / b.seconds, 100.0 * b.active);
    std::fflush(stdout);
  }
  fmt::print(
      "{{\"bench\": \"bake\", \"species\": \"{}\", \"voxels\": {:.0f}, \"seconds\": {:.3f}, \"cpu_s\": {:.3f}, "
      "\"voxels_per_s\": {:.0f}, \"voxels_per_cpu_s\": {:.0f}, \"active\": {:.4f}, \"mean_extinction\": {:.8f}}}\n",
      wanted.front(), voxels, first.seconds, first.cpu, voxels / first.seconds, voxels / first.cpu, first.active,
      first.mean);
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) {
  try {
    welkin::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_bake: {}\n", e.what());
    return 1;
  }
}
