// Copies of one cloud strewn over the land: squares of which each holds one, by chance. A point is in one square only,
// so any number of copies costs what one does.

struct ScatterParams {
  vec4 place;  // xyz: the middle of the cloud's base, relative to the anchor; w: edge of a square, m; 0: it stands alone
  vec4 chance; // radius of the land, m; share of the squares; half the range of sizes; the cloud's own reach sideways, m
  vec4 axis;   // xy: along its heading; z: the farthest turn, rad; w: seed
};

// The copy in square (i, j): (shift x, shift y, turn, size), a size below 0 when it is mirrored, 0 where there is none.
// In the middle square stands the cloud itself.
FN Vec4 scatterCopy(IN(Real) i, IN(Real) j, IN(ScatterParams) s) {
  Mask first = both(abs(i) < 0.5f, abs(j) < 0.5f);
  Uint a = hashCell2(toInt(i), toInt(j), uint(s.axis.w));
  Uint b = nextHash(a);
  Uint c = nextHash(b);
  Uint d = nextHash(c);
  Uint e = nextHash(d);
  Uint f = nextHash(e);
  float edge = s.place.w;
  Mask here = both(unitFromHash(a) < s.chance.y, (i * i + j * j) * (edge * edge) <= s.chance.x * s.chance.x);
  Real size = 1.0f + s.chance.z * (2.0f * unitFromHash(b) - 1.0f);
  Real room = max(0.5f * edge - s.chance.w * size, 0.0f);
  Real side = select(unitFromHash(f) < 0.5f, -size, size);
  Vec4 copy = Vec4(room * (2.0f * unitFromHash(c) - 1.0f), room * (2.0f * unitFromHash(d) - 1.0f),
                   s.axis.z * (2.0f * unitFromHash(e) - 1.0f), select(here, side, Real(0.0f)));
  return select(first, Vec4(0.0f, 0.0f, 0.0f, 1.0f), copy);
}

// What point of the cloud itself stands at a point of cloud space; far below it where there is no copy.
FN Vec3 scatteredPoint(IN(Vec3) q, IN(ScatterParams) s) {
  Real x = q.x - s.place.x;
  Real y = q.y - s.place.y;
  float inverse = 1.0f / s.place.w;
  Real i = floor(x * inverse + 0.5f);
  Real j = floor(y * inverse + 0.5f);
  Vec4 copy = scatterCopy(i, j, s);
  Real size = max(abs(copy.w), 0.01f);
  Real dx = (x - i * s.place.w - copy.x) / size;
  Real dy = (y - j * s.place.w - copy.y) / size;
  Real turnX = cos(copy.z);
  Real turnY = sin(copy.z);
  Real ex = turnX * dx + turnY * dy;
  Real ey = turnX * dy - turnY * dx;
  Real along = 2.0f * (ex * s.axis.x + ey * s.axis.y);
  Mask mirrored = copy.w < 0.0f;
  ex = select(mirrored, along * s.axis.x - ex, ex);
  ey = select(mirrored, along * s.axis.y - ey, ey);
  Real z = s.place.z + (q.z - s.place.z) / size;
  return Vec3(s.place.x + ex, s.place.y + ey, select(abs(copy.w) > 0.0f, z, Real(-1e6f)));
}
