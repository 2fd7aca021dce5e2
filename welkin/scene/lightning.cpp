#include "welkin/scene/lightning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "welkin/density/weather_map.hpp"

namespace welkin {

namespace {

constexpr double kReach = 60e3;                    // m
constexpr double kGrid = 10e3;                     // m: from all places of a cell the same towers are seen
constexpr int kTexels = 96;                        // 1.25 km each
constexpr double kDeepest = 3000.0;                // m, the least tower that thunders
constexpr double kNear = 15e3;                     // m
constexpr double kDuration = 0.2, kLongest = 0.5;  // s: that the mean is taken over; that strokes go on
// A flash sends out some 1e6 J of light (1e5 to 1e7 are reported of optical energy seen from space), about 1e8 lm s.
constexpr double kIntensity = 4e4;  // kcd

double unitOf(std::uint32_t& state) {
  state = state * 747796405u + 2891336453u;
  std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  word = (word >> 22u) ^ word;
  return static_cast<double>(word) / 4294967296.0;
}

std::uint32_t stateOf(const Lightning& lightning, long number) {
  std::uint32_t state = static_cast<std::uint32_t>(number) * 0x9E3779B9u + static_cast<std::uint32_t>(lightning.seed);
  unitOf(state);
  return state;
}

// Light of the strokes t seconds after the first, before it is scaled to a mean of 1.
double strokes(std::uint32_t state, double t) {
  constexpr double kFading = 0.025;
  const int count = 3 + static_cast<int>(3.0 * unitOf(state));
  double sum = 0.0, start = 0.0, strength = 1.0;
  for (int i = 0; i < count; ++i) {
    if (t >= start) sum += strength * std::exp(-(t - start) / kFading);
    start += 0.04 + 0.03 * unitOf(state);
    strength = 0.3 + 0.7 * unitOf(state);
  }
  return sum * kDuration / (kFading * 2.95);  // of four strokes, 2.95 times the first on the average
}

}  // namespace

FlashTime flashTime(const Lightning& lightning, double time) {
  if (lightning.rate <= 0.0f) return {};
  const double turn = 60.0 / static_cast<double>(lightning.rate);
  FlashTime f;
  f.number = static_cast<long>(std::floor(time / turn));
  std::uint32_t state = stateOf(lightning, f.number);
  if (lightning.freeze) {
    f.share = strokes(state, 0.0);
    return f;
  }
  const double start = f.number * turn + unitOf(state) * std::max(turn - kLongest, 0.0);
  const double share = time < start ? 0.0 : strokes(state, time - start);
  f.share = share > 1e-3 ? share : 0.0;
  return f;
}

std::optional<Flash> flashAt(const Scene& scene, const glm::dvec2& place, double time) {
  const FlashTime when = flashTime(scene.lightning, time);
  if (when.share <= 0.0 || scene.lightning.brightness <= 0.0f) return {};
  const glm::dvec2 centre = glm::floor(place / kGrid + 0.5) * kGrid;

  struct Tower {
    glm::dvec3 middle;
    double height, weight;
  };
  std::vector<Tower> towers;
  double deepest = 0.0, whole = 0.0;
  for (const Layer& layer : scene.layers) {
    if (layer.cloud.shape != LayerShape::profile || !layer.weather.map.empty()) continue;
    // Weather drifts too little within a flash to tell.
    const Volume weather = bakeWeather(layer, centre, 2.0 * kReach, kTexels,
                                       {scene.wind.speed, scene.wind.from, std::floor(time)}, scene.seed);
    for (int j = 0; j < kTexels; ++j)
      for (int i = 0; i < kTexels; ++i) {
        const float* t = weather.texels.data() + (static_cast<std::size_t>(j) * kTexels + i) * 4;
        if (t[0] < kDeepest || (t[3] < 0.25f && t[2] < 0.25f)) continue;
        const glm::dvec2 at =
            centre + (glm::dvec2(i + 0.5, j + 0.5) / static_cast<double>(kTexels) - 0.5) * (2 * kReach);
        const double away = glm::length(at - place);
        if (away > kReach) continue;
        towers.push_back({glm::dvec3(at, static_cast<double>(layer.cloud.base) + t[1]), t[0],
                          1.0 / (1.0 + away * away / (kNear * kNear))});
        deepest = std::max(deepest, static_cast<double>(t[0]));
      }
  }
  std::erase_if(towers, [&](const Tower& t) { return t.height < 0.6 * deepest; });
  for (const Tower& t : towers) whole += t.weight;
  if (towers.empty()) return {};
  std::uint32_t state = stateOf(scene.lightning, when.number) ^ 0x5bd1e995u;
  double chosen = unitOf(state) * whole;
  std::size_t k = 0;
  while (k + 1 < towers.size() && chosen > towers[k].weight) chosen -= towers[k++].weight;
  Flash flash;
  // Charge sits where it freezes: a quarter to a half of a tower's height.
  flash.position = towers[k].middle + glm::dvec3(0.0, 0.0, (0.25 + 0.25 * unitOf(state)) * towers[k].height);
  flash.intensity = kIntensity * when.share * static_cast<double>(scene.lightning.brightness);
  return flash;
}

}  // namespace welkin
