#include "welkin/density/cloud_cache.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/density/bounds.hpp"
#include "welkin/density/hero_bounds.hpp"

namespace welkin {

namespace {

constexpr int kWeatherRows = 8;  // cell layers that share one look at the weather
constexpr float kSlack = 2.0f;   // m, of altitude: what rays straightened within a cell and float rounding may be off

// A box of cloud space relative to the anchor.
struct Box {
  glm::vec3 low, high;
};

// Lowest and highest values of a layer's weather over a rectangle.
struct WeatherInterval {
  Interval a, b, c, d;  // as the channels of profileWeather and nubisWeather
};

float smooth(float a, float b, float x) { return law::smoothstep(a, b, x); }

// Bounds of one layer's law over boxes.
class LayerBounds {
 public:
  LayerBounds(const law::LayerParams& layer, const law::ClipParams& clip, const WeatherCache& weather,
              const DensityTextures& noise)
      : c_(layer), clip_(clip), texels_(weather.main.width), a_(weather.mainView(), 0, TexelBounds::Kind::planes),
        b_(weather.mainView(), 1, TexelBounds::Kind::planes),
        extraA_(weather.extraView(), 0, TexelBounds::Kind::planes),
        extraB_(weather.extraView(), 1, TexelBounds::Kind::planes) {
    if (c_.shape == 0) {
      base_.emplace(noise.profileBase, 0);
      warpX_.emplace(noise.profileWarp, 0);
      warpY_.emplace(noise.profileWarp, 1);
      billows_.emplace(noise.profileDetail, 0);
      ridges_.emplace(noise.profileDetail, 1);
    } else {
      base_.emplace(noise.nubisBase, 0);
      lift_.emplace(noise.nubisBase, 1);
    }
  }

  // Of the extinction in a box of unsheared cloud space with the weather that surrounds it. Where that is not 0, a
  // closer look costs more and bounds more tightly.
  float extinctionIn(const Box& q, const WeatherInterval& around) const {
    if (q.high.z <= c_.bottom || q.low.z >= c_.top) return 0.0f;
    if (c_.shape != 0) return nubisIn(q, around);
    return profileIn(q, around, {}) > 0.0f ? profileIn(q, weatherAt(q), leastDetail(q)) : 0.0f;
  }

  // Of the weather that points of the unsheared box read wherever the warp may lead them.
  WeatherInterval weatherNear(const Box& q) const {
    const float reach = c_.shape == 0 ? 0.5f * c_.warp * rise(q.high.z) : 0.0f;
    return weatherIn(glm::vec2(q.low) - reach, glm::vec2(q.high) + reach);
  }

  // The box that unsheared() makes of a box.
  Box unsheared(const Box& box) const {
    const auto lean = [&](float z) { return c_.shear * (z - c_.base) / c_.thickness; };
    const float a = lean(box.low.z), b = lean(box.high.z), least = std::min(a, b), most = std::max(a, b);
    const auto spread = [&](float downwind, float& low, float& high) {
      low -= std::max(downwind * least, downwind * most);
      high -= std::min(downwind * least, downwind * most);
    };
    Box q = box;
    spread(c_.downwindX, q.low.x, q.high.x);
    spread(c_.downwindY, q.low.y, q.high.y);
    return q;
  }

 private:
  static WeatherInterval join(const WeatherInterval& x, const WeatherInterval& y) {
    const auto both = [](const Interval& p, const Interval& q) {
      return Interval{std::min(p.low, q.low), std::max(p.high, q.high)};
    };
    return {both(x.a, y.a), both(x.b, y.b), both(x.c, y.c), both(x.d, y.d)};
  }

  // Bounds of one channel of a noise.
  class NoiseBounds {
   public:
    NoiseBounds(const Volume& noise, int channel)
        : edge_(static_cast<float>(noise.width)), bounds_(noise.view(), channel, TexelBounds::Kind::volume) {}
    // `tiles`: offset in tiles, and 1 / tile.
    Interval in(const Box& q, const glm::vec4& tiles) const {
      return bounds_.between((q.low * tiles.w + glm::vec3(tiles)) * edge_,
                             (q.high * tiles.w + glm::vec3(tiles)) * edge_);
    }

   private:
    float edge_;
    TexelBounds bounds_;
  };

  // Of profileColumn's sideways warp.
  float rise(float z) const { return law::saturate((z - c_.base) * 0.0025f); }

