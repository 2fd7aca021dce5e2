// Once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/trace/kernel.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <vector>

#include "welkin/atmosphere/law-inl.hpp"
#include "welkin/density/law-inl.hpp"
#include "welkin/scene/law-inl.hpp"
#include "welkin/trace/kernel.hpp"
#include "welkin/trace/phase_table-inl.hpp"
#include "welkin/trace/random-inl.hpp"
#include "welkin/trace/sky_distribution-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::trace::HWY_NAMESPACE {

namespace target = ::welkin::HWY_NAMESPACE;
namespace law = ::welkin::HWY_NAMESPACE::law;
using law::both, law::either, law::invert, law::noneOf, law::select;
using law::Int, law::Mask, law::Real, law::Uint, law::Vec2, law::Vec3, law::Vec4;
using target::Random, target::next, target::PhaseSample;

constexpr float kPi = 3.14159265f;
constexpr float kNever = 1e12f;  // m
constexpr float kLongStep =
    3500.0f;                 // m: straight air rises 1 m above its tangent over this way, half of what slabs allow
constexpr int kStrides = 6;  // pieces of empty air before the density is asked again
constexpr int kFreeScatterings = 2048;  // before roulette begins where the throughput does not fall: what it spares of
                                        // long paths comes back as few very bright ones
constexpr int kMostLevels = 4;          // of branches of branches
// Chance that a scattering asks for the sun: kAsking (sr) times what it would bring, as a share of the sun's
// irradiance, and no less than kLeastAsking; the first one always. By measured efficiency.
constexpr float kAsking = 20.0f, kLeastAsking = 0.05f;
// Chance of a branch: kBranching times the phase function toward the sun, summed over channels, within limits; by
// measured efficiency.
constexpr float kBranching = 1.0f, kLeastBranching = 0.05f, kMostBranching = 0.5f;

HWY_INLINE Mask andNot(Mask a, Mask b) { return both(a, invert(b)); }
HWY_INLINE std::size_t countOf(Mask m) { return law::hn::CountTrue(law::D(), m.m); }
HWY_INLINE Mask isComponent(Real component, std::size_t i) {
  return law::abs(component - static_cast<float>(i)) < 0.5f;
}
HWY_INLINE Real sumOf(Vec3 v) { return v.x + v.y + v.z; }
HWY_INLINE Real greatest(Vec3 v) { return law::max(law::max(v.x, v.y), v.z); }

// A unit vector at an angle of versine (1 - cos) v and azimuth 2 pi u about the unit vector d (frame after Duff et al.
// 2017, "Building an orthonormal basis, revisited").
HWY_INLINE Vec3 turned(Vec3 d, Real v, Real u) {
  const Real s = select(d.z < 0.0f, Real(-1.0f), Real(1.0f));
  const Real a = Real(-1.0f) / (s + d.z), b = d.x * d.y * a;
  const Vec3 x(1.0f + s * d.x * d.x * a, s * b, -s * d.x), y(b, s + d.y * d.y * a, -d.y);
  const Real sine = law::sqrt(law::max(v * (2.0f - v), 0.0f)), phi = u * (2.0f * kPi);
  return law::normalize(x * (sine * law::cos(phi)) + y * (sine * law::sin(phi)) + d * (1.0f - v));
}

// 1 - cos of the angle between unit vectors, exact for small ones.
HWY_INLINE Real versineBetween(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return law::min(0.5f * law::dot(d, d), Real(2.0f));
}

// A path in every lane. A lane either follows its path or asks how much of the sun reaches the place where the path was
// scattered; each turn asks the clouds for their density once.
class Paths {
 public:
  Paths(const KernelScene& scene, const TileJob& job, std::span<PixelSums> pixels)
      : s_(scene), job_(job), pixels_(pixels), m_(scene.clouds->majorants),
        planet_(std::bit_cast<law::PlanetParams>(scene.planet)), air_(std::bit_cast<law::AtmosphereParams>(scene.air)),
        camera_(std::bit_cast<law::CameraParams>(scene.camera)), night_(std::bit_cast<law::NightParams>(scene.night)),
        total_(static_cast<std::size_t>(job.width) * job.height * job.samples) {
    for (const auto& l : scene.clouds->layers) layers_.push_back(std::bit_cast<law::LayerParams>(l));
    for (const auto& c : scene.clouds->weather.clips) clips_.push_back(std::bit_cast<law::ClipParams>(c));
    for (const KernelRain& r : scene.rain) rain_.push_back(std::bit_cast<law::RainParams>(r.params));
    for (const auto& h : scene.clouds->sheets) sheets_.push_back(std::bit_cast<law::SheetParams>(h));
    for (const auto& h : scene.clouds->heroes) {
      heroes_.push_back(std::bit_cast<law::HeroParams>(h.params));
      parts_.push_back(std::bit_cast<law::HeroParts>(*h.body.parts));
    }
    hasAir_ = air_.rayleigh.x + air_.mieExtinction.x + air_.ozone.x > 0.0f;
    cloudTop_ = m_.levels.empty() ? -1.0f : m_.top;
    for (const KernelRain& r : scene.rain) cloudTop_ = std::max(cloudTop_, r.top + 2.0f);
    for (const auto& h : sheets_) cloudTop_ = std::max(cloudTop_, h.height + kSheetThickness + 2.0f);
    pathTop_ = scene.airScatters ? air_.thickness : cloudTop_;
    askScale_ = kAsking / std::max(air_.sunIrradiance.x + air_.sunIrradiance.y + air_.sunIrradiance.z, 1e-20f);
    sun_ = Vec3(air_.sunDirection.x, air_.sunDirection.y, air_.sunDirection.z);
    second_ = Vec3(air_.secondDirection.x, air_.secondDirection.y, air_.secondDirection.z);
  }

  KernelStatistics run() {
    alive_ = law::toMask(false);
    place_ = Vec3(Real(0.0f));
    way_ = Vec3(Real(0.0f), Real(0.0f), Real(1.0f));
    aim(alive_, Vec3(Real(0.0f)));
    clearLanes();
    for (;;) {
      refill();
      if (noneOf(alive_)) break;
      const Mask candidate = advance();
      ++statistics_.turns;
      collide(candidate);
    }
    return statistics_;
  }

 private:
  void clearLanes() {
    t_ = tau_ = end_ = Real(0.0f);
    muCloud_ = muAir_ = Real(0.0f);
    shadow_ = law::toMask(false);
    toGround_ = toSky_ = done_ = law::toMask(false);
    branches_ = law::toMask(false);
    level_ = Real(0.0f);
    share_ = Real(1.0f);
    for (Left& left : left_) {
      left.place = left.beta = left.ratio = left.way = Vec3(Real(0.0f));
      left.count = left.density = Real(0.0f);
    }
    branchBeta_ = branchWay_ = branchRatio_ = Vec3(Real(0.0f));
    nextDensity_ = branchDensity_ = Real(0.0f);
    beta_ = ratio_ = hero_ = light_ = single_ = pending_ = nextWay_ = Vec3(Real(0.0f));
    through_ = depth_ = clear_ = Real(0.0f);
    count_ = Real(0.0f);
    index_ = Uint(0u);
    random_ = {Uint(1u), Uint(2u), Uint(3u), Uint(4u)};
  }

