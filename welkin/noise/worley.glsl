// Cellular noise (S. Worley, "A cellular texture basis function", 1996; 000 ch. 2.3.2): distances to one feature point
// in every cell. One cell is one unit of p; it repeats after `period` cells, 0 never.
// Results are (F1, F2), the nearest and the second nearest distance, exact up to a limit to which both are cut, because
// no further neighbours are searched: 2 in the plane (5^2 cells) and for Manhattan distances (5^3), 1 for Euclidean
// ones in space (3^3), which F1 exceeds in .1 % of space and F2 in 2 %.

const int kWorleyEuclidean = 0;
const int kWorleyManhattan = 1;

// The feature point inside its cell, from one hash: on a grid of 2^-16 in the plane and 2^-10 in space.
FN Vec2 worleyPoint2(IN(Uint) h) {
  return Vec2(toReal(toInt(h & 65535u)) + 0.5f, toReal(toInt(h >> 16u)) + 0.5f) * 1.52587890625e-5f;
}
FN Vec3 worleyPoint3(IN(Uint) h) {
  return Vec3(toReal(toInt(h & 1023u)) + 0.5f, toReal(toInt((h >> 10u) & 1023u)) + 0.5f,
              toReal(toInt((h >> 20u) & 1023u)) + 0.5f) * 0.0009765625f;
}

FN Vec2 worley2At(IN(IVec2) cell, IN(Vec2) f, IN(ivec2) period, IN(int) metric, IN(uint) seed) {
  const int reach = 2;
  Real f1 = metric == kWorleyManhattan ? 2.0f : 4.0f;
  Real f2 = f1;
  for (int y = -reach; y <= reach; ++y) {
    Uint row = hashChain(wrapCell(cell.y + y, period.y), hashSeed(seed));
    for (int x = -reach; x <= reach; ++x) {
      Vec2 d = Vec2(toReal(x), toReal(y)) + worleyPoint2(hashChain(wrapCell(cell.x + x, period.x), row)) - f;
      Real q = metric == kWorleyManhattan ? abs(d.x) + abs(d.y) : d.x * d.x + d.y * d.y;
      f2 = min(f2, max(f1, q));
      f1 = min(f1, q);
    }
  }
  if (metric == kWorleyManhattan) return Vec2(f1, f2);
  return Vec2(sqrt(f1), sqrt(f2));
}
FN Vec2 worley2(IN(Vec2) p, IN(int) period, IN(int) metric, IN(uint) seed) {
  Vec2 whole = floor(p);
  return worley2At(IVec2(toInt(whole.x), toInt(whole.y)), p - whole, ivec2(period), metric, seed);
}

FN Vec2 worley3At(IN(IVec3) cell, IN(Vec3) f, IN(ivec3) period, IN(int) metric, IN(uint) seed) {
  int reach = metric == kWorleyManhattan ? 2 : 1;
  Real f1 = toReal(reach);
  Real f2 = toReal(reach);
  for (int z = -reach; z <= reach; ++z) {
    Uint layer = hashChain(wrapCell(cell.z + z, period.z), hashSeed(seed));
    for (int y = -reach; y <= reach; ++y) {
      Uint row = hashChain(wrapCell(cell.y + y, period.y), layer);
      for (int x = -reach; x <= reach; ++x) {
        Vec3 point = worleyPoint3(hashChain(wrapCell(cell.x + x, period.x), row));
        Vec3 d = Vec3(toReal(x), toReal(y), toReal(z)) + point - f;
        Real q = metric == kWorleyManhattan ? abs(d.x) + (abs(d.y) + abs(d.z)) : d.x * d.x + (d.y * d.y + d.z * d.z);
        f2 = min(f2, max(f1, q));
        f1 = min(f1, q);
      }
    }
  }
  if (metric == kWorleyManhattan) return Vec2(f1, f2);
  return Vec2(sqrt(f1), sqrt(f2));
}
FN Vec2 worley3(IN(Vec3) p, IN(int) period, IN(int) metric, IN(uint) seed) {
  Vec3 whole = floor(p);
  return worley3At(IVec3(toInt(whole.x), toInt(whole.y), toInt(whole.z)), p - whole, ivec3(period), metric, seed);
}

// Inverted noise, 1 at feature points; billow is its rounded form, the tops of cauliflower; gap is 0 on the borders
// between the cells.
FN Real worleyInverted(IN(Real) f1) { return max(0.0f, 1.0f - f1); }
FN Real billow(IN(Real) f1) { return max(0.0f, 1.0f - f1 * f1); }
FN Real worleyGap(IN(Vec2) distances) { return distances.y - distances.x; }
