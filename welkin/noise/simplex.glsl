// Simplex noise (K. Perlin 2001; S. Gustavson, "Simplex noise demystified", 2005) of 3 and 4 variables, within -1 to 1.
// Seamless where asked: it repeats after `period` units on every axis if that is a multiple of 3, 0 never. The lattice
// is skewed by 1/3 in both; in 4D, where regular simplices would need the irrational .309 and could not repeat, they
// are squeezed by 4 %. A lattice point is hashed by its place on the axes in units of 1/6 and 1/7, which wraps.
// The kernels end at the faces of the simplices, so that the noise has no steps.

FN Real simplexKernel3(IN(Vec3) d, IN(Int) x, IN(Int) y, IN(Int) z, IN(int) period, IN(uint) seed) {
  Int sum = x + y + z;
  Uint h = hashCell3(wrapCell(x * 6 - sum, period * 6), wrapCell(y * 6 - sum, period * 6),
                     wrapCell(z * 6 - sum, period * 6), seed);
  Real t = max(0.5f - dot(d, d), 0.0f);
  return t * t * t * t * dot(gradient3(h), d);
}

FN Real simplex3(IN(Vec3) p, IN(int) period, IN(uint) seed) {
  Real skew = (p.x + p.y + p.z) * 0.333333333f;
  Vec3 whole = floor(p + Vec3(skew));
  Vec3 d = p - whole + Vec3((whole.x + whole.y + whole.z) * 0.166666667f);
  // Rank of each axis by its fraction: the walk from corner to corner takes the largest first.
  Real xy = step(d.y, d.x);
  Real xz = step(d.z, d.x);
  Real yz = step(d.z, d.y);
  Vec3 rank = Vec3(xy + xz, 1.0f - xy + yz, 2.0f - xz - yz);
  Int x = toInt(whole.x);
  Int y = toInt(whole.y);
  Int z = toInt(whole.z);
  Real n = 0.0f;
  for (int corner = 0; corner < 4; ++corner) {
    Real least = 2.5f - toReal(corner);
    Vec3 o = Vec3(step(least, rank.x), step(least, rank.y), step(least, rank.z));
    n += simplexKernel3(d - o + Vec3(toReal(corner) * 0.166666667f), x + toInt(o.x), y + toInt(o.y), z + toInt(o.z),
                        period, seed);
  }
  return n * 76.0f;
}

FN Real simplexKernel4(IN(Vec4) d, IN(Int) x, IN(Int) y, IN(Int) z, IN(Int) w, IN(int) period, IN(uint) seed) {
  Int sum = x + y + z + w;
  Uint h = hashCell4(wrapCell(x * 7 - sum, period * 7), wrapCell(y * 7 - sum, period * 7),
                     wrapCell(z * 7 - sum, period * 7), wrapCell(w * 7 - sum, period * 7), seed);
  Real t = max(0.473684211f - dot(d, d), 0.0f);
  return t * t * t * t * dot(gradient4(h), d);
}

FN Real simplex4(IN(Vec4) p, IN(int) period, IN(uint) seed) {
  Real skew = (p.x + p.y + p.z + p.w) * 0.333333333f;
  Vec4 whole = floor(p + Vec4(skew));
  Vec4 d = p - whole + Vec4((whole.x + whole.y + whole.z + whole.w) * 0.142857143f);
  Real xy = step(d.y, d.x);
  Real xz = step(d.z, d.x);
  Real xw = step(d.w, d.x);
  Real yz = step(d.z, d.y);
  Real yw = step(d.w, d.y);
  Real zw = step(d.w, d.z);
  Vec4 rank = Vec4(xy + xz + xw, 1.0f - xy + yz + yw, 2.0f - xz - yz + zw, 3.0f - xw - yw - zw);
  Int x = toInt(whole.x);
  Int y = toInt(whole.y);
  Int z = toInt(whole.z);
  Int w = toInt(whole.w);
  Real n = 0.0f;
  for (int corner = 0; corner < 5; ++corner) {
    Real least = 3.5f - toReal(corner);
    Vec4 o = Vec4(step(least, rank.x), step(least, rank.y), step(least, rank.z), step(least, rank.w));
    n += simplexKernel4(d - o + Vec4(toReal(corner) * 0.142857143f), x + toInt(o.x), y + toInt(o.y), z + toInt(o.z),
                        w + toInt(o.w), period, seed);
  }
  return n * 80.0f;
}
