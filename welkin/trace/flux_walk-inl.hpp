// Walking through the bricks of a voxel grid in SIMD lanes. Include it after hwy/foreach_target.h.
#if defined(WELKIN_TRACE_FLUX_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_TRACE_FLUX_WALK_INL
#undef WELKIN_TRACE_FLUX_WALK_INL
#else
#define WELKIN_TRACE_FLUX_WALK_INL
#endif
#include "welkin/base/law_simd-inl.hpp"
#include "welkin/trace/flux_job.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

using law::Int, law::Mask, law::Real, law::Vec3;
using law::select, law::both, law::either, law::invert, law::noneOf, law::toMask;

inline constexpr float kFar = 1e30f;  // m

// A place in the grid, and the way on.
struct Walker {
  Int brick[3];
  Real at[3];             // in the brick, in voxels
  Real way[3];            // unit vector
  Real perWay[3];         // metres that one voxel takes along this axis: voxel / way
  Int slot;               // of the brick
  HWY_INLINE Walker() {}  // a compiler's own would be generated outside of the instruction set
};

struct Crossing {
  Real distance;  // m
  Mask across[3];
};

HWY_INLINE Walker select(Mask m, const Walker& a, const Walker& b) {
  Walker w;
  for (int k = 0; k < 3; ++k) {
    w.brick[k] = select(m, a.brick[k], b.brick[k]);
    w.at[k] = select(m, a.at[k], b.at[k]);
    w.way[k] = select(m, a.way[k], b.way[k]);
    w.perWay[k] = select(m, a.perWay[k], b.perWay[k]);
  }
  w.slot = select(m, a.slot, b.slot);
  return w;
}

// Turns the lanes of `m`. A way that would never leave a layer of air is bent upward or downward by 1e-6 rad.
HWY_INLINE void turn(const flux::Medium& g, Mask m, const Vec3& way, Walker& w) {
  const Real to[3] = {way.x, way.y,
                      select(law::abs(way.z) < 1e-6f, select(way.z < 0.0f, Real(-1e-6f), Real(1e-6f)), way.z)};
  for (int k = 0; k < 3; ++k) {
    const Real safe = select(law::abs(to[k]) < 1e-20f, Real(1e-20f), to[k]);
    w.way[k] = select(m, to[k], w.way[k]);
    w.perWay[k] = select(m, Real(g.voxel[std::size_t(k)]) / safe, w.perWay[k]);
  }
}

HWY_INLINE Int slotOf(const flux::Medium& g, const Walker& w) {
  return (w.brick[2] * Int(g.bricks[1]) + w.brick[1]) * Int(g.bricks[0]) + w.brick[0];
}

// Voxels of a brick along one axis: the last brick may be cut.
HWY_INLINE Real extent(const flux::Medium& g, int axis, Int brick) {
  return law::toReal(law::min(Int(8), Int(g.dims[std::size_t(axis)]) - brick * Int(8)));
}

HWY_INLINE Crossing nearest(Real x, Real y, Real z) {
  const Mask mx = both(x <= y, x <= z), my = both(invert(mx), y <= z);
  return {law::min(law::min(x, y), z), {mx, my, invert(either(mx, my))}};
}

HWY_INLINE Real toFace(Real face, Real at, Real perWay) { return law::max((face - at) * perWay, Real(0.0f)); }

// The way to the brick's face that comes first.
HWY_INLINE Crossing toBrickFace(const flux::Medium& g, const Walker& w) {
  Real t[3];
  for (int k = 0; k < 3; ++k)
    t[k] = toFace(select(w.perWay[k] > 0.0f, extent(g, k, w.brick[k]), Real(0.0f)), w.at[k], w.perWay[k]);
  return nearest(t[0], t[1], t[2]);
}

// The voxel of the brick that a walker stands in; on a face, the one that it walks into.
HWY_INLINE Real voxelOf(const flux::Medium& g, const Walker& w, int axis) {
  const Real in = select(w.perWay[axis] > 0.0f, law::floor(w.at[axis]), -law::floor(-w.at[axis]) - 1.0f);
  return law::clamp(in, 0.0f, extent(g, axis, w.brick[axis]) - 1.0f);
}

