// Photons in lanes; a lane whose photon has ended takes the next one. Once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/trace/flux_kernel.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include "welkin/trace/flux_job.hpp"
#include "welkin/trace/flux_walk-inl.hpp"
#include "welkin/trace/phase_table-inl.hpp"
#include "welkin/trace/random-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

using law::Uint;

inline constexpr float kTwoPi = 6.28318531f, kInvPi = 0.318309886f;
inline constexpr std::size_t kMostLanes = 64;
inline constexpr float kRouletteBelow = 0.0625f;

// One number a lane, for the few steps that go lane by lane.
struct alignas(64) Lanes {
  float v[kMostLanes];
  explicit Lanes(Real x) { law::hn::Store(x.v, law::D(), v); }
};

struct Photons {
  Walker walker;
  Real weight, tau;           // tau: optical depth left until the next collision with something, real or not
  Real scatterings, bounces;  // events so far
  Real scattered, path;       // weights of scatterings, and weighted way in m
  Random random;
  Mask alive;
  // Lanes without a photon stand in the grid too, since lookups are made for all lanes.
  HWY_INLINE Photons() {
    for (int k = 0; k < 3; ++k) {
      walker.brick[k] = Int(0);
      walker.at[k] = Real(0.0f);
      walker.way[k] = walker.perWay[k] = Real(1.0f);
    }
    walker.slot = Int(0);
    weight = tau = scatterings = bounces = scattered = path = Real(0.0f);
    random = {Uint(1u), Uint(2u), Uint(3u), Uint(4u)};
    alive = toMask(false);
  }
};

class Follower {
 public:
  Follower(const flux::Job& job, std::uint64_t first, std::uint64_t last, flux::Tally& tally)
      : job_(job), g_(job.medium), next_(first), last_(last), tally_(tally),
        radiance_(job.views.size() * law::laneCount()) {}

  void run() {
    const std::size_t lanes = law::laneCount();
    for (;;) {
      const std::size_t idle = lanes - law::hn::CountTrue(law::D(), p_.alive.m);
      if (idle == lanes && next_ == last_) return;
      // Starting photons costs about as much as a turn, however few they are.
      if (next_ != last_ && idle * 4 >= lanes) start();
      turnOnce();
    }
  }

 private:
  Vec3 way() const { return Vec3(p_.walker.way[0], p_.walker.way[1], p_.walker.way[2]); }
  Real radiance(std::size_t v) const { return law::hn::LoadU(law::D(), radiance_.data() + v * law::laneCount()); }
  void setRadiance(std::size_t v, Real r) { law::hn::StoreU(r.v, law::D(), radiance_.data() + v * law::laneCount()); }
  Real draw(Mask m) { return next(p_.random, m); }
  Real drawDepth(Mask m) { return -law::log(1.0f - draw(m)); }

  // A cosine-distributed direction about an axis: -1 or +1 times x, y or z.
  Vec3 lambertian(Mask m, int axis, float sign) {
    const Real u = draw(m), phi = kTwoPi * draw(m), r = law::sqrt(u);
    const Real a = r * law::cos(phi), b = r * law::sin(phi), c = sign * law::sqrt(1.0f - u);
    return axis == 0 ? Vec3(c, a, b) : axis == 1 ? Vec3(a, c, b) : Vec3(a, b, c);
  }

  // Puts new photons into idle lanes, in the order of the lanes.
  void start() {
    alignas(64) std::uint32_t low[kMostLanes], high[kMostLanes];
    Lanes fresh(Real(0.0f));
    const Lanes alive(select(p_.alive, Real(1.0f), Real(0.0f)));
    for (std::size_t i = 0; i < law::laneCount(); ++i) {
      const bool takes = alive.v[i] == 0.0f && next_ != last_;
      low[i] = static_cast<std::uint32_t>(next_);
      high[i] = static_cast<std::uint32_t>(next_ >> 32);
      fresh.v[i] = takes ? 1.0f : 0.0f;
      next_ += takes;
    }
    const Mask m = Real(law::hn::Load(law::D(), fresh.v)) > 0.0f;
    p_.random =
        select(m, seedRandom(job_.seed, law::hn::Load(law::DU(), low), law::hn::Load(law::DU(), high)), p_.random);
    p_.alive = either(p_.alive, m);
    p_.weight = select(m, Real(1.0f), p_.weight);
    for (Real* zero : {&p_.scatterings, &p_.bounces, &p_.scattered, &p_.path}) *zero = select(m, Real(0.0f), *zero);
    for (std::size_t v = 0; v < job_.views.size(); ++v) setRadiance(v, select(m, Real(0.0f), radiance(v)));
    enter(m);
    p_.tau = select(m, drawDepth(m), p_.tau);
  }