  // Lanes without a path take the next ones of the tile, in order.
  void refill() {
    if (issued_ >= total_ || law::hn::AllTrue(law::D(), alive_.m)) return;
    const std::size_t lanes = law::laneCount();
    HWY_ALIGN float x[64], y[64], fresh[64];
    HWY_ALIGN std::uint32_t pixel[64], sample[64], at[64];
    law::hn::Store(select(alive_, Real(0.0f), Real(1.0f)).v, law::D(), fresh);
    for (std::size_t i = 0; i < lanes; ++i) {
      x[i] = y[i] = 0.0f;
      pixel[i] = sample[i] = at[i] = 0;
      if (fresh[i] == 0.0f) continue;
      if (issued_ >= total_) {
        fresh[i] = 0.0f;
        continue;
      }
      const auto count = static_cast<std::size_t>(job_.samples);
      const std::size_t p = issued_ / count;
      const int px = job_.x + static_cast<int>(p % static_cast<std::size_t>(job_.width));
      const int py = job_.y + static_cast<int>(p / static_cast<std::size_t>(job_.width));
      x[i] = static_cast<float>(px);
      y[i] = static_cast<float>(py);
      pixel[i] =
          static_cast<std::uint32_t>(py) * static_cast<std::uint32_t>(job_.imageWidth) + static_cast<std::uint32_t>(px);
      sample[i] = static_cast<std::uint32_t>(job_.firstSample) + static_cast<std::uint32_t>(issued_ % count);
      at[i] = static_cast<std::uint32_t>(p);
      ++issued_;
      ++statistics_.paths;
    }
    const Mask start = Real(law::hn::Load(law::D(), fresh)) > 0.5f;
    const Uint pixels(law::hn::Load(law::DU(), pixel)), samples(law::hn::Load(law::DU(), sample));
    random_ = target::select(start, target::seedRandom(job_.seed, pixels, samples), random_);
    index_ = select(start, Uint(law::hn::Load(law::DU(), at)), index_);
    const Real jitterX = next(random_, start), jitterY = next(random_, start);
    const Real fx = Real(law::hn::Load(law::D(), x)) + jitterX, fy = Real(law::hn::Load(law::D(), y)) + jitterY;
    const Vec2 ndc(fx * (2.0f / static_cast<float>(job_.imageWidth)) - 1.0f,
                   1.0f - fy * (2.0f / static_cast<float>(job_.imageHeight)));
    const Vec3 ray = law::normalize(law::cameraRay(ndc, camera_));
    const Real channel = law::floor(next(random_, start) * 3.0f);
    hero_ = select(start,
                   Vec3(select(channel < 0.5f, Real(1.0f), Real(0.0f)),
                        select(both(channel > 0.5f, channel < 1.5f), Real(1.0f), Real(0.0f)),
                        select(channel > 1.5f, Real(1.0f), Real(0.0f))),
                   hero_);
    const Vec3 one(Real(1.0f)), none(Real(0.0f));
    beta_ = select(start, one, beta_);
    ratio_ = select(start, one, ratio_);
    light_ = select(start, none, light_);
    single_ = select(start, none, single_);
    depth_ = select(start, Real(0.0f), depth_);
    clear_ = select(start, Real(1.0f), clear_);
    level_ = select(start, Real(0.0f), level_);
    branches_ = andNot(branches_, start);
    count_ = select(start, Real(0.0f), count_);
    place_ = select(start, none, place_);
    alive_ = either(alive_, start);
    begin(start, ray);
  }

  // Sends lanes on their path from place_ along `way`.
  void begin(Mask lanes, Vec3 way) {
    aim(lanes, way);
    shadow_ = andNot(shadow_, lanes);
    const Real altitude = law::altitudeAt(place_, planet_);
    // Places outside the air skip the way to it.
    const Vec3 fromCentre = Vec3(vec4(planet_.up)) * planet_.up.w + place_;
    const Real b = law::dot(fromCentre, way), c = altitude * (2.0f * planet_.radius + altitude);
    const Real disc = b * b - c;
    const Mask down = both(b<0.0f, disc> 0.0f);
    const Real ground = law::max(c / law::max(law::sqrt(law::max(disc, 0.0f)) - b, 1e-3f), 0.0f);
    end_ = select(lanes, select(down, ground, Real(kNever)), end_);
    const float top = std::max(pathTop_, 1.0f);
    const Real cTop = (altitude - top) * (2.0f * planet_.radius + altitude + top);
    const Real discTop = b * b - cTop;
    const Mask outside = altitude > top, enters = both(outside, both(b<0.0f, discTop> 0.0f));
    const Real entry = cTop / law::max(law::sqrt(law::max(discTop, 0.0f)) - b, 1e-3f);
    t_ = select(lanes, select(enters, entry, Real(0.0f)), t_);
    draw(lanes);
  }

  void aim(Mask lanes, Vec3 way) {
    way_ = select(lanes, way, way_);
    inverseX_ = Real(1.0f) / law::max(law::abs(way_.x), 1e-9f);
    inverseY_ = Real(1.0f) / law::max(law::abs(way_.y), 1e-9f);
  }

  void draw(Mask lanes) { tau_ = select(lanes, -law::log(1.0f - next(random_, lanes)), tau_); }

  static Vec3 vec4(const glm::vec4& v) { return Vec3(v.x, v.y, v.z); }

  // Moves all lanes until most stand at a tentative collision or have ended; answers which do.
  Mask advance() {
    Mask candidate = law::toMask(false);
    Mask moving = alive_;
    toGround_ = toSky_ = law::toMask(false);
    const std::size_t few = law::laneCount() / 4;
    for (int i = 0; i < kStrides; ++i) {
      stride(moving, candidate);
      if (countOf(moving) <= few) break;
    }
    return candidate;
  }

