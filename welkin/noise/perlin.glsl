// Gradient noise (K. Perlin, "Improving noise", 2002; 000 ch. 2.3.2): zero at lattice points, within -1.04 to 1.04,
// twice differentiable. One cell is one unit of p; it repeats after `period` cells, 0 never.

// 000 eq. 2.20 and its derivative.
FN Real fadeQuintic(IN(Real) t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }
FN Real fadeQuinticSlope(IN(Real) t) { return 30.0f * t * t * (t * (t - 2.0f) + 1.0f); }

// The lattice points with one x, blended over the other axes: the noise near them as (slope, value) of a line in x.
// The rows are the hash chains of their other coordinates, w the faded fraction.
FN Vec2 perlin2Side(IN(Int) x, IN(Uint) row0, IN(Uint) row1, IN(Real) fy, IN(Real) wy) {
  Vec2 g0 = gradient2(hashChain(x, row0));
  Vec2 g1 = gradient2(hashChain(x, row1));
  return Vec2(mix(g0.x, g1.x, wy), mix(g0.y * fy, g1.y * (fy - 1.0f), wy));
}
FN Vec2 perlin3Side(IN(Int) x, IN(Uint) row00, IN(Uint) row10, IN(Uint) row01, IN(Uint) row11, IN(Real) fy, IN(Real) fz,
                    IN(Real) wy, IN(Real) wz) {
  Vec3 g00 = gradient3(hashChain(x, row00));
  Vec3 g10 = gradient3(hashChain(x, row10));
  Vec3 g01 = gradient3(hashChain(x, row01));
  Vec3 g11 = gradient3(hashChain(x, row11));
  Real slope = mix(mix(g00.x, g10.x, wy), mix(g01.x, g11.x, wy), wz);
  Real near = mix(g00.y * fy + g00.z * fz, g10.y * (fy - 1.0f) + g10.z * fz, wy);
  Real far = mix(g01.y * fy + g01.z * (fz - 1.0f), g11.y * (fy - 1.0f) + g11.z * (fz - 1.0f), wy);
  return Vec2(slope, mix(near, far, wz));
}
FN Real perlinBlend(IN(Vec2) left, IN(Vec2) right, IN(Real) fx, IN(Real) wx) {
  return mix(left.y + left.x * fx, right.y + right.x * (fx - 1.0f), wx);
}

FN Real perlin2At(IN(IVec2) cell, IN(Vec2) f, IN(ivec2) period, IN(uint) seed) {
  Uint row0 = hashChain(wrapCell(cell.y, period.y), hashSeed(seed));
  Uint row1 = hashChain(wrapCell(cell.y + 1, period.y), hashSeed(seed));
  Real wy = fadeQuintic(f.y);
  Vec2 left = perlin2Side(wrapCell(cell.x, period.x), row0, row1, f.y, wy);
  Vec2 right = perlin2Side(wrapCell(cell.x + 1, period.x), row0, row1, f.y, wy);
  return perlinBlend(left, right, f.x, fadeQuintic(f.x));
}
FN Real perlin2At(IN(IVec2) cell, IN(Vec2) f, IN(int) period, IN(uint) seed) {
  return perlin2At(cell, f, ivec2(period), seed);
}
FN Real perlin2(IN(Vec2) p, IN(ivec2) period, IN(uint) seed) {
  Vec2 whole = floor(p);
  return perlin2At(IVec2(toInt(whole.x), toInt(whole.y)), p - whole, period, seed);
}
FN Real perlin2(IN(Vec2) p, IN(int) period, IN(uint) seed) { return perlin2(p, ivec2(period), seed); }

FN Real perlin3At(IN(IVec3) cell, IN(Vec3) f, IN(ivec3) period, IN(uint) seed) {
  Uint layer0 = hashChain(wrapCell(cell.z, period.z), hashSeed(seed));
  Uint layer1 = hashChain(wrapCell(cell.z + 1, period.z), hashSeed(seed));
  Int y0 = wrapCell(cell.y, period.y);
  Int y1 = wrapCell(cell.y + 1, period.y);
  Uint row00 = hashChain(y0, layer0);
  Uint row10 = hashChain(y1, layer0);
  Uint row01 = hashChain(y0, layer1);
  Uint row11 = hashChain(y1, layer1);
  Real wy = fadeQuintic(f.y);
  Real wz = fadeQuintic(f.z);
  Vec2 left = perlin3Side(wrapCell(cell.x, period.x), row00, row10, row01, row11, f.y, f.z, wy, wz);
  Vec2 right = perlin3Side(wrapCell(cell.x + 1, period.x), row00, row10, row01, row11, f.y, f.z, wy, wz);
  return perlinBlend(left, right, f.x, fadeQuintic(f.x));
}
FN Real perlin3At(IN(IVec3) cell, IN(Vec3) f, IN(int) period, IN(uint) seed) {
  return perlin3At(cell, f, ivec3(period), seed);
}
FN Real perlin3(IN(Vec3) p, IN(ivec3) period, IN(uint) seed) {
  Vec3 whole = floor(p);
  return perlin3At(IVec3(toInt(whole.x), toInt(whole.y), toInt(whole.z)), p - whole, period, seed);
}
FN Real perlin3(IN(Vec3) p, IN(int) period, IN(uint) seed) { return perlin3(p, ivec3(period), seed); }