  // Of the weather that points of the unsheared box read.
  WeatherInterval weatherAt(const Box& q) const {
    const float least = c_.warp * rise(q.low.z), most = c_.warp * rise(q.high.z);
    const Interval x = warpX_->in(q, c_.warping), y = warpY_->in(q, c_.warping);
    const auto lowest = [&](float n) { return std::min(least * (n - 0.5f), most * (n - 0.5f)); };
    const auto highest = [&](float n) { return std::max(least * (n - 0.5f), most * (n - 0.5f)); };
    return weatherIn(glm::vec2(q.low) + glm::vec2(lowest(x.low), lowest(y.low)),
                     glm::vec2(q.high) + glm::vec2(highest(x.high), highest(y.high)));
  }

  // The least of what carves: ridges at the base, billows above.
  struct Detail {
    float ridges = 0.0f, billows = 0.0f;
  };
  Detail leastDetail(const Box& q) const {
    return {std::max(1.0f - ridges_->in(q, c_.detailing).high, 0.0f),
            std::max(1.0f - billows_->in(q, c_.detailing).high, 0.0f)};
  }

  WeatherInterval weatherIn(const glm::vec2& low, const glm::vec2& high) const {
    WeatherInterval found{};
    bool any = false;
    for (int level = 0; level < clip_.count; ++level) {
      const law::ClipLevel& l = levelOf(clip_, level);
      const glm::vec2 offset(l.offsetX, l.offsetY);
      const glm::vec2 uvLow = low * l.inverseSize + offset, uvHigh = high * l.inverseSize + offset;
      const float inner = l.margin;  // lookups use this level between inner and 1 - inner, the last one everywhere
      const bool last = level + 1 == clip_.count;
      if (!last && (uvHigh.x < inner || uvHigh.y < inner || uvLow.x > 1 - inner || uvLow.y > 1 - inner)) continue;
      const float slice = clip_.firstSlice + static_cast<float>(level);
      const glm::vec3 from(uvLow * static_cast<float>(texels_), slice), to(uvHigh * static_cast<float>(texels_), slice);
      const WeatherInterval here{a_.between(from, to), b_.between(from, to), extraA_.between(from, to),
                                 extraB_.between(from, to)};
      found = any ? join(found, here) : here;
      any = true;
      if (uvLow.x > inner && uvLow.y > inner && uvHigh.x < 1 - inner && uvHigh.y < 1 - inner) break;
    }
    return found;
  }

  // profileExtinctionIn with every argument at the end of its range that gives the most.
  float profileIn(const Box& q, const WeatherInterval& w, const Detail& detail) const {
    const float low = q.low.z - c_.base - w.b.high, high = q.high.z - c_.base - w.b.low;  // height above the base
    const float height = w.a.high;
    const auto amplitudeOf = [&](float h) { return std::min(c_.lengthScale, c_.lengthFraction * h + c_.minLength); };
    const float amplitude = amplitudeOf(height), least = amplitudeOf(w.a.low);
    const float inside = height - low;
    float profile = std::min({inside / (inside > 0.0f ? least : amplitude), 1.0f, (height - 20.0f) * 0.02f});
    // In m; a smooth maximum with k = 0.3 exceeds both by k / 4 at most.
    const float joint = c_.hasAnvil != 0 ? 0.075f * amplitude : 0.0f;
    float sheet = -INFINITY;
    if (c_.hasAnvil != 0 && w.c.high > 0.0f)
      sheet = std::min(2.5f * (law::anvilCeiling(w.c.high, c_) - low),
                       law::anvilThickness(w.c.high, c_) - law::anvilCeiling(0.0f, c_) + high);
    // Where either of them is this far outside, a point with cloud belongs to the other alone.
    const float fine = 0.5f * c_.fineDetail;
    const bool ice = sheet > -0.2f * amplitude - fine;
    const bool water = profile > -0.2f - fine / least || low < 0.65f * c_.thickness;
    const float eaten =
        ice ? 0.0f : c_.erosion * (c_.baseErosion + (1.0f - c_.baseErosion) * smooth(0.0f, 260.0f, low));
    if (!ice && profile * least + joint <= -fine) return 0.0f;
    const Interval n = base_->in(q, c_.noise);
    const float cut = c_.baseCut * (1.0f - law::saturate(high * 0.00333333f));
    const auto metres = [&](float share) { return share * (share > 0.0f ? amplitude : least); };
    float depth = metres(profile - eaten * (1.0f - n.high) - cut);
    const auto carved = [&](float h) {
      return c_.detail * glm::mix(detail.ridges, detail.billows, law::saturate(h * 0.00285714f));
    };
    if (ice)
      depth = std::max(depth, sheet);  // which detail carves less
    else
      depth -= std::min(carved(low), carved(high));
    depth += joint + fine;  // the finest detail adds, too
    const float ramp = ice ? std::max(c_.inverseRamp, c_.anvilRamp) : c_.inverseRamp;
    const float dense =
        law::saturate(depth * ramp) * smooth(0.0f, c_.baseFade, high + 2.0f * c_.baseRagged * (n.high - 0.5f));
    const float liquid = 1.0f - c_.liquidGradient + c_.liquidGradient * std::sqrt(law::saturate(high / c_.thickness));
    return c_.extinction * dense * liquid * std::max(water ? 1.0f : 0.0f, ice ? c_.anvilDensity : 0.0f);
  }

