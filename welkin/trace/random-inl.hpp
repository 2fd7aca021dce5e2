// Random numbers for paths in SIMD lanes: xoshiro128+ (D. Blackman and S. Vigna, "Scrambled linear pseudorandom number
// generators", ACM TOMS 2021), seeded by the integer hash. A path's numbers depend on the seed and its own index alone,
// not on its lane, its thread or the vector's width. Include it after hwy/foreach_target.h.
#if defined(WELKIN_TRACE_RANDOM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_TRACE_RANDOM_INL
#undef WELKIN_TRACE_RANDOM_INL
#else
#define WELKIN_TRACE_RANDOM_INL
#endif
#include "welkin/density/law-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

// The state of one generator in each lane.
struct Random {
  law::Uint a, b, c, d;
  HWY_INLINE Random() {}  // a compiler's own would be generated outside of the instruction set
  HWY_INLINE Random(law::Uint s0, law::Uint s1, law::Uint s2, law::Uint s3) : a(s0), b(s1), c(s2), d(s3) {}
};

HWY_INLINE Random select(law::Mask mask, const Random& x, const Random& y) {
  return {law::select(mask, x.a, y.a), law::select(mask, x.b, y.b), law::select(mask, x.c, y.c),
          law::select(mask, x.d, y.d)};
}

// A generator for the path (index, sample): pixel and sample of a picture, or photon and batch. Each of the four words
// is a hash of its own, so two paths share a state only when four hashes agree.
HWY_INLINE Random seedRandom(law::uint seed, law::Uint index, law::Uint sample) {
  const auto word = [&](law::uint key) {
    const law::Uint h = law::hashUint(law::Uint(law::hashSeed(seed) + key));
    return law::hashUint(index + law::hashUint(sample + h));
  };
  // The one forbidden state is all zeros.
  return {word(0u) | law::Uint(1u), word(1u), word(2u), word(3u)};
}

// The next number of every lane, in [0, 1) with 24 bits.
HWY_INLINE law::Real next(Random& s) {
  const law::Real u = law::unitFromHash(s.a + s.d);
  const law::Uint t = s.b << 9u;
  s.c ^= s.a;
  s.d ^= s.b;
  s.b ^= s.c;
  s.a ^= s.d;
  s.c ^= t;
  s.d = (s.d << 11u) | (s.d >> 21u);
  return u;
}

// The next number of the lanes in `mask`; the generators of the others stay where they are.
HWY_INLINE law::Real next(Random& s, law::Mask mask) {
  Random moved = s;
  const law::Real u = next(moved);
  s = select(mask, moved, s);
  return u;
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