  // Through a face that is lit, anywhere on it.
  void enter(Mask m) {
    const Real which = draw(m), u[2] = {draw(m), draw(m)};
    float before = 0.0f;
    for (int face = 0; face < flux::kFaces; ++face) {
      const float upTo = job_.lit[std::size_t(face)];
      if (upTo == before) continue;
      const Mask here = both(m, both(which >= before, which < upTo));
      before = upTo;
      for (int k = 0, j = 0; k < 3; ++k) {
        const int n = g_.dims[std::size_t(k)];
        const Real x = k != face / 2 ? u[j++] * float(n) : Real(face % 2 == 1 ? float(n) : 0.0f);
        const Int brick = law::min(law::toInt(x * 0.125f), Int(g_.bricks[std::size_t(k)] - 1));
        p_.walker.brick[k] = select(here, brick, p_.walker.brick[k]);
        p_.walker.at[k] = select(here, x - law::toReal(brick) * 8.0f, p_.walker.at[k]);
      }
      const float inward = face % 2 == 1 ? -1.0f : 1.0f;
      Vec3 to(job_.beam[0], job_.beam[1], job_.beam[2]);
      if (job_.diffuse) to = lambertian(here, face / 2, inward);
      turn(g_, here, to, p_.walker);
      p_.walker.slot = select(here, slotOf(g_, p_.walker), p_.walker.slot);
      if (job_.diffuse)
        for (std::size_t v = 0; v < job_.views.size(); ++v) {
          const float cosine = inward * job_.views[v].direction[std::size_t(face / 2)];
          if (cosine > 0.0f) look(here, v, Real(cosine * kInvPi));
        }
    }
  }

  // Adds what an event with this density (1/sr) toward a viewer sends there.
  void look(Mask m, std::size_t v, Real density) {
    const auto& d = job_.views[v].direction;
    Walker to = p_.walker;
    turn(g_, m, Vec3(d[0], d[1], d[2]), to);
    const Real seen = transmittanceOut(g_, job_.periodic, m, to, drawDepth(m));
    setRadiance(v, radiance(v) + select(m, p_.weight * density * seen, Real(0.0f)));
  }

  // On to the next collision or face.
  void turnOnce() {
    Walker& w = p_.walker;
    const Real majorant = law::max(law::gather(g_.majorants, w.slot), Real(1e-30f));
    const Crossing face = toBrickFace(g_, w);
    const Real toCollision = p_.tau / majorant;
    const Mask collides = both(p_.alive, toCollision < face.distance);
    const Mask crosses = both(p_.alive, invert(collides));
    const Real distance = select(collides, toCollision, face.distance);
    p_.path += select(p_.alive, p_.weight * distance, Real(0.0f));
    p_.tau = select(crosses, p_.tau - majorant * distance, p_.tau);
    advance(p_.alive, distance, w);
    if (!noneOf(crosses)) {
      Mask leaves[flux::kFaces];
      cross(g_, job_.periodic, crosses, face, w, leaves);
      leave(leaves);
    }
    if (!noneOf(collides)) collide(collides, majorant);
  }

  void collide(Mask m, Real majorant) {
    const Mask real = both(m, draw(m) * majorant < extinctionAt(g_, p_.walker));
    p_.tau = select(m, drawDepth(m), p_.tau);
    if (!noneOf(real)) scatter(real);
  }

  void scatter(Mask m) {
    const Mask drops = both(m, p_.scatterings >= job_.dropAfter);
    if (!noneOf(drops)) {
      forLanes(drops, [&](std::size_t, float weight) { tally_.lost += weight; });
      end(drops);
      m = both(m, invert(drops));
    }
    p_.scatterings += select(m, Real(1.0f), Real(0.0f));
    p_.scattered += select(m, p_.weight, Real(0.0f));
    if (job_.countAbsorption) absorb(m);
    for (std::size_t v = 0; v < job_.views.size(); ++v) {
      const auto& d = job_.views[v].direction;
      const Real dx = p_.walker.way[0] - d[0], dy = p_.walker.way[1] - d[1], dz = p_.walker.way[2] - d[2];
      look(m, v, evaluatePhase(job_.phase, law::min(0.5f * (dx * dx + dy * dy + dz * dz), Real(2.0f))));
    }
    const PhaseSample s = samplePhase(job_.phase, draw(m));
    if (job_.phase.rows == 0)
      p_.weight = select(m, p_.weight * evaluatePhase(job_.phase, s.versine) / s.pdf, p_.weight);
    turn(g_, m, deflected(m, s.versine), p_.walker);
    playRoulette(m);
  }

  void absorb(Mask m) {
    const Real albedo = albedoAt(g_, p_.walker), weight = p_.weight;
    p_.weight = weight * (1.0f - albedo);
    double* columns = tally_.columns.data() + 2 * tally_.columns.size() / 3;
    forLanes(m, [&](std::size_t column, float absorbed) {
      tally_.absorbed += absorbed;
      columns[column] += absorbed;
    });
    p_.weight = select(m, weight * albedo, weight);
  }