  // nubisExtinctionIn likewise; the height profiles are at most 1.
  float nubisIn(const Box& q, const WeatherInterval& w) const {
    const float low = (q.low.z - c_.base - w.d.high) / c_.thickness;
    const float high = (q.high.z - c_.base - w.d.low) / c_.thickness;
    if (high <= 0.0f || low >= 0.95f) return 0.0f;  // above, every profile is 0
    // remap(x, y - 1, 1, 0, 1) = (x - y + 1) / (2 - y) grows with x, and with y where x > 1 only.
    const Interval x = base_->in(q, c_.noise), y = lift_->in(q, c_.noise);
    const auto lifted = [&](float lift) { return (x.high - lift + 1.0f) / (2.0f - lift); };
    const float base = std::max(lifted(y.low), lifted(y.high));
    return c_.extinction * law::applyCoverage(std::max(base, 0.0f), w.a.high);
  }

  law::LayerParams c_;
  law::ClipParams clip_;
  int texels_;
  TexelBounds a_, b_, extraA_, extraB_;
  std::optional<NoiseBounds> base_, lift_, warpX_, warpY_, billows_, ridges_;
};

// The box of cells `from` to `to` of a column, a little enlarged.
Box boxOf(const MajorantLevel& level, std::size_t column, int from, int to) {
  const glm::vec2 corner(static_cast<float>(column % static_cast<std::size_t>(level.n)),
                         static_cast<float>(column / static_cast<std::size_t>(level.n)));
  // Rounding of a sample's place against its cell, and the least step of a ray.
  const float loose = std::max(1e-6f * level.cell * static_cast<float>(level.n), 0.3f);
  const glm::vec2 low = glm::vec2(level.origin) + corner * level.cell;
  const float z = level.origin.z + static_cast<float>(from) * level.height;
  return {{low - loose, z - kSlack},
          {low + level.cell + loose, z + static_cast<float>(to - from) * level.height + kSlack}};
}

// Adds a layer's bounds to those of a column of cells.
void addColumn(const LayerBounds& layer, const MajorantLevel& level, std::size_t column, std::vector<float>& sums) {
  for (int first = 0; first < level.layers; first += kWeatherRows) {
    const int end = std::min(first + kWeatherRows, level.layers);
    const WeatherInterval weather = layer.weatherNear(layer.unsheared(boxOf(level, column, first, end)));
    for (int k = first; k < end; ++k)
      sums[static_cast<std::size_t>(k)] += layer.extinctionIn(layer.unsheared(boxOf(level, column, k, k + 1)), weather);
  }
}

// Writes into empty cells how far away the nearest one with cloud is (chessboard distance, by the two passes of
// Rosenfeld and Pfaltz 1966). Beyond the level's sides nothing is known, below and above it there is no cloud.
void markEmptiness(const MajorantLevel& level, float* bounds) {
  const int n = level.n, layers = level.layers;
  const auto cell = [&](int i, int j, int k) -> float& {
    return bounds[(static_cast<std::size_t>(k) * n + static_cast<std::size_t>(j)) * n + static_cast<std::size_t>(i)];
  };
  const auto distance = [&](int i, int j, int k) { return std::max(-cell(i, j, k), 0.0f); };
  const auto pass = [&](int way) {
    const auto at = [&](int index, int count) { return way > 0 ? index : count - 1 - index; };
    for (int kk = 0; kk < layers; ++kk)
      for (int jj = 0; jj < n; ++jj)
        for (int ii = 0; ii < n; ++ii) {
          const int i = at(ii, n), j = at(jj, n), k = at(kk, layers);
          if (cell(i, j, k) > 0.0f) continue;
          float least = static_cast<float>(std::min({i + 1, n - i, j + 1, n - j}));
          if (way < 0) least = std::min(least, distance(i, j, k));
          const auto look = [&](int x, int y, int z) {
            if (x < 0 || y < 0 || x >= n || y >= n || z < 0 || z >= layers) return;
            least = std::min(least, distance(x, y, z) + 1.0f);
          };
          for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) look(i + x, j + y, k - way);
          for (int x = -1; x <= 1; ++x) look(i + x, j - way, k);
          look(i - way, j, k);
          cell(i, j, k) = -least;
        }
  };
  pass(1);
  pass(-1);
}

// Bounds of a grid's extinction over boxes of cloud space, from those of its bricks.
class GridBounds {
 public:
  explicit GridBounds(const CachedGrid& grid) : grid_(grid), maxima_(brickMaxima(*grid.voxels)) {}

