#include "welkin/realtime/march_params.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/atmosphere/params.hpp"
#include "welkin/scene/rain.hpp"
#include "welkin/scene/scatterers.hpp"

namespace welkin::realtime {

namespace {

// A march of 64 steps at the zenith and 128 at the horizon (004 ch. 4.5.1), by fixed steps; physical skies step by
// distance.
constexpr int kZenithSteps = 64, kHorizonSteps = 128;
constexpr float kStepPerMetre = 0.004f, kMinStep = 12.0f, kMaxStep = 250.0f;  // look: the coarsest without hatching
constexpr float kFar = 300000.0f;                                             // m, where clouds have faded into the air
// Toward the sun before the light volume: so far in all, about a texel of it.
constexpr float kNearReach = 105.0f, kNearRatio = 2.2f;
constexpr int kMaxTurns = 20000;  // a cap that no ray of a plausible sky meets; a test counts

// How much of a closed layer's depth the marches toward the light have to see, lest its underside be lit as if sun and
// sky shone from within; 0 where no layer is closed.
double closedDepth(const Scene& scene) {
  double depth = 0.0;
  for (const Layer& layer : scene.layers)
    if (layer.weather.coverage > 0.85f) depth = std::max(depth, 0.9 * layer.cloud.thickness);
  return depth;
}

// How far the march toward the sun goes: as far as 9 steps of ratio 1.6, which large clouds need, if not farther.
double lightReach(double closed, float sunHeight) {
  constexpr double kReach = 1690.0, kFarthest = 6000.0;
  return std::min(std::max(kReach, closed / std::max(sunHeight, 0.1f)), kFarthest);
}

// Steps upward, at least `steps`, that reach well into a closed layer, but not through its uneven top, where they would
// give salt; first step and ratio as in march.glsl.
int ambientSteps(double closed, int steps) {
  constexpr double kFirst = 60.0, kRatio = 2.5;
  while (steps > 0 && steps < 8 && kFirst * (std::pow(kRatio, steps) - 1.0) / (kRatio - 1.0) < 0.48 * closed) ++steps;
  return steps;
}

// Ratio of a geometric series of `steps` terms from kLightFirst (march.glsl) that reaches so far.
float lightRatio(int steps, double reach) {
  constexpr double kFirst = 15.0;
  double low = 1.0001, high = 200.0;
  for (int i = 0; i < 60; ++i) {
    const double ratio = 0.5 * (low + high);
    (kFirst * (std::pow(ratio, steps) - 1.0) / (ratio - 1.0) < reach ? low : high) = ratio;
  }
  return static_cast<float>(low);
}

// What the layers together do to the light below them: the share of sky that they cover, and the share of light that
// gets through there (two-stream, conservative: 1 / (1 + 3/4 (1 - g) tau), g = 0.86). Optical depths are estimates from
// the layers' settings: this steers only the light of ground and air under the clouds.
struct Veil {
  float cover = 0.0f, through = 1.0f;
};
Veil veilOf(const Scene& scene) {
  Veil veil;
  for (const Layer& layer : scene.layers) {
    const float depth = 0.4f * layer.cloud.extinction * layer.cloud.thickness;
    veil.cover = 1.0f - (1.0f - veil.cover) * (1.0f - layer.weather.coverage);
    veil.through /= 1.0f + 0.75f * 0.14f * depth * (1.0f + layer.weather.precipitation);
  }
  return veil;
}

// Mean optical depth of a sheet as far as it turns light aside, from places over many of its patches.
float turnedDepth(const Sheet& sheet, int seed) {
  constexpr int kPlaces = 12;
  constexpr float kApart = 7300.0f;  // m, half a patch
  const law::SheetParams p = sheetParams(sheet, glm::dvec2(0.0), 0.0, seed);
  float sum = 0.0f;
  for (int i = 0; i < kPlaces * kPlaces; ++i)
    sum += law::sheetOpticalDepth(kApart * glm::vec2(i % kPlaces, i / kPlaces), p);
  return sum / (kPlaces * kPlaces) * law::sheetTurned(p);
}

// What sky and sun send to the clouds below the sheets, in the mean: a sheet turns back a part of the light of the air
// above it (two-stream, as in veilOf), and half of the sunlight that it turns aside comes down from it as from a sky.
SkyLight belowSheets(const Scene& scene, SkyLight light, float sunHeight) {
  constexpr float kAirHeight = 8000.0f, kPi = 3.14159265f;  // m, over which the air's density falls to 1 / e
  for (const Sheet& sheet : scene.sheets) {
    const float depth = turnedDepth(sheet, scene.seed);
    const float slant = std::sqrt(sunHeight * sunHeight + 2.0f * sheet.height / static_cast<float>(kPlanetRadius));
    const float sun = std::exp(-depth / slant), sky = 1.0f / (1.0f + 0.75f * depth);
    const float dimmed = 1.0f - std::exp(-sheet.height / kAirHeight) * (1.0f - sky);
    const glm::vec3 turned = light.sunIrradiance * (sunHeight * 0.5f * (1.0f - sun));
    light.skyIrradiance = light.skyIrradiance * dimmed + turned;
    light.meanRadiance = light.meanRadiance * dimmed + turned / kPi;
    light.sunIrradiance *= sun;
  }
  return light;
}

// What light that is turned aside once sends toward the eye, as a share of an irradiance of 1: 1/4 in a medium that
// scatters evenly; by FLIP on bench/error.cpp's cumulus, stratocumulus and cumulonimbus.
constexpr float kOnce = 0.3f;

// What aerosol, which scatters forward, sends along a level ray of the light below clouds, against the same light from
// all directions above: it comes from near the horizon, where an overcast sky has 3/7 of its mean brightness (Moon and
// Spencer 1942). By the path tracer's hazy air, between what a closed deck and broken clouds ask for.
constexpr float kLevelLight = 0.55f;

// Share of the aerosol in what air at the ground scatters.
glm::vec3 aerosolShare(const Atmosphere& atmosphere) {
  const law::AtmosphereParams air = makeAtmosphereParams(atmosphere, glm::vec3(0.0f, 0.0f, 1.0f), 0.0);
  const glm::vec3 mie = glm::vec3(air.mieScattering) * (1.0f + air.haze);
  return mie / (mie + glm::vec3(air.rayleigh));
}

// Light that has been scattered so often that it comes from above without direction, as a share of what falls on the
// top: by eye, until it is fitted to a reference.
constexpr float kDiffusedShare = 0.22f;

}  // namespace

law::MarchParams marchParams(const Scene& scene, const law::PlanetParams& planet, const glm::vec3& sunDirection,
                             const SkyLight& clear, float pixelAngle, bool drawGround, std::span<const Shell> grids,
                             float gridExtinction) {
  const LightingSettings& l = scene.lighting;
  const Quality& q = scene.quality;
  law::MarchParams m{};
  m.planet = planet;
  m.sun = glm::vec4(sunDirection, l.powder);
  const float sunHeight = std::max(sunDirection.z, 0.0f);
  const SkyLight light = belowSheets(scene, clear, sunHeight);
  const Veil veil = veilOf(scene);
  // Level decks have the sky above them, single clouds as much of it beside them.
  const glm::vec3 above = light.skyIrradiance / 3.14159265f;
  m.ambientSky = glm::vec4(glm::mix(light.meanRadiance, above, veil.cover), l.ambient);
  m.skyAround = glm::vec4(light.meanRadiance, 0.0f);
  m.skyOpen = glm::vec4(light.skyIrradiance, 0.0f);
  const glm::vec3 direct = sunHeight * light.sunIrradiance;
  const glm::vec3 diffuse =
      (1.0f - veil.cover) * light.skyIrradiance + veil.cover * veil.through * (direct + light.skyIrradiance);
  const glm::vec3 ground = scene.ground.albedo * ((1.0f - veil.cover) * direct + diffuse) / 3.14159265f;
  m.ambientGround = glm::vec4(ground, l.groundBounce);
  m.diffused = glm::vec4((direct + light.skyIrradiance) / 3.14159265f, kDiffusedShare * l.ambient);
  m.groundAlbedo = glm::vec4(scene.ground.albedo, drawGround ? 1.0f : 0.0f);
  m.bottom = 1e9f;
  m.top = -1e9f;
  m.earlyExit = q.earlyExit ? 0.01f : -1.0f;
  float albedo = 1.0f;
  for (const Layer& layer : scene.layers) {
    const Shell shell = shellOf(layer);
    m.bottom = std::min(m.bottom, shell.bottom);
    m.top = std::max(m.top, shell.top);
    albedo = std::min(albedo, layer.cloud.albedo);
  }
  for (const Shell& shell : grids) {
    m.bottom = std::min(m.bottom, shell.bottom);
    m.top = std::max(m.top, shell.top);
  }
  for (const GridCloud& grid : scene.grids)
    if (!grid.file.empty()) albedo = std::min(albedo, grid.albedo);
  for (const Classical& cloud : scene.classical) albedo = std::min(albedo, cloud.cloud.albedo);
  for (const Hero& hero : scene.heroes) albedo = std::min(albedo, hero.cloud.albedo);
  if (m.top < m.bottom) m.bottom = -10.0f, m.top = -5.0f;  // below ground: no ray marches
  m.skyIrradiance = glm::vec4(diffuse, albedo);
  // Air in the shade sees the clouds above, the gaps between them, and the ground.
  const glm::vec3 aerosol = aerosolShare(scene.atmosphere);
  const glm::vec3 below =
      0.5f * (glm::vec3(1.0f) + scene.ground.albedo) * (glm::vec3(1.0f) - (1.0f - kLevelLight) * aerosol);
  m.shadedAir = q.lightVolume && l.model != LightingModel::nubis ? glm::vec4(below / 3.14159265f, 0.0f)
                                                                 : glm::vec4(below * diffuse / 3.14159265f, veil.cover);
  m.rain = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f - veil.cover);
  for (const Layer& layer : scene.layers)
    if (rains(scene, layer)) m.rain.x = std::max(m.rain.x, rainTop(layer));
  m.stepScale = kStepPerMetre * q.stepScale;
  m.minStep = kMinStep * std::min(q.stepScale, 1.5f);
  m.maxStep = kMaxStep;
  m.maxDistance = kFar;
  m.footprintPerMetre = pixelAngle;
  m.contribution = l.contribution;
  m.octaveExtinction = l.octaveExtinction;
  m.eccentricity = l.eccentricity;
  m.octaveGain = l.octaveGain;
  m.forwardG = l.forwardG;
  m.backwardG = l.backwardG;
  m.backwardWeight = l.backwardWeight;
  m.rainAbsorption = l.rainAbsorption;
  // g / ((1 - g) extinction); most of a cloud is thinner than the most that there is.
  float extinction = 0.75f * gridExtinction;
  for (const Layer& layer : scene.layers) extinction = std::max(extinction, 0.75f * layer.cloud.extinction);
  m.transportPath = std::min(0.86f / (0.14f * std::max(extinction, 1e-4f)), 300.0f);
  m.once = kOnce;
  m.octaves = l.octaves;
  const std::optional<Scatterers> scatterers = leadingScatterers(scene);
  if (l.phase == PhaseModel::droplets && scatterers) {
    const law::MiePhase& mie = scatterers->phase;
    m.droplets = {mie.gHG, mie.gDraine, mie.alpha, mie.wDraine};
    m.useDroplets = 1;
  }
  m.lightSteps = q.lightSteps;
  m.ambientSteps = ambientSteps(closedDepth(scene), q.ambientSteps);
  m.refine = q.refine ? 1 : 0;
  m.maxTurns = kMaxTurns;
  // A step of the ground's light is no longer than the edges of shadows are wide; without limit it would cost too much.
  m.groundSteps = static_cast<int>(std::clamp((m.top - m.bottom) / 150.0f, 32.0f, 96.0f));
  m.lightRatio = lightRatio(q.lightSteps, lightReach(closedDepth(scene), sunHeight));
  if (q.lightVolume && l.model != LightingModel::nubis) {
    // The light volume sees the rest.
    m.lightSteps = std::clamp(q.lightSteps / 4, 1, 3);
    m.ambientSteps = 0;
    m.lightRatio = kNearRatio;
    m.nearReach = kNearReach;
  }
  if (l.model == LightingModel::nubis) {
    m.nubis = 1;
    m.lightSteps = 6;
    m.ambientSteps = 0;
    m.refine = 0;
    m.fixedSteps = q.stepsByAngle ? kZenithSteps : kHorizonSteps;
    m.fixedStepsHorizon = kHorizonSteps;
    m.cheapSearch = q.cheapSearch ? 1 : 0;
  }
  return m;
}

}  // namespace welkin::realtime