  // The way, turned by an angle whose versine is given, about itself by chance.
  Vec3 deflected(Mask m, Real versine) {
    const Real phi = kTwoPi * draw(m), sine = law::sqrt(law::max(versine * (2.0f - versine), Real(0.0f)));
    const Vec3 d = way();
    // Two axes across it (T. Duff et al. 2017, "Building an orthonormal basis, revisited").
    const Real s = select(d.z < 0.0f, Real(-1.0f), Real(1.0f)), a = -1.0f / (s + d.z), b = d.x * d.y * a;
    const Vec3 across1(1.0f + s * d.x * d.x * a, s * b, -s * d.x), across2(b, s + d.y * d.y * a, -d.y);
    const Vec3 to = d * (1.0f - versine) + across1 * (sine * law::cos(phi)) + across2 * (sine * law::sin(phi));
    return law::normalize(to);
  }

  void playRoulette(Mask m) {
    const Mask plays = both(m, p_.weight < kRouletteBelow);
    if (noneOf(plays)) return;
    const Mask stays = both(plays, draw(plays) * kRouletteBelow < p_.weight);
    p_.weight = select(stays, Real(kRouletteBelow), p_.weight);
    end(both(plays, invert(stays)));
  }

  void leave(const Mask (&leaves)[flux::kFaces]) {
    Mask gone = toMask(false);
    const std::size_t plane = tally_.columns.size() / 3;
    for (int face = 0; face < flux::kFaces; ++face) {
      if (noneOf(leaves[face])) continue;
      forLanes(leaves[face], [&](std::size_t column, float weight) {
        tally_.faces[face] += weight;
        if (face == flux::kTop) tally_.columns[column] += weight;
        if (face == flux::kBottom) tally_.columns[plane + column] += weight;
      });
      const Mask direct = both(leaves[face], p_.scatterings + p_.bounces == Real(0.0f));
      if (!noneOf(direct)) forLanes(direct, [&](std::size_t, float weight) { tally_.unscattered += weight; });
      if (face == flux::kBottom && job_.surfaceAlbedo > 0.0f)
        reflect(leaves[face]);
      else
        gone = either(gone, leaves[face]);
    }
    if (!noneOf(gone)) end(gone);
  }

  // By the Lambertian surface. Walkers stand on the bottom of their column.
  void reflect(Mask m) {
    p_.weight = select(m, p_.weight * job_.surfaceAlbedo, p_.weight);
    p_.bounces += select(m, Real(1.0f), Real(0.0f));
    for (std::size_t v = 0; v < job_.views.size(); ++v)
      if (const float up = job_.views[v].direction[2]; up > 0.0f) look(m, v, Real(up * kInvPi));
    turn(g_, m, lambertian(m, 2, 1.0f), p_.walker);
    playRoulette(m);
  }

  void end(Mask m) {
    const Lanes ends(select(m, Real(1.0f), Real(0.0f))), path(p_.path), scattered(p_.scattered);
    for (std::size_t i = 0; i < law::laneCount(); ++i) {
      if (ends.v[i] == 0.0f) continue;
      tally_.path += path.v[i];
      tally_.scatterings += scattered.v[i];
    }
    for (std::size_t v = 0; v < job_.views.size(); ++v) {
      const Lanes seen(select(m, radiance(v), Real(0.0f)));
      for (std::size_t i = 0; i < law::laneCount(); ++i) tally_.radiance[v] += seen.v[i];
    }
    p_.alive = both(p_.alive, invert(m));
  }

  // body(column, weight) for every lane of the mask.
  template <class Body>
  void forLanes(Mask m, const Body& body) {
    const Lanes in(select(m, Real(1.0f), Real(0.0f))), weight(p_.weight);
    alignas(64) std::int32_t columns[kMostLanes];
    const auto index = [&](int k) { return p_.walker.brick[k] * Int(8) + law::toInt(voxelOf(g_, p_.walker, k)); };
    law::hn::Store((index(1) * Int(g_.dims[0]) + index(0)).v, law::DI(), columns);
    for (std::size_t i = 0; i < law::laneCount(); ++i)
      if (in.v[i] != 0.0f) body(static_cast<std::size_t>(columns[i]), weight.v[i]);
  }

  const flux::Job& job_;
  const flux::Medium& g_;
  std::uint64_t next_, last_;
  flux::Tally& tally_;
  std::vector<float> radiance_;  // of the photon in each lane, view by view
  Photons p_;
};

static void followPhotons(const flux::Job& job, std::uint64_t first, std::uint64_t last, flux::Tally& tally) {
  Follower(job, first, last, tally).run();
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(followPhotons);

namespace flux {
void followPhotons(const Job& job, std::uint64_t first, std::uint64_t last, Tally& tally) {
  HWY_DYNAMIC_DISPATCH(followPhotons)(job, first, last, tally);
}
}  // namespace flux
}  // namespace welkin
#endif