  float extinctionIn(const Box& box) const {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec4 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z, 1.0f);
      const glm::vec3 v(glm::dot(grid_.rows[0], p), glm::dot(grid_.rows[1], p), glm::dot(grid_.rows[2], p));
      low = glm::min(low, v);
      high = glm::max(high, v);
    }
    // The voxels that filtering reads there; a hundredth of one for rounding.
    const VoxelGrid& g = *grid_.voxels;
    const glm::ivec3 n = g.dims(), bricks = g.brickDims();
    if (glm::any(glm::lessThan(high, glm::vec3(-0.51f))) || glm::any(glm::greaterThan(low, glm::vec3(n) - 0.49f)))
      return 0.0f;
    const glm::ivec3 first = glm::clamp(glm::ivec3(glm::floor(low - 0.01f)), glm::ivec3(0), n - 1);
    const glm::ivec3 last = glm::clamp(glm::ivec3(glm::floor(high + 0.01f)) + 1, glm::ivec3(0), n - 1);
    float most = 0.0f;
    for (int z = first.z / VoxelGrid::kBrick; z <= last.z / VoxelGrid::kBrick; ++z)
      for (int y = first.y / VoxelGrid::kBrick; y <= last.y / VoxelGrid::kBrick; ++y)
        for (int x = first.x / VoxelGrid::kBrick; x <= last.x / VoxelGrid::kBrick; ++x) {
          const float brick =
              maxima_[(static_cast<std::size_t>(z) * bricks.y + static_cast<std::size_t>(y)) * bricks.x +
                      static_cast<std::size_t>(x)];
          if (brick <= most) continue;
          const glm::ivec3 corner = glm::ivec3(x, y, z) * VoxelGrid::kBrick, end = corner + VoxelGrid::kBrick - 1;
          if (glm::all(glm::lessThanEqual(first, corner)) && glm::all(glm::greaterThanEqual(last, end)))
            most = brick;
          else
            most = std::max(most, maximumIn(glm::max(first, corner), glm::min(last, end)));
        }
    return grid_.extinction * most;
  }

 private:
  float maximumIn(const glm::ivec3& first, const glm::ivec3& last) const {
    float most = 0.0f;
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) most = std::max(most, grid_.voxels->at({x, y, z}));
    return most;
  }

  const CachedGrid& grid_;
  std::vector<float> maxima_;
};

CachedGrid cachedGrid(const PlacedGrid& grid, const glm::dvec3& anchor) {
  if (grid.voxels->values().size() > std::size_t{1} << 31)
    throw Error(ErrorKind::badInput, "", "a grid of more than 2^31 voxels in use is too large to trace; split it");
  CachedGrid cached{grid.voxels, {}, grid.extinction};
  const glm::dvec3 ground(anchor.x, anchor.y, 0.0);  // altitude is absolute
  for (int row = 0; row < 3; ++row) {
    glm::dvec4 r(grid.fromWorld[0][row], grid.fromWorld[1][row], grid.fromWorld[2][row], grid.fromWorld[3][row]);
    r.w += glm::dot(glm::dvec3(r), ground) - grid.voxels->origin()[row];
    r /= grid.voxels->voxel()[row];
    r.w -= 0.5;
    cached.rows[row] = glm::vec4(r);
  }
  return cached;
}