// The face that comes first of the voxel, or of the brick where that is empty.
HWY_INLINE Crossing toVoxelFace(const flux::Medium& g, const Walker& w, Mask empty) {
  Real t[3];
  for (int k = 0; k < 3; ++k) {
    const Mask up = w.perWay[k] > 0.0f;
    const Real voxel = voxelOf(g, w, k), ofVoxel = select(up, voxel + 1.0f, voxel);
    const Real ofBrick = select(up, extent(g, k, w.brick[k]), Real(0.0f));
    t[k] = toFace(select(empty, ofBrick, ofVoxel), w.at[k], w.perWay[k]);
  }
  return nearest(t[0], t[1], t[2]);
}

HWY_INLINE void advance(Mask m, Real distance, Walker& w) {
  for (int k = 0; k < 3; ++k) w.at[k] = select(m, w.at[k] + distance / w.perWay[k], w.at[k]);
}

// Puts the lanes of `m` onto the face that they reached and, where it is the brick's, into the next brick. With
// periodic sides x and y close. Says which faces of the box they leave through; those lanes stay in their last brick.
HWY_INLINE void cross(const flux::Medium& g, bool periodic, Mask m, const Crossing& c, Walker& w,
                      Mask (&leaves)[flux::kFaces]) {
  for (int k = 0; k < 3; ++k) {
    const Mask here = both(m, c.across[k]), up = w.perWay[k] > 0.0f;
    const Real rounded = law::floor(w.at[k] + 0.5f);
    const Mask out =
        both(here, either(both(up, rounded >= extent(g, k, w.brick[k])), both(invert(up), rounded <= 0.0f)));
    w.at[k] = select(here, rounded, w.at[k]);
    const Int last(g.bricks[std::size_t(k)] - 1);
    Int next = w.brick[k] + select(up, Int(1), Int(-1));
    const Mask low = both(out, next < Int(0)), high = both(out, next > last);
    if (periodic && k < 2) {
      next = select(low, last, select(high, Int(0), next));
      leaves[2 * k] = leaves[2 * k + 1] = toMask(false);
    } else {
      next = select(either(low, high), w.brick[k], next);
      leaves[2 * k] = low;
      leaves[2 * k + 1] = high;
    }
    const Mask moves = both(out, invert(either(leaves[2 * k], leaves[2 * k + 1])));
    w.brick[k] = select(moves, next, w.brick[k]);
    w.at[k] = select(moves, select(up, Real(0.0f), extent(g, k, w.brick[k])), w.at[k]);
  }
  w.slot = slotOf(g, w);
}

// A grid's value in the voxel where the walkers stand.
HWY_INLINE Real valueAt(const flux::Medium& g, const std::uint32_t* index, const float* values, const Walker& w) {
  const Real voxel = (voxelOf(g, w, 2) * 8.0f + voxelOf(g, w, 1)) * 8.0f + voxelOf(g, w, 0);
  const Int brick = law::hn::GatherIndex(law::DI(), reinterpret_cast<const std::int32_t*>(index), w.slot.v);
  return law::gather(values, brick * Int(512) + law::toInt(voxel));
}

HWY_INLINE Real extinctionAt(const flux::Medium& g, const Walker& w) { return valueAt(g, g.brickIndex, g.values, w); }

HWY_INLINE Real albedoAt(const flux::Medium& g, const Walker& w) {
  return g.albedoIndex ? valueAt(g, g.albedoIndex, g.albedoValues, w) : Real(g.albedo);
}

// Transmittance of the lanes of `m` until they leave through the top or bottom, 0 through a side. Exact down to e^-4;
// below, a way survives with the probability that is left, given by the optical depth `luck` of an exponential law.
HWY_INLINE Real transmittanceOut(const flux::Medium& g, bool periodic, Mask m, Walker w, Real luck) {
  constexpr float kExactDepth = 4.0f;
  Real depth(0.0f), result(0.0f);
  while (!noneOf(m)) {
    const Mask empty = law::gather(g.majorants, w.slot) <= 0.0f;
    const Crossing c = toVoxelFace(g, w, empty);
    depth = depth + select(m, extinctionAt(g, w) * c.distance, Real(0.0f));
    m = both(m, depth < luck + kExactDepth);
    advance(m, c.distance, w);
    Mask leaves[flux::kFaces];
    cross(g, periodic, m, c, w, leaves);
    const Mask seen = either(leaves[flux::kBottom], leaves[flux::kTop]);
    result = select(seen, law::exp(-law::min(depth, Real(kExactDepth))), result);
    for (const Mask& gone : leaves) m = both(m, invert(gone));
  }
  return result;
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