// The same noise with its derivatives per cell: (d/dx, d/dy, value) and (d/dx, d/dy, d/dz, value).
FN Vec3 perlin2SlopeAt(IN(IVec2) cell, IN(Vec2) f, IN(int) period, IN(uint) seed) {
  Int x0 = wrapCell(cell.x, period);
  Int x1 = wrapCell(cell.x + 1, period);
  Uint row0 = hashChain(wrapCell(cell.y, period), hashSeed(seed));
  Uint row1 = hashChain(wrapCell(cell.y + 1, period), hashSeed(seed));
  Vec2 g00 = gradient2(hashChain(x0, row0));
  Vec2 g10 = gradient2(hashChain(x1, row0));
  Vec2 g01 = gradient2(hashChain(x0, row1));
  Vec2 g11 = gradient2(hashChain(x1, row1));
  Real v00 = g00.x * f.x + g00.y * f.y;
  Real v10 = g10.x * (f.x - 1.0f) + g10.y * f.y;
  Real v01 = g01.x * f.x + g01.y * (f.y - 1.0f);
  Real v11 = g11.x * (f.x - 1.0f) + g11.y * (f.y - 1.0f);
  Real wx = fadeQuintic(f.x);
  Real wy = fadeQuintic(f.y);
  Vec2 g = mix(mix(g00, g10, wx), mix(g01, g11, wx), wy);
  Real low = mix(v00, v10, wx);
  Real high = mix(v01, v11, wx);
  return Vec3(g.x + fadeQuinticSlope(f.x) * mix(v10 - v00, v11 - v01, wy),
              g.y + fadeQuinticSlope(f.y) * (high - low), mix(low, high, wy));
}

// One z layer of perlin3SlopeAt, its derivative along z still without the fade's part.
FN Vec4 perlin3LayerSlope(IN(Int) x0, IN(Int) x1, IN(Uint) row0, IN(Uint) row1, IN(Vec3) f, IN(Vec3) w) {
  Vec3 g00 = gradient3(hashChain(x0, row0));
  Vec3 g10 = gradient3(hashChain(x1, row0));
  Vec3 g01 = gradient3(hashChain(x0, row1));
  Vec3 g11 = gradient3(hashChain(x1, row1));
  Real v00 = g00.x * f.x + g00.y * f.y + g00.z * f.z;
  Real v10 = g10.x * (f.x - 1.0f) + g10.y * f.y + g10.z * f.z;
  Real v01 = g01.x * f.x + g01.y * (f.y - 1.0f) + g01.z * f.z;
  Real v11 = g11.x * (f.x - 1.0f) + g11.y * (f.y - 1.0f) + g11.z * f.z;
  Vec3 g = mix(mix(g00, g10, w.x), mix(g01, g11, w.x), w.y);
  Real low = mix(v00, v10, w.x);
  Real high = mix(v01, v11, w.x);
  return Vec4(g.x + fadeQuinticSlope(f.x) * mix(v10 - v00, v11 - v01, w.y),
              g.y + fadeQuinticSlope(f.y) * (high - low), g.z, mix(low, high, w.y));
}
FN Vec4 perlin3SlopeAt(IN(IVec3) cell, IN(Vec3) f, IN(int) period, IN(uint) seed) {
  Int x0 = wrapCell(cell.x, period);
  Int x1 = wrapCell(cell.x + 1, period);
  Int y0 = wrapCell(cell.y, period);
  Int y1 = wrapCell(cell.y + 1, period);
  Uint layer0 = hashChain(wrapCell(cell.z, period), hashSeed(seed));
  Uint layer1 = hashChain(wrapCell(cell.z + 1, period), hashSeed(seed));
  Vec3 w = Vec3(fadeQuintic(f.x), fadeQuintic(f.y), fadeQuintic(f.z));
  Vec4 near = perlin3LayerSlope(x0, x1, hashChain(y0, layer0), hashChain(y1, layer0), f, w);
  Vec4 far = perlin3LayerSlope(x0, x1, hashChain(y0, layer1), hashChain(y1, layer1), f - Vec3(0.0f, 0.0f, 1.0f), w);
  Vec4 n = mix(near, far, w.z);
  return Vec4(n.x, n.y, n.z + fadeQuinticSlope(f.z) * (far.w - near.w), n.w);
}