// Where the levels stand and how many there are: round the anchor as far as the weather is known, or, where grids and
// hero clouds are all there is, round those.
void placeLevels(Majorants& m, const CloudCache& cache, const WorldBox& solids, const CloudCacheExtent& extent) {
  double cell = extent.finestCell, reach = 0.5 * extent.weather.edge(extent.weather.levels - 1);
  const bool scattered = std::any_of(cache.heroes.begin(), cache.heroes.end(),
                                     [](const CachedHero& hero) { return hero.body.scatter.any(); });
  if (cache.layers.empty() && !scattered) {
    m.centre = glm::vec2(0.5 * (solids.low + solids.high));
    reach = 1.0 + 0.5 * std::max(solids.high.x - solids.low.x, solids.high.y - solids.low.y);
    cell = 2.0 * reach / extent.cells;
  } else if (!cache.grids.empty() || !cache.heroes.empty()) {
    for (const double edge : {solids.low.x, solids.low.y, solids.high.x, solids.high.y})
      reach = std::max(reach, std::abs(edge));
  }
  const std::size_t plane = static_cast<std::size_t>(extent.cells) * extent.cells;
  for (;; cell *= 2.0) {
    MajorantLevel level;
    level.cell = static_cast<float>(cell);
    level.n = extent.cells;
    level.layers = extent.cellLayers;
    level.height = (m.top - m.bottom) / static_cast<float>(level.layers);
    level.origin = glm::vec3(m.centre - 0.5f * level.cell * static_cast<float>(level.n), m.bottom);
    level.offset = m.bounds.size();
    m.bounds.resize(level.offset + plane * static_cast<std::size_t>(level.layers));
    m.levels.push_back(level);
    if (0.5 * cell * extent.cells >= reach * 0.999) break;
  }
}

Majorants bakeMajorants(const CloudCache& cache, const WorldBox& solids, const CloudCacheExtent& extent) {
  Majorants m;
  if (cache.layers.empty() && cache.grids.empty() && cache.heroes.empty()) return m;
  m.bottom = INFINITY, m.top = -INFINITY;
  std::vector<LayerBounds> layers;
  for (std::size_t i = 0; i < cache.layers.size(); ++i) {
    const law::LayerParams& layer = cache.layers[i];
    m.bottom = std::min(m.bottom, layer.bottom);
    m.top = std::max(m.top, layer.top);
    layers.emplace_back(layer, cache.weather.clips[i], cache.weather, cache.noise);
  }
  std::vector<GridBounds> grids;
  for (const CachedGrid& grid : cache.grids) grids.emplace_back(grid);
  std::optional<TexelBounds> billows;
  if (!cache.heroes.empty()) billows.emplace(cache.noise.heroBillows.view(), 0, TexelBounds::Kind::volume);
  std::vector<HeroBounds> heroes;
  for (const CachedHero& hero : cache.heroes)
    heroes.emplace_back(hero.params, *hero.body.parts, hero.body.shapeView(), *billows);
  if (!grids.empty() || !heroes.empty()) {
    m.bottom = std::min(m.bottom, static_cast<float>(solids.low.z));
    m.top = std::max(m.top, static_cast<float>(solids.high.z));
  }
  m.bottom -= kSlack;
  m.top += kSlack;
  placeLevels(m, cache, solids, extent);
  for (const MajorantLevel& level : m.levels) {
    const std::size_t plane = static_cast<std::size_t>(level.n) * level.n;
    parallelFor(plane, 16, [&](std::size_t begin, std::size_t end) {
      std::vector<float> sums(static_cast<std::size_t>(level.layers));
      for (std::size_t at = begin; at < end; ++at) {
        std::fill(sums.begin(), sums.end(), 0.0f);
        for (const LayerBounds& layer : layers) addColumn(layer, level, at, sums);
        for (const GridBounds& grid : grids)
          for (int k = 0; k < level.layers; ++k)
            sums[static_cast<std::size_t>(k)] += grid.extinctionIn(boxOf(level, at, k, k + 1));
        for (const HeroBounds& hero : heroes)
          for (int k = 0; k < level.layers; ++k) {
            const Box box = boxOf(level, at, k, k + 1);
            sums[static_cast<std::size_t>(k)] += hero.extinctionIn(box.low, box.high);
          }
        for (std::size_t k = 0; k < sums.size(); ++k)
          m.bounds[level.offset + k * plane + at] = sums[k] * 1.0001f;  // rounding
      }
    });
  }
  parallelFor(m.levels.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) markEmptiness(m.levels[i], m.bounds.data() + m.levels[i].offset);
  });
  return m;
}

}  // namespace