  // One straight piece of every moving lane, over which bounds are constant.
  void stride(Mask& moving, Mask& candidate) {
    const Vec3 p = place_ + way_ * t_;
    const Real h = law::altitudeAt(p, planet_);
    const Vec3 fromCentre = vec4(planet_.up) * Real(planet_.up.w) + p;
    const Real rise = law::dot(fromCentre, way_) / (h + planet_.radius);
    const Real top = select(shadow_, Real(cloudTop_), Real(pathTop_));
    const Mask escapes = both(moving, both(h > top, rise > 0.0f));
    toSky_ = either(toSky_, escapes);
    moving = andNot(moving, escapes);
    // Where the ray has no ground ahead and no air, but is high above all and descends, the bounds below still hold.
    const Mask up = rise > 0.0f;
    const Real inverse = Real(1.0f) / select(law::abs(rise) > 1e-6f, law::abs(rise), Real(1e-6f));
    Real reach = select(h > cloudTop_, Real(20000.0f), Real(kLongStep));
    reach = law::min(reach, law::max(Real(kAirClimb), h * 0.5f) * inverse);
    const auto meet = [&](float low, float high) {
      const Mask inside = both(h > low, h < high);
      const Real exit = select(up, Real(high) - h, h - low);
      const Real entry = select(up, Real(low) - h, h - high);
      const Mask ahead = either(inside, entry >= 0.0f);  // 0: it has just arrived
      reach = select(ahead, law::min(reach, select(inside, exit, entry) * inverse), reach);
      return inside;
    };
    Real cloud = 0.0f;
    if (!m_.levels.empty()) {
      const Mask inside = meet(m_.bottom, m_.top);
      if (!noneOf(both(inside, moving))) cloud = select(inside, cellBound(p, h, rise, inverse, reach), cloud);
    }
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      const Mask inside = meet(sheets_[i].height - 2.0f, sheets_[i].height + kSheetThickness + 2.0f);
      cloud += select(inside, Real(s_.sheetBounds[i]), Real(0.0f));
    }
    for (const KernelRain& r : s_.rain) cloud += select(meet(-1e4f, r.top + 2.0f), Real(r.bound), Real(0.0f));
    reach = law::max(reach, law::max(Real(0.05f), t_ * 2e-7f));
    Real air = 0.0f;
    if (s_.airScatters) {
      const Real lowest = law::max(h + law::min(rise * reach, Real(0.0f)), 0.0f);
      const Int bin = law::min(law::floorInt(lowest * (1.0f / kAirStep)), Int(int(s_.airBounds.size()) - 1));
      air = select(shadow_, Real(0.0f), law::gather(s_.airBounds.data(), law::max(bin, Int(0))));
    }
    const Real mu = cloud + air;
    const Mask hit = both(moving, tau_ < mu * reach);
    const Real way = select(hit, tau_ / law::max(mu, 1e-20f), reach);
    const Mask ended = both(moving, t_ + way >= end_);
    const Mask stops = andNot(hit, ended);
    const Mask goes = andNot(andNot(moving, hit), ended);
    tau_ = select(goes, law::max(tau_ - mu * reach, 0.0f), tau_);
    t_ = select(ended, end_, select(moving, t_ + way, t_));
    muCloud_ = select(stops, cloud, muCloud_);
    muAir_ = select(stops, air, muAir_);
    toGround_ = either(toGround_, ended);
    candidate = either(candidate, stops);
    moving = goes;
  }

  // The bound of the cell round p; shortens `reach` to the cell's end.
  Real cellBound(Vec3 p, Real h, Real rise, Real inverseRise, Real& reach) {
    // The finest level that holds p: each is twice as wide as the one before.
    const MajorantLevel& first = m_.levels.front();
    const Real px = p.x - m_.centre.x, py = p.y - m_.centre.y;
    const Real far = law::max(law::abs(px), law::abs(py)) * (1.0f / (m_.centre.x - first.origin.x));
    const Int exponent = Int(law::hn::ShiftRight<23>(law::hn::BitCast(law::DI(), far.v))) - Int(126);
    const Int k = law::max(exponent, Int(0));
    const Mask known = k < Int(static_cast<std::int32_t>(m_.levels.size()));
    const Int level = select(known, k, Int(0));
    const auto powerOfTwo = [](Int e) -> Real {
      return law::hn::BitCast(law::D(), law::hn::ShiftLeft<23>((e + Int(127)).v));
    };
    const Real cell = first.cell * powerOfTwo(level), inverseCell = (1.0f / first.cell) * powerOfTwo(-level);
    const Int offset = level * Int(static_cast<std::int32_t>(first.n * first.n * first.layers));
    const float half = 0.5f * static_cast<float>(first.n);
    const Real x = law::floor(px * inverseCell), y = law::floor(py * inverseCell);
    const Real z = law::clamp(law::floor((h - first.origin.z) * (1.0f / first.height)), Real(0.0f),
                              Real(static_cast<float>(first.layers - 1)));
    const auto index = [&](Real c) {
      return law::toInt(law::clamp(c + half, Real(0.0f), Real(static_cast<float>(first.n - 1))));
    };
    const Int n(first.n);
    const Real bound = law::gather(m_.bounds.data(), offset + (law::toInt(z) * n + index(y)) * n + index(x));
    // Out of the cell, or of all the empty cells round it.
    const Real free = law::max(-bound - 1.0f, 0.0f);
    const auto exit = [&](Real at, Real i, Real way, Real inverse) {
      return select(way > 0.0f, (i + 1.0f + free) * cell - at, at - (i - free) * cell) * inverse;
    };
    Real out = law::min(exit(px, x, way_.x, inverseX_), exit(py, y, way_.y, inverseY_));
    const Real low = first.origin.z + (z - free) * first.height;
    const Real high = first.origin.z + (z + 1.0f + free) * first.height;
    out = law::min(out, select(rise > 0.0f, high - h, h - low) * inverseRise);
    // Outside all levels, no further than the nearest of them can be.
    const MajorantLevel& widest = m_.levels.back();
    const Real away = law::max(law::abs(px), law::abs(py)) - (m_.centre.x - widest.origin.x);
    reach = law::min(reach, select(known, out, law::max(away, 0.25f)));
    return select(known, law::max(bound, 0.0f), Real(0.0f));
  }

  // The value of one of the eight voxels round a point, chosen with the weights of linear filtering: tracking asks for
  // an extinction whose mean is right, and this one costs an eighth of the fetches.
  Real gridExtinction(const CachedGrid& grid, Vec3 q, Mask lanes) {
    const VoxelGrid& v = *grid.voxels;
    const auto row = [&](int i) {
      const glm::vec4& r = grid.rows[i];
      return q.x * r.x + q.y * r.y + q.z * r.z + r.w;
    };
    const Real x = row(0), y = row(1), z = row(2);
    const auto within = [](Real a, int n) { return both(a > -0.5f, a < static_cast<float>(n) - 0.5f); };
    const glm::ivec3 n = v.dims();
    const Mask inside = both(lanes, both(within(x, n.x), both(within(y, n.y), within(z, n.z))));
    if (noneOf(inside)) return Real(0.0f);
    const auto pick = [&](Real a, int count) {
      const Real i = law::floor(law::clamp(a, Real(0.0f), Real(static_cast<float>(count - 1))) + next(random_, inside));
      return law::toInt(law::clamp(i, Real(0.0f), Real(static_cast<float>(count - 1))));
    };
    const Int ix = pick(x, n.x), iy = pick(y, n.y), iz = pick(z, n.z);
    const auto high = [](Int a) { return Int(law::hn::ShiftRight<3>(a.v)); };
    const Int low(VoxelGrid::kBrick - 1);
    const glm::ivec3 bricks = v.brickDims();
    const Int slot = (high(iz) * Int(bricks.y) + high(iy)) * Int(bricks.x) + high(ix);
    const Int brick = law::hn::GatherIndex(law::DI(), reinterpret_cast<const std::int32_t*>(v.brickIndex().data()),
                                           select(inside, slot, Int(0)).v);
    const Int at = ((iz & low) * Int(VoxelGrid::kBrick) + (iy & low)) * Int(VoxelGrid::kBrick) + (ix & low);
    const Real value = law::gather(v.values().data(), brick * Int(VoxelGrid::kBrickVoxels) + at);
    return select(inside, value * grid.extinction, Real(0.0f));
  }

  Real heroExtinction(std::size_t i, Vec3 q, Mask lanes) {
    const law::HeroParams& hero = heroes_[i];
    const Vec3 x = law::heroAxes(q, hero);
    const auto within = [](Real a, float low, float high) { return both(a > low, a < high); };
    const Mask inside = both(within(x.x, hero.low.x, hero.high.x),
                             both(within(x.y, hero.low.y, hero.high.y), within(x.z, hero.low.z, hero.high.z)));
    if (noneOf(both(lanes, inside))) return Real(0.0f);
    const CloudCache& c = *s_.clouds;
    return law::heroExtinction(q, Real(0.0f), hero, parts_[i], c.heroes[i].body.shapeView(),
                               c.noise.heroBillows.view());
  }

  // Of what falls from a layer.
  Real fallingExtinction(std::size_t k, Vec3 q, Mask lanes) {
    const KernelRain& rain = s_.rain[k];
    const Mask below = q.z < rain.top;
    const Mask inside = both(lanes, both(below, q.z > -1e3f));  // lanes without a question stand far below
    if (noneOf(inside)) return Real(0.0f);
    const CloudCache& c = *s_.clouds;
    const Volume& noise = layers_[rain.layer].shape == 0 ? c.noise.profileBase : c.noise.nubisBase;
    const Real rate = law::rainRate(q, Real(0.0f), layers_[rain.layer], clips_[rain.layer], rain_[k],
                                    c.weather.mainView(), c.weather.extraView(), noise.view());
    const Real share = law::snowShare(q.z, Real(rain_[k].freezing));
    const Real sigma = law::fallingExtinction(rate, share) * (rain.snow ? share : 1.0f - share);
    return select(inside, sigma, Real(0.0f));
  }

  // Extinction of component `i` at points of cloud space.
  Real extinctionOf(std::size_t i, Vec3 q, Mask lanes) {
    const CloudCache& c = *s_.clouds;
    const std::size_t flat = layers_.size() + sheets_.size(), voxels = flat + c.grids.size();
    const std::size_t clouds = voxels + heroes_.size();
    if (i >= clouds) return fallingExtinction(i - clouds, q, lanes);
    if (i >= voxels) return heroExtinction(i - voxels, q, lanes);
    if (i >= flat) return gridExtinction(c.grids[i - flat], q, lanes);
    if (i < layers_.size()) {
      const DensityTextures& t = c.noise;
      const TextureView main = c.weather.mainView(), extra = c.weather.extraView();
      if (layers_[i].shape == 0)
        return law::profileExtinction(q, Real(0.0f), Real(0.0f), layers_[i], clips_[i], main, extra,
                                      t.profileBase.view(), t.profileDetail.view(), t.profileWarp.view())
            .x;
      return law::nubisExtinction(q, law::toMask(true), Real(0.0f), layers_[i], clips_[i], main, extra,
                                  t.nubisBase.view(), t.nubisDetail.view(), t.curl.view())
          .x;
    }
    const law::SheetParams& sheet = sheets_[i - layers_.size()];
    const Mask inside = both(q.z > sheet.height, q.z < sheet.height + kSheetThickness);
    if (noneOf(inside)) return Real(0.0f);
    return select(inside, law::sheetOpticalDepth(law::xy(q), sheet) * (1.0f / kSheetThickness), Real(0.0f));
  }

  // What happens at the tentative collisions, at the ground and at the top.
  void collide(Mask candidate) {
    const Vec3 here = place_ + way_ * t_;
    const Vec3 p = select(candidate, here, Vec3(Real(0.0f)));
    const Real h = law::altitudeAt(p, planet_);
    const Real mu = muCloud_ + muAir_;
    const Real xi = select(candidate, next(random_, candidate) * mu, Real(-1.0f));
    const Mask inAir = both(candidate, xi < muAir_), inCloud = andNot(candidate, inAir);
    Mask scattered = law::toMask(false), byAir = law::toMask(false);
    Real component = -1.0f;
    if (!noneOf(inCloud)) {
      const Vec3 q = select(inCloud, Vec3(p.x, p.y, h), Vec3(Real(0.0f), Real(0.0f), Real(-1e4f)));
      Real sum = 0.0f;
      const Real at = xi - muAir_;
      for (std::size_t i = 0; i < s_.components.size(); ++i) {
        const Real sigma = extinctionOf(i, q, inCloud);
        const Mask chosen = both(both(at >= sum, at < sum + sigma), andNot(inCloud, shadow_));
        component = select(chosen, Real(static_cast<float>(i)), component);
        sum += sigma;
      }
      statistics_.lookups += countOf(inCloud);
      statistics_.overBound += countOf(both(inCloud, sum > muCloud_));
      scattered = component >= 0.0f;
      passShadow(both(inCloud, shadow_), sum);
    }
    if (!noneOf(inAir)) byAir = meetAir(inAir, xi, h);
    scattered = either(scattered, byAir);
    draw(both(candidate, alive_));
    if (!noneOf(scattered)) scatter(scattered, byAir, select(scattered, component, Real(-1.0f)), p, h);
    const Mask lit = both(shadow_, toSky_);
    if (!noneOf(lit)) arrive(lit);
    const Mask blocked = both(shadow_, toGround_);
    resume(either(lit, blocked));
    const Mask ground = andNot(toGround_, either(shadow_, blocked));
    if (!noneOf(ground)) meetGround(ground, here);
    const Mask sky = both(andNot(toSky_, either(shadow_, lit)), alive_);
    if (!noneOf(sky)) meetSky(sky);
    if (!noneOf(done_)) flush();
  }

  // Ratio tracking: a tentative collision on the way to the sun leaves the share 1 - sigma / mu.
  void passShadow(Mask lanes, Real sigma) {
    if (noneOf(lanes)) return;
    through_ = select(lanes, through_ * law::max(1.0f - sigma / law::max(muCloud_, 1e-20f), 0.0f), through_);
    // Roulette on what is left.
    const Mask faint = both(lanes, through_ < 0.25f);
    const Real survives = law::max(through_ * 4.0f, 0.05f);
    const Mask dies = both(faint, either(next(random_, faint) >= survives, through_ <= 0.0f));
    through_ = select(faint, through_ / survives, through_);
    resume(dies);
  }

  // A tentative collision with the air, whose extinction has a colour: one channel decides, and the others are weighed
  // by what they would have done (one-sample balance heuristic over channels; Wilkie et al. 2014).
  Mask meetAir(Mask lanes, Real xi, Real h) {
    const Vec3 sigma = law::atmosphereExtinction(air_, h);
    const Real chosen = law::dot(sigma, hero_);
    const Mask real = both(lanes, xi < chosen);
    const Mask null = andNot(lanes, real);
    statistics_.overBound += countOf(both(lanes, greatest(sigma) > muAir_));
    const Vec3 left = law::max(Vec3(muAir_) - sigma, Vec3(Real(0.0f))) / law::max(muAir_ - chosen, 1e-20f);
    beta_ = select(null, beta_ * left, beta_);
    ratio_ = select(null, ratio_ * left, ratio_);
    const Vec3 d = law::airDensity(air_, h);
    const Vec3 scattering = vec4(air_.rayleigh) * d.x + vec4(air_.mieScattering) * d.y;
    const Real inverse = Real(1.0f) / law::max(chosen, 1e-20f);
    beta_ = select(real, beta_ * scattering * inverse, beta_);
    ratio_ = select(real, ratio_ * sigma * inverse, ratio_);
    return real;
  }

  // How the light of all channels is weighed: the mean of their densities.
  Real balance() { return 3.0f / law::max(sumOf(ratio_), 1e-30f); }

  // Phase function of the lanes' matter between two directions, each channel: components have one for all.
  Vec3 phaseOf(Mask byAir, Real component, Vec3 share, Real versine) {
    Real grey = 0.0f;
    for (std::size_t i = 0; i < s_.components.size(); ++i) {
      const Mask mine = isComponent(component, i);
      if (noneOf(mine)) continue;
      grey = select(mine, target::evaluatePhase(phaseTable(i), versine), grey);
    }
    Vec3 all(grey);
    if (noneOf(byAir)) return all;
    const Real cosTheta = 1.0f - versine;
    const Real molecules = law::phaseRayleigh(cosTheta);
    const Real aerosol = law::phaseCornetteShanks(cosTheta, air_.mieExtinction.w);
    const Vec3 mixed = share * molecules + (Vec3(Real(1.0f)) - share) * aerosol;
    return select(byAir, mixed, all);
  }

  // Ends the lanes that have had all of their scatterings; answers the others.
  Mask endSpent(Mask lanes) {
    const Mask spent = both(lanes, count_ >= s_.mostScatterings);
    finish(spent);
    return andNot(lanes, spent);
  }

  // Scatters lanes at p: asks for the sun, and draws the direction in which the path will go on.
  void scatter(Mask lanes, Mask byAir, Real component, Vec3 p, Real h) {
    lanes = endSpent(lanes);
    if (noneOf(lanes)) return;
    byAir = both(byAir, lanes);
    component = select(lanes, component, Real(-1.0f));
    statistics_.scatterings += countOf(lanes);
    const Mask first = both(lanes, count_ < 0.5f);
    count_ = select(lanes, count_ + 1.0f, count_);
    const Mask cloudFirst = andNot(first, byAir);
    depth_ = select(cloudFirst, t_, depth_);
    clear_ = select(andNot(lanes, byAir), select(cloudFirst, Real(0.0f), clear_), clear_);
    seeThroughAir(first);
    place_ = select(lanes, p, place_);
    beta_ = select(lanes, beta_ * albedoOf(component), beta_);
    // Molecules' share of the air's scattering in every channel.
    Vec3 share(Real(0.0f));
    if (!noneOf(byAir)) {
      const Vec3 d = law::airDensity(air_, h);
      const Vec3 molecules = vec4(air_.rayleigh) * d.x, aerosol = vec4(air_.mieScattering) * d.y;
      share = molecules / law::max(molecules + aerosol, Vec3(Real(1e-20f)));
    }
    const Vec3 toSun = sampleSun(lanes);
    const Vec3 phaseSun = phaseOf(byAir, component, share, versineBetween(way_, toSun));
    const Vec3 before = way_;
    // The direction to go on in.
    const Real u = next(random_, lanes), azimuth = next(random_, lanes);
    Vec3 weight(Real(1.0f)), ratioWeight(Real(1.0f)), onward = before;
    Real density(0.0f);  // of the direction, mean over channels
    for (std::size_t i = 0; i < s_.components.size(); ++i) {
      const Mask mine = isComponent(component, i);
      if (noneOf(mine)) continue;
      const PhaseTableView& table = phaseTable(i);
      const PhaseSample sample = target::samplePhase(table, u);
      onward = select(mine, turned(before, sample.versine, azimuth), onward);
      weight = select(mine, Vec3(target::evaluatePhase(table, sample.versine) / sample.pdf), weight);
      density = select(mine, sample.pdf, density);
    }
    if (!noneOf(byAir)) {
      const Real chosen = law::dot(share, hero_);
      const Mask molecule = u < chosen;
      const Real again =
          law::clamp(select(molecule, u / law::max(chosen, 1e-9f), (u - chosen) / law::max(1.0f - chosen, 1e-9f)),
                     Real(0.0f), Real(0.99999994f));
      // Rayleigh's cubic, cos^3 + 3 cos = 8 u - 4 (Frisvad 2011); the aerosol by its table.
      const Real q = 4.0f * again - 2.0f, root = law::sqrt(1.0f + q * q);
      const Real cube = law::exp(law::log(law::max(root + law::abs(q), 1e-6f)) * (1.0f / 3.0f));
      const Real cosine = law::clamp(select(q < 0.0f, 1.0f / cube - cube, cube - 1.0f / cube), Real(-1.0f), Real(1.0f));
      const PhaseTableView& table = s_.phases[static_cast<std::size_t>(s_.aerosolPhase)];
      const PhaseSample sample = target::samplePhase(table, again);
      const Real turn = select(molecule, 1.0f - cosine, sample.versine);
      onward = select(byAir, turned(before, turn, azimuth), onward);
      const Vec3 truth = phaseOf(byAir, Real(-1.0f), share, turn);
      const Real pR = law::phaseRayleigh(1.0f - turn), pM = target::phasePdf(table, turn);
      const Real inverse = Real(1.0f) / law::max(chosen * pR + (1.0f - chosen) * pM, 1e-20f);
      const Vec3 densities = share * pR + (Vec3(Real(1.0f)) - share) * pM;
      weight = select(byAir, truth * inverse, weight);
      ratioWeight = select(byAir, densities * inverse, ratioWeight);
      density = select(byAir, sumOf(densities) * (1.0f / 3.0f), density);
    }
    nextWay_ = select(lanes, onward, nextWay_);
    const auto at = [&](Vec3 way, Vec3& phase, Real& pdf) {
      const Real versine = versineBetween(before, way);
      phase = phaseOf(byAir, component, share, versine);
      pdf = Real(0.0f);
      for (std::size_t i = 0; i < s_.components.size(); ++i) {
        const Mask mine = isComponent(component, i);
        if (!noneOf(mine)) pdf = select(mine, target::phasePdf(phaseTable(i), versine), pdf);
      }
      if (noneOf(byAir)) return;
      const Real pM = target::phasePdf(s_.phases[static_cast<std::size_t>(s_.aerosolPhase)], versine);
      const Vec3 densities = share * law::phaseRayleigh(1.0f - versine) + (Vec3(Real(1.0f)) - share) * pM;
      pdf = select(byAir, sumOf(densities) * (1.0f / 3.0f), pdf);
    };
    const Real chance = planBranch(lanes, phaseSun, density, at);
    ask(lanes, toSun, beta_ * phaseSun, h, chance, at);
    beta_ = select(lanes, beta_ * weight * share_, beta_);
    ratio_ = select(lanes, ratio_ * ratioWeight, ratio_);
    const Mask dies = roulette(lanes);
    nextWay_ = select(dies, Vec3(Real(0.0f)), nextWay_);
    // Lanes that the sun cannot reach go on at once.
    resume(andNot(lanes, shadow_));
  }

  // Light that travels nearly along the sunbeams is far brighter than all other, by the forward peaks of its last
  // scatterings; a path finds it by chance only. So paths branch: with some chance a second one goes on from the same
  // place, drawn in the aureole round the sun, and all that the two find further on is shared by the balance heuristic
  // (Veach and Guibas 1995). Branches branch too, up to kMostLevels. `at` answers phase function and density of a
  // direction, `density` is that of the path's own.
  // Answers the chance.
  template <class At>
  Real planBranch(Mask lanes, Vec3 phaseSun, Real density, const At& at) {
    share_ = Real(1.0f);
    nextDensity_ = select(lanes, density, nextDensity_);
    const Mask free = both(lanes, level_ < static_cast<float>(kMostLevels) - 0.5f);
    if (s_.components.empty() || noneOf(free)) return Real(0.0f);
    const Real chance =
        select(free, law::clamp(sumOf(phaseSun) * kBranching, Real(kLeastBranching), Real(kMostBranching)), Real(0.0f));
    const Real joint = density + chance * aureolePdf(nextWay_);
    share_ = select(free, density / law::max(joint, 1e-20f), share_);
    nextDensity_ = select(free, joint, nextDensity_);
    const Mask chosen = both(free, next(random_, free) < chance);
    const Real u = next(random_, chosen), azimuth = next(random_, chosen);
    if (noneOf(chosen)) return chance;
    const PhaseTableView& table = phaseTable(0);
    const PhaseSample sample = target::samplePhase(table, u * s_.aureoleShare);
    const Real lobe = sample.pdf * (1.0f / s_.aureoleShare);
    const Vec3 way = turned(sun_, sample.versine, azimuth);
    Vec3 phase(Real(0.0f));
    Real pdf = 0.0f;
    at(way, phase, pdf);
    const Real drawn = law::max(pdf + chance * lobe, 1e-20f);
    const Vec3 beta = beta_ * phase * (Real(1.0f) / drawn);
    branchBeta_ = select(chosen, beta, branchBeta_);
    branchDensity_ = select(chosen, drawn, branchDensity_);
    branchWay_ = select(chosen, way, branchWay_);
    branchRatio_ = select(chosen, ratio_, branchRatio_);
    branches_ = either(branches_, both(chosen, greatest(beta) > 0.0f));
    return chance;
  }

  // Density of branches' directions, 1/sr.
  Real aureolePdf(Vec3 way) const {
    const Real fromSun = versineBetween(sun_, way);
    const Mask near = fromSun < s_.aureole;
    if (noneOf(near)) return Real(0.0f);
    return select(near, target::phasePdf(phaseTable(0), fromSun) * (1.0f / s_.aureoleShare), Real(0.0f));
  }

  const PhaseTableView& phaseTable(std::size_t component) const {
    return s_.phases[static_cast<std::size_t>(s_.components[component].phase)];
  }
  Real albedoOf(Real component) const {
    Real albedo = 1.0f;
    for (std::size_t i = 0; i < s_.components.size(); ++i)
      albedo = select(isComponent(component, i), Real(s_.components[i].albedo), albedo);
    return albedo;
  }

  // A direction to a point of the sun's disc, or of the second light's, which is as large.
  Vec3 sampleSun(Mask lanes) { return sampleDisc(lanes, sun_); }
  Vec3 sampleDisc(Mask lanes, Vec3 middle) {
    const Real radius = air_.sunDirection.w;
    const Real r2 = next(random_, lanes), azimuth = next(random_, lanes);
    const Real angle = radius * law::sqrt(r2);
    return turned(middle, 0.5f * angle * angle, azimuth);
  }

  // Asks for light at place_: that of the sun, or, with the share of questions that is the sky's, that of a direction
  // drawn from it. What a direction of the sky sends comes by that question, by the path and by its branch: all three
  // share it by the balance heuristic. `chance` is the branch's. In the dusk, when sun and moon both light the air,
  // each has half of the questions.
  template <class At>
  void ask(Mask lanes, Vec3 toSun, Vec3 sunThroughput, Real h, Real chance, const At& at) {
    const float share = s_.sky.share;
    Mask sky = law::toMask(false);
    if (share > 0.0f) {
      sky = both(lanes, next(random_, lanes) < share);
      const Real u = next(random_, sky), v = next(random_, sky), w = next(random_, sky);
      if (!noneOf(sky)) {
        const Vec3 way = target::sampleSky(s_.sky, u, v, w);
        Vec3 phase(Real(0.0f));
        Real pdf = 0.0f;
        at(way, phase, pdf);
        const Real density = share * target::skyPdf(s_.sky, way) + pdf + chance * aureolePdf(way);
        const Vec3 light = law::lookupSky(s_.skyView, air_, way);
        const Vec3 value = beta_ * phase * light * (balance() / law::max(density, 1e-20f));
        const Real altitude = law::max(h, 0.0f);
        question(both(sky, zenithCosine(way, altitude) > law::horizonCosine(air_, altitude)), way, value);
      }
      sunThroughput = sunThroughput * (1.0f / (1.0f - share));
    }
    if (s_.airScatters && air_.secondDirection.w > 0.5f) {
      const Mask other = both(lanes, next(random_, lanes) < 0.5f);
      const Vec3 way = sampleDisc(other, second_);
      Vec3 phase(Real(0.0f));
      Real pdf = 0.0f;
      at(way, phase, pdf);
      const Real altitude = law::max(h, 0.0f), cosZenith = zenithCosine(way, altitude);
      const Vec3 light =
          law::lookupTransmittance(s_.transmittance, air_, altitude, law::clamp(cosZenith, Real(-1.0f), Real(1.0f))) *
          vec4(air_.secondIrradiance);
      const Vec3 value = beta_ * phase * light * (2.0f * balance());
      question(both(other, both(cosZenith > law::horizonCosine(air_, altitude), sumOf(value) > 0.0f)), way, value);
      sunThroughput = sunThroughput * 2.0f;
      sky = other;
    }
    askSun(andNot(lanes, sky), toSun, sunThroughput, h);
  }

  // Of a way from place_, which lies at `altitude`.
  Real zenithCosine(Vec3 way, Real altitude) const {
    const Vec3 fromCentre = vec4(planet_.up) * Real(planet_.up.w) + place_;
    return law::dot(fromCentre, way) / (altitude + planet_.radius);
  }

  // Starts the question how much of `throughput` times the sun's light arrives at place_ from `toSun`; faint light is
  // asked for by chance and counts for more.
  void askSun(Mask lanes, Vec3 toSun, Vec3 throughput, Real h) {
    const Real altitude = law::max(h, 0.0f), cosZenith = zenithCosine(toSun, altitude);
    Vec3 light = vec4(air_.sunIrradiance);
    if (hasAir_)
      light = light * law::lookupTransmittance(s_.transmittance, air_, altitude, law::clamp(cosZenith, -1.0f, 1.0f));
    const Vec3 value = throughput * light * balance();
    const Mask above = both(lanes, both(cosZenith > law::horizonCosine(air_, altitude), sumOf(value) > 0.0f));
    Real chance = law::clamp(sumOf(value) * askScale_, Real(kLeastAsking), Real(1.0f));
    chance = select(count_ < 1.5f, Real(1.0f), chance);
    const Mask seen = both(above, next(random_, above) < chance);
    question(seen, toSun, value / chance);
  }

  // How much of `value` arrives at place_ from `way`?
  void question(Mask lanes, Vec3 way, Vec3 value) {
    pending_ = select(lanes, value, pending_);
    through_ = select(lanes, Real(1.0f), through_);
    aim(lanes, way);
    t_ = select(lanes, Real(0.0f), t_);
    end_ = select(lanes, Real(kNever), end_);
    shadow_ = either(shadow_, lanes);
    draw(lanes);
  }

  // The light asked for arrives.
  void arrive(Mask lanes) {
    const Vec3 value = pending_ * through_;
    light_ = select(lanes, light_ + value, light_);
    single_ = select(both(lanes, count_ < 1.5f), single_ + value, single_);
  }

  // Lanes that have asked for the sun go on: along the branch, if there is one, else along the path.
  void resume(Mask lanes) {
    if (noneOf(lanes)) return;
    shadow_ = andNot(shadow_, lanes);
    const Mask branches = both(lanes, branches_);
    if (!noneOf(branches)) {
      for (int k = 0; k < kMostLevels; ++k) {
        const Mask here = both(branches, law::abs(level_ - static_cast<float>(k)) < 0.5f);
        if (noneOf(here)) continue;
        Left& left = left_[k];
        left.place = select(here, place_, left.place);
        left.beta = select(here, beta_, left.beta);
        left.ratio = select(here, ratio_, left.ratio);
        left.way = select(here, nextWay_, left.way);
        left.density = select(here, nextDensity_, left.density);
        left.count = select(here, count_, left.count);
      }
      level_ = select(branches, level_ + 1.0f, level_);
      beta_ = select(branches, branchBeta_, beta_);
      ratio_ = select(branches, branchRatio_, ratio_);
      nextWay_ = select(branches, branchWay_, nextWay_);
      nextDensity_ = select(branches, branchDensity_, nextDensity_);
      branches_ = andNot(branches_, branches);
      const Mask dies = roulette(branches);
      nextWay_ = select(dies, Vec3(Real(0.0f)), nextWay_);
    }
    goOn(lanes);
  }

  // Along nextWay_, or, if roulette has ended that, back to where the branch left the path.
  void goOn(Mask lanes) {
    const Mask dead = both(lanes, law::dot(nextWay_, nextWay_) < 0.5f);
    const Mask goes = andNot(lanes, dead);
    if (!noneOf(goes)) begin(goes, nextWay_);
    finish(dead);
  }

  // Paths that have come to their end; those of branches return to the path.
  void finish(Mask lanes) {
    if (noneOf(lanes)) return;
    const Mask back = both(lanes, level_ > 0.5f);
    done_ = either(done_, andNot(lanes, back));
    if (noneOf(back)) return;
    level_ = select(back, level_ - 1.0f, level_);
    for (int k = 0; k < kMostLevels; ++k) {
      const Mask here = both(back, law::abs(level_ - static_cast<float>(k)) < 0.5f);
      if (noneOf(here)) continue;
      const Left& left = left_[k];
      place_ = select(here, left.place, place_);
      beta_ = select(here, left.beta, beta_);
      ratio_ = select(here, left.ratio, ratio_);
      nextWay_ = select(here, left.way, nextWay_);
      nextDensity_ = select(here, left.density, nextDensity_);
      count_ = select(here, left.count, count_);
    }
    goOn(back);
  }

  // Ends paths whose throughput is faint, or that have been scattered very often, and compensates the others.
  Mask roulette(Mask lanes) {
    Real strength = greatest(beta_) * balance();
    // A path along the sunbeams is worth as much more as its next scattering will be brighter.
    if (!s_.components.empty() && !noneOf(both(lanes, strength < 0.25f)))
      strength *= 1.0f + (4.0f * kPi) * target::phasePdf(phaseTable(0), versineBetween(sun_, nextWay_));
    Real survives = law::clamp(strength * 4.0f, Real(0.05f), Real(1.0f));
    survives = select(count_ > static_cast<float>(kFreeScatterings), law::min(survives, Real(0.995f)), survives);
    const Mask at = both(lanes, survives < 1.0f);
    if (noneOf(at)) return at;
    const Mask dies = both(at, either(next(random_, at) >= survives, strength <= 0.0f));
    beta_ = select(at, beta_ / survives, beta_);
    return dies;
  }

  // Table mode: what lies between the camera and the first thing that the path meets.
  void seeThroughAir(Mask lanes) {
    if (s_.airScatters || !hasAir_ || noneOf(lanes)) return;
    Vec3 inscatter(Real(0.0f)), through(Real(1.0f));
    law::lookupAerial(s_.aerialInscatter, s_.aerialTransmittance, air_, way_, t_, inscatter, through);
    light_ = select(lanes, light_ + inscatter, light_);
    beta_ = select(lanes, beta_ * through, beta_);
  }

  void meetGround(Mask lanes, Vec3 here) {
    lanes = endSpent(lanes);
    if (noneOf(lanes)) return;
    const Vec3 fromCentre = vec4(planet_.up) * Real(planet_.up.w) + here;
    const Vec3 normal = law::normalize(fromCentre);
    seeThroughAir(both(lanes, count_ < 0.5f));
    count_ = select(lanes, count_ + 1.0f, count_);
    place_ = select(lanes, here + normal, place_);  // one metre above
    const Vec3 albedo = vec4(air_.groundAlbedo);
    beta_ = select(lanes, beta_ * albedo, beta_);
    const Vec3 toSun = sampleSun(lanes);
    const Real cosine = law::max(law::dot(normal, toSun), 0.0f);
    const Real u = next(random_, lanes), azimuth = next(random_, lanes);
    nextWay_ = select(lanes, turned(normal, 1.0f - law::sqrt(u), azimuth), nextWay_);
    const auto lambert = [&](Vec3 way) { return law::max(law::dot(normal, way), 0.0f) * (1.0f / kPi); };
    const auto at = [&](Vec3 way, Vec3& phase, Real& pdf) {
      pdf = lambert(way);
      phase = Vec3(pdf);
    };
    const Real chance = planBranch(lanes, Vec3(lambert(sun_)), lambert(nextWay_), at);
    ask(lanes, toSun, beta_ * (cosine * (1.0f / kPi)), law::altitudeAt(place_, planet_), chance, at);
    beta_ = select(lanes, beta_ * share_, beta_);
    const Mask dies = roulette(lanes);
    nextWay_ = select(dies, Vec3(Real(0.0f)), nextWay_);
    resume(andNot(lanes, shadow_));
  }

  void meetSky(Mask lanes) {
    const Mask first = both(lanes, count_ < 0.5f);
    const Vec3 weight = beta_ * balance();
    if (!s_.airScatters) {
      Vec3 sky = weight * law::lookupSky(s_.skyView, air_, way_);
      if (s_.sky.share > 0.0f) {
        const Real asked = s_.sky.share * target::skyPdf(s_.sky, way_);
        sky = select(first, sky, sky * (nextDensity_ / law::max(nextDensity_ + asked, 1e-20f)));
      }
      light_ = select(lanes, light_ + sky, light_);
      single_ = select(both(lanes, count_ < 1.5f), single_ + sky, single_);
    }
    if (s_.airScatters && s_.glows) {
      const Real altitude = law::max(law::altitudeAt(place_, planet_), 0.0f);
      const Vec3 glow = weight * law::airglow(air_, law::clamp(zenithCosine(way_, altitude), Real(-1.0f), Real(1.0f)));
      light_ = select(lanes, light_ + glow, light_);
      single_ = select(both(lanes, count_ < 1.5f), single_ + glow, single_);
    }
    if ((s_.moonShows || s_.starsShow) && !noneOf(first)) {
      Vec3 far(Real(0.0f));
      if (s_.moonShows) far = law::moonDisc(night_, way_, Real(1e-6f));
      if (s_.starsShow) far += law::starlight(night_, way_, Real(s_.pixelAngle));
      far = far * weight;
      if (!s_.airScatters) far = far * law::lookupTransmittance(s_.transmittance, air_, air_.cameraAltitude, way_.z);
      light_ = select(first, light_ + far, light_);
    }
    if (s_.sunDisc && !noneOf(first)) {
      Vec3 disc = law::sunDisc(air_, way_, Real(1e-6f)) * weight;
      if (!s_.airScatters) disc = disc * law::lookupTransmittance(s_.transmittance, air_, air_.cameraAltitude, way_.z);
      light_ = select(first, light_ + disc, light_);
    }
    finish(lanes);
  }

  // Adds finished paths to their pixels.
  void flush() {
    const std::size_t lanes = law::laneCount();
    HWY_ALIGN float r[64], g[64], b[64], sr[64], sg[64], sb[64], clear[64], depth[64], ended[64];
    HWY_ALIGN std::uint32_t at[64];
    const auto store = [](Real x, float* to) { law::hn::Store(x.v, law::D(), to); };
    store(light_.x, r), store(light_.y, g), store(light_.z, b);
    store(single_.x, sr), store(single_.y, sg), store(single_.z, sb);
    store(clear_, clear), store(depth_, depth);
    store(select(done_, Real(1.0f), Real(0.0f)), ended);
    law::hn::Store(index_.v, law::DU(), at);
    for (std::size_t i = 0; i < lanes; ++i) {
      if (ended[i] == 0.0f) continue;
      const float y = 0.2126f * r[i] + 0.7152f * g[i] + 0.0722f * b[i];
      if (!std::isfinite(r[i]) || !std::isfinite(g[i]) || !std::isfinite(b[i])) {
        ++statistics_.notFinite;
        continue;
      }
      PixelSums& sums = pixels_[at[i]];
      sums.radiance[0] += r[i], sums.radiance[1] += g[i], sums.radiance[2] += b[i];
      sums.single[0] += sr[i], sums.single[1] += sg[i], sums.single[2] += sb[i];
      sums.square += y * y;
      sums.clear += clear[i];
      sums.depth += depth[i];
    }
    alive_ = andNot(alive_, done_);
    shadow_ = andNot(shadow_, done_);
    place_ = select(done_, Vec3(Real(0.0f)), place_);
    t_ = select(done_, Real(0.0f), t_);
    done_ = law::toMask(false);
  }

  const KernelScene& s_;
  const TileJob& job_;
  std::span<PixelSums> pixels_;
  const Majorants& m_;
  std::vector<law::LayerParams> layers_;
  std::vector<law::ClipParams> clips_;
  std::vector<law::SheetParams> sheets_;
  std::vector<law::HeroParams> heroes_;
  std::vector<law::HeroParts> parts_;
  std::vector<law::RainParams> rain_;
  law::PlanetParams planet_;
  law::AtmosphereParams air_;
  law::CameraParams camera_;
  law::NightParams night_;
  float askScale_ = 1.0f;  // from light that a scattering would bring to the chance of asking
  bool hasAir_ = true;
  float cloudTop_ = 0.0f, pathTop_ = 0.0f;  // m, above which a shadow ray and a path are free
  std::size_t total_, issued_ = 0;
  KernelStatistics statistics_;

  Vec3 sun_, second_;
  Random random_;
  Uint index_;           // pixel in the tile
  Mask alive_, shadow_;  // has a path; asks for the sun
  Mask branches_;        // will branch
  Mask toGround_, toSky_, done_;
  Vec3 place_, way_;          // relative to the camera; unit
  Real inverseX_, inverseY_;  // 1 / |way_|
  Real t_, tau_, end_;        // m along way_; optical depth to go; where the ground is
  Real muCloud_, muAir_;      // bounds at the tentative collision, 1/m
  Vec3 beta_, ratio_;         // throughput over the density of the deciding channel; density of each channel over that
  Vec3 hero_;                 // 1 for the deciding channel
  Vec3 nextWay_;              // of the path while light is asked for
  Real nextDensity_;          // 1/sr, of drawing it, by path or branch
  Vec3 branchBeta_, branchWay_, branchRatio_;  // of the branch to come
  Real branchDensity_;
  struct Left {
    Vec3 place, beta, ratio, way;
    Real count, density;
  };
  Left left_[kMostLevels];  // what branches left behind, to be taken up again
  Real level_;              // how many
  Real share_;              // of what is found further on that is the path's, not the branch's
  Vec3 pending_;            // what arrives if nothing is in the way
  Real through_;            // and the share that does
  Vec3 light_, single_;
  Real count_, clear_, depth_;
};

static KernelStatistics trace(const KernelScene& scene, const TileJob& job, std::span<PixelSums> pixels) {
  return Paths(scene, job, pixels).run();
}

static std::size_t lanes() { return law::laneCount(); }

}  // namespace welkin::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin::trace {
HWY_EXPORT(trace);
HWY_EXPORT(lanes);
std::size_t laneCount() { return HWY_DYNAMIC_DISPATCH(lanes)(); }
KernelStatistics traceTile(const KernelScene& scene, const TileJob& job, std::span<PixelSums> pixels) {
  return HWY_DYNAMIC_DISPATCH(trace)(scene, job, pixels);
}
}  // namespace welkin::trace
#endif
