// What lattice noises share: cells that repeat, cells that refine from octave to octave, gradients.

// Cell i of a lattice that repeats after `period` cells; period 0 never repeats. Exact for |i| < 2^21.
FN Int wrapCell(IN(Int) i, IN(int) period) {
  if (period == 0) return i;
  if ((period & (period - 1)) == 0) return i & (period - 1);
  return i - floorInt((toReal(i) + 0.5f) / toReal(period)) * period;
}

// A point is a cell and a fraction in [0, 1): the form that keeps its precision far from the origin. These make it that
// of a lattice `factor` times finer; cells wrap modulo 2^32.
FN Int refinedCell(IN(Int) cell, IN(Real) whole, IN(int) factor) {
  return toInt(toUint(cell) * uint(factor) + toUint(toInt(whole)));
}
FN void refineCell2(INOUT(IVec2) cell, INOUT(Vec2) f, IN(int) factor) {
  Vec2 p = f * toReal(factor);
  Vec2 whole = floor(p);
  cell = IVec2(refinedCell(cell.x, whole.x, factor), refinedCell(cell.y, whole.y, factor));
  f = p - whole;
}
FN void refineCell3(INOUT(IVec3) cell, INOUT(Vec3) f, IN(int) factor) {
  Vec3 p = f * toReal(factor);
  Vec3 whole = floor(p);
  cell = IVec3(refinedCell(cell.x, whole.x, factor), refinedCell(cell.y, whole.y, factor),
               refinedCell(cell.z, whole.z, factor));
  f = p - whole;
}

// -1 or +1 from one bit of a hash.
FN Real signFromHash(IN(Uint) h, IN(uint) bit) { return 2.0f * toReal(toInt((h >> bit) & 1u)) - 1.0f; }

// Gradients of equal length: 8 directions in the plane, the 12 edge centres of the cube (K. Perlin, "Improving noise",
// 2002) and the 32 of the hypercube.
FN Vec2 gradient2(IN(Uint) h) {
  Real s = signFromHash(h, 0u);
  Real t = signFromHash(h, 1u);
  Vec2 axis = select((h & 8u) == 0u, Vec2(1.41421356f * s, 0.0f), Vec2(0.0f, 1.41421356f * t));
  return select((h & 4u) == 0u, Vec2(s, t), axis);
}
FN Vec3 gradient3(IN(Uint) h) {
  Uint axis = ((h >> 16u) * 3u) >> 16u;
  return Vec3(select(axis == 0u, 0.0f, signFromHash(h, 0u)), select(axis == 1u, 0.0f, signFromHash(h, 1u)),
              select(axis == 2u, 0.0f, signFromHash(h, 2u)));
}
FN Vec4 gradient4(IN(Uint) h) {
  Uint axis = h >> 30u;
  return Vec4(select(axis == 0u, 0.0f, signFromHash(h, 0u)), select(axis == 1u, 0.0f, signFromHash(h, 1u)),
              select(axis == 2u, 0.0f, signFromHash(h, 2u)), select(axis == 3u, 0.0f, signFromHash(h, 3u)));
}