CloudCache bakeCloudCache(const DensityParts& parts, const DensityTextures& textures, const glm::dvec3& anchor,
                          const CloudCacheExtent& extent) {
  CloudCache cache;
  cache.noise = bakeDensityTextures(parts, textures);
  for (const Layer& layer : parts.layers) cache.layers.push_back(layerParams(layer, anchor, parts.drift));
  for (const Sheet& sheet : parts.sheets)
    cache.sheets.push_back(sheetParams(sheet, glm::dvec2(anchor), parts.drift.time, parts.seed));
  if (!parts.layers.empty())
    cache.weather =
        bakeWeatherLevels(parts.layers, extent.weather, glm::dvec2(anchor), parts.drift, parts.seed, parts.weatherMaps);
  WorldBox box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  ClassicalClouds classical;
  classical.update(parts.classical, parts.drift, parts.seed);
  std::vector<PlacedGrid> grids = classical.placed();
  grids.insert(grids.begin(), parts.grids.begin(), parts.grids.end());
  for (const PlacedGrid& grid : grids) {
    cache.grids.push_back(cachedGrid(grid, anchor));
    const WorldBox b = boundsOf(grid);
    const glm::dvec3 ground(anchor.x, anchor.y, 0.0);
    box.low = glm::min(box.low, b.low - ground);
    box.high = glm::max(box.high, b.high - ground);
  }
  for (const Hero& hero : parts.heroes) {
    HeroBody body = bakeHero(hero, parts.drift, parts.seed);
    const glm::dvec3 ground(anchor.x, anchor.y, 0.0);
    box.low = glm::min(box.low, body.lowest() - ground);
    box.high = glm::max(box.high, body.highest() - ground);
    cache.heroes.push_back({body.paramsAt(glm::dvec2(anchor)), std::move(body)});
  }
  cache.majorants = bakeMajorants(cache, box, extent);
  return cache;
}

float extinctionIn(const CloudCache& cache, const glm::vec3& point) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < cache.layers.size(); ++i) {
    const law::LayerParams& c = cache.layers[i];
    const WeatherCache& w = cache.weather;
    const DensityTextures& t = cache.noise;
    sum += (c.shape == 0 ? law::profileExtinction(point, 0.0f, 0.0f, c, w.clips[i], w.mainView(), w.extraView(),
                                                  t.profileBase.view(), t.profileDetail.view(), t.profileWarp.view())
                         : law::nubisExtinction(point, true, 0.0f, c, w.clips[i], w.mainView(), w.extraView(),
                                                t.nubisBase.view(), t.nubisDetail.view(), t.curl.view()))
               .x;
  }
  for (const CachedGrid& grid : cache.grids) {
    const glm::vec4 p(point, 1.0f);
    const VoxelGrid& v = *grid.voxels;
    const glm::dvec3 voxel(glm::dot(grid.rows[0], p), glm::dot(grid.rows[1], p), glm::dot(grid.rows[2], p));
    sum += grid.extinction * v.interpolate(v.origin() + (voxel + 0.5) * v.voxel());
  }
  for (const CachedHero& hero : cache.heroes)
    sum += law::heroExtinction(point, 0.0f, hero.params, *hero.body.parts, hero.body.shapeView(),
                               cache.noise.heroBillows.view());
  return sum;
}

float majorantAt(const Majorants& m, const glm::vec3& point) {
  for (const MajorantLevel& level : m.levels) {
    const glm::ivec3 i(glm::floor((point - level.origin) / glm::vec3(level.cell, level.cell, level.height)));
    if (i.x < 0 || i.y < 0 || i.z < 0 || i.x >= level.n || i.y >= level.n || i.z >= level.layers) continue;
    return std::max(
        m.bounds[level.offset + (static_cast<std::size_t>(i.z) * level.n + static_cast<std::size_t>(i.y)) * level.n +
                 static_cast<std::size_t>(i.x)],
        0.0f);
  }
  return 0.0f;
}

}  // namespace welkin
