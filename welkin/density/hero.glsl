// Hero clouds (003 ch. 3-4): single clouds as a depth in metres below their surface. Points are those of cloud space; a
// cloud's own axes are x along its heading, y to the left of it, and z above its base.

const int kHeroSolid = 0;
const int kHeroPlates = 1;
const int kHeroPatches = 2;
const int kHeroFilaments = 3;
const int kHeroPouches = 4;
const int kHeroClassic = 5;

// Of filaments, and of all parts: a bundle has two rows of its own and two for each strand.
const int kHeroStrands = 14;
const int kHeroParts = 390;

struct HeroParams {
  vec4 place;  // xyz: the middle of the base, relative to the anchor; w: its size, m
  vec4 low;    // corner of the box that holds all of it, in its own axes; w: height, m
  vec4 high;   // the other corner; w: extinction, 1/m
  vec4 rise;   // xyz: offset of the largest billows in tiles, w: 1 / tile
  vec4 wind;   // classic: offset of the simplex noise in cells, and time in cells
  float axisX, axisY, edge, edgeTop;
  float billow, billowSize, billowRatio, billowLow;  // m, m; of octave to octave; share at the base
  float calmTop, calmFrom, calmTo, interior;         // share of the billows at the top; heights in m
  float baseFade, baseNoise, baseScale, reach;       // m, m, 1/m; sum of the octaves' depths, m
  float anvilRadius, anvilTop, anvilThickness, anvilDensity;  // m, m, m; share of the extinction
  float anvilX, anvilRamp, wisp, breadth;  // m, m, m; across over along
  float distortion, worley, clump, wave;   // classic
  float simplex, whisp, cellScale, halfWidth;  // cells of simplex noise in one of the cellular; m
  int kind, octaves, parts, seed;
  ScatterParams scatter;
};

// plates: (x, y, z, radius), (thickness above, below, arch, stretch of the lee), all in m but the last.
// patches: (x, y, z, 0), (1 / radius along each axis, 0).
// filaments, a bundle: (middle x, half x, middle y, half y) of a box round it, (x, y, z, radius) of its head, and for
// each strand (x, y, z, depth of fall), (curvature in 1/m, width in m, strength, 0).
struct HeroParts { vec4 part[kHeroParts]; };

// Feature points along an edge of the tile of billows; their parabola, deepest in the creases; its mean over space.
const float kHeroCells = 12.0f;
const float kHeroBillowTop = 0.4f;
const float kHeroBillowDeep = 0.75f;
const float kHeroBillowMean = 0.7f;

FN Vec3 heroAxes(IN(Vec3) q, IN(HeroParams) c) {
  Vec3 p = q;
  if (c.scatter.place.w > 0.0f) p = scatteredPoint(q, c.scatter);
  Real x = p.x - c.place.x;
  Real y = p.y - c.place.y;
  return Vec3(x * c.axisX + y * c.axisY, y * c.axisX - x * c.axisY, p.z - c.place.z);
}

// How strong the billows are at a height: less at the flat base, less where the top turns to ice.
FN Real heroRoughness(IN(Real) z, IN(HeroParams) c) {
  Real low = mix(Real(c.billowLow), Real(1.0f), smoothstep(0.0f, 0.25f * c.place.w, z));
  return low * mix(Real(1.0f), Real(c.calmTop), smoothstep(c.calmFrom, c.calmTo, z));
}

// Moves the surface by nested billows: each octave is sampled at the foot point on the surface that the larger ones
// have left, along the normal of the base shape (xyz; w its depth in m). Octaves finer than `footprint` keep their mean.
// Where what is left can no longer bring the depth into the ramp from `ramp.x` to `ramp.y`, the answer is some depth on
// the right side of it.
FN Real heroBillows(IN(Vec3) x, IN(Vec4) shape, IN(Real) footprint, IN(Vec2) ramp, IN(HeroParams) c,
                    IN(Sampler3) billows) {
  Real p = shape.w;
  Vec3 normal = xyz(shape);
  Real rough = heroRoughness(x.z, c);
  float amplitude = c.billow;
  float size = c.billowSize;
  float tile = c.rise.w;
  vec3 origin = xyz(c.rise);
  float left = c.reach;
  for (int i = 0; i < c.octaves; ++i) {
    if (noneOf(both(p < ramp.y + kHeroBillowDeep * left, p > ramp.x - kHeroBillowTop * left))) break;
    Vec3 q = x + normal * clamp(p, -1.2f * size, 1.2f * size);
    Real b = sample3(billows, q * tile + Vec3(origin)).x;
    b = mix(b, Real(kHeroBillowMean), smoothstep(0.25f * size, 0.75f * size, footprint));
    p += amplitude * rough * (1.15f * b - kHeroBillowDeep);
    left -= amplitude;
    amplitude *= c.billowRatio;
    size *= 0.5f;
    tile *= 2.0f;
    origin = origin * 2.0f + vec3(0.37f, 0.59f, 0.83f);
  }
  return p;
}

// Share of the base's edge that is cloud: a level that undulates.
FN Real heroBase(IN(Vec3) x, IN(HeroParams) c) {
  if (noneOf(x.z < c.baseFade + 1.04f * c.baseNoise)) return Real(1.0f);
  Real n = perlinFbm2(Vec2(x.x, x.y) * c.baseScale, 0, 3, 2, 0.5f, uint(c.seed));
  return smoothstep(0.0f, c.baseFade, x.z + c.baseNoise * n);
}

// How far the wind has torn the surface, m: on the lee side and above the base.
FN Real heroTorn(IN(Vec3) x, IN(HeroParams) c) {
  float scale = 12.0f / c.place.w;
  Vec3 q = Vec3(x.x * (0.6f * scale), x.y * scale, x.z * scale);
  Real n = saturate(0.45f + perlinFbm3(q, 0, 4, 2, 0.6f, uint(c.seed) + 31u));
  Real lee = smoothstep(-0.3f * c.halfWidth, 0.5f * c.halfWidth, x.x);
  return c.wisp * n * mix(Real(0.15f), Real(1.0f), lee);
}

// The anvil: a wedge of ice, thick over the updraught and thin at its rim, with radial fibres. Returns its share of
// the ice's extinction, and in y how much of the water it replaces.
FN Vec2 heroAnvil(IN(Vec3) x, IN(HeroParams) c) {
  Real vx = x.x - c.anvilX;
  Real away = sqrt(vx * vx + x.y * x.y) + 1e-3f;
  Vec2 way = Vec2(vx, x.y) / away;
  Real rim = c.anvilRadius * (1.0f + 0.3f * perlinFbm2(way * 2.2f, 0, 2, 2, 0.5f, uint(c.seed) + 3u) +
                              0.08f * perlinFbm2(way * 9.0f, 0, 3, 2, 0.5f, uint(c.seed) + 5u));
  Real t = away / rim;
  Real up = sqrt(x.x * x.x + x.y * x.y) + 1e-3f;
  Real core = up / (0.35f * c.anvilRadius);
  Real plume = exp(-0.5f * core * core);
  Real dome = up / (0.11f * c.anvilRadius);
  float th = c.anvilThickness;
  Real flat_ = sqrt(saturate(1.0f - t * t));
  Real swell = perlinFbm2(Vec2(x.x, x.y) * (5.0f / c.anvilRadius), 0, 3, 2, 0.5f, uint(c.seed) + 7u);
  Real top = c.anvilTop + th * (0.45f * flat_ + 0.5f * exp(-0.5f * dome * dome) + 0.14f * swell);
  Real thin = saturate(1.0f - t);
  Real bottom = c.anvilTop - th * (1.1f * thin + 0.12f + 1.2f * plume + 0.3f * swell * thin);
  Vec2 from = Vec2(x.x, x.y) / up;
  Vec3 along = Vec3(from.x * 20.0f, from.y * 20.0f, x.z / (0.8f * th) + up / (0.8f * c.anvilRadius));
  Real fibre = 0.5f + perlinFbm3(along, 0, 4, 2, 0.6f, uint(c.seed) + 11u);
  Real depth = min(min(top - x.z, x.z - bottom), (rim - away) * 0.3f);
  depth -= 0.45f * th * saturate(fibre) * smoothstep(0.15f, 0.9f, t);
  Real ice = smoothstep(0.0f, c.anvilRamp, depth);
  return Vec2(ice * mix(Real(1.0f), Real(0.25f), saturate(t)), ice);
}

// Depths between which density rises from 0 to 1: the edge, or as wide as the footprint about its middle.
FN Vec2 heroRamp(IN(Real) edge, IN(Real) footprint) {
  Real half_ = 0.5f * max(edge, footprint);
  return Vec2(0.5f * edge - half_, 0.5f * edge + half_);
}

// Density shares of each kind at a point in the cloud's own axes.
FN Real heroSolid(IN(Vec3) x, IN(Mask) within, IN(Real) footprint, IN(HeroParams) c, IN(Sampler3) shape, IN(Sampler3) billows) {
  Vec3 low = xyz(c.low);
  Vec4 base = sample3(shape, (x - low) / (xyz(c.high) - low));
  if (c.wisp > 0.0f) base.w -= heroTorn(x, c);
  base.w = select(within, base.w, Real(-1e9f));
  Vec2 ramp = heroRamp(mix(Real(c.edge), Real(c.edgeTop), smoothstep(c.calmFrom, c.calmTo, x.z)), footprint);
  Real p = heroBillows(x, base, footprint, ramp, c, billows);
  Real dense = smoothstep(ramp.x, ramp.y, p) * heroBase(x, c);
  dense *= mix(Real(c.interior), Real(1.0f), sqrt(saturate(x.z / c.low.w)));
  if (c.anvilRadius > 0.0f) {
    Vec2 ice = heroAnvil(x, c);
    dense = max(dense * (1.0f - 0.55f * ice.y), c.anvilDensity * ice.x);
  }
  return dense;
}

FN Real heroPlates(IN(Vec3) x, IN(Real) footprint, IN(HeroParams) c, IN(HeroParts) parts) {
  float far = c.halfWidth;
  Real bent = 0.22f * perlinFbm2(Vec2(x.x, x.y) * (1.6f / far), 0, 3, 2, 0.5f, uint(c.seed) + 3u);
  Real p = -1e4f;
  for (int i = 0; i < c.parts; ++i) {
    vec4 at = parts.part[2 * i];
    vec4 plate = parts.part[2 * i + 1];
    Real dx = x.x - at.x;
    dx = select(dx > 0.0f, dx / plate.w, dx) / at.w;
    Real dy = (x.y - at.y) / (at.w * c.breadth);
    Real room = saturate(1.0f - (dx * dx + dy * dy) * (1.0f + bent));
    Real z = x.z - at.z - plate.z * room;
    p = max(p, min(plate.x * pow(room, Real(0.85f)) - z, z + plate.y * pow(room, Real(0.9f))));
  }
  Real frayed = 0.5f + perlinFbm3(Vec3(x.x / 900.0f, x.y / 160.0f, x.z / 130.0f), 0, 4, 2, 0.6f, uint(c.seed) + 5u);
  p -= c.wisp * saturate(frayed) * smoothstep(0.1f * far, far, x.x);
  Vec2 ramp = heroRamp(Real(c.edge), footprint);
  return smoothstep(ramp.x, ramp.y, p);
}

// Limits that its bounds rest on, and how far eddies carry, m.
const float kHeroFbmMost = 0.6f;
const float kHeroEddyMost = 2.0f;
const float kHeroEddy = 26.0f;

FN Real heroPatches(IN(Vec3) x, IN(HeroParams) c, IN(HeroParts) parts) {
  // Shredded by the wind: leaning, and curled in eddies.
  Vec3 q = Vec3(x.x - 0.5f * x.z, x.y, x.z);
  Vec3 eddy = curlFbm3(q * (1.0f / 210.0f), 0, 2, 2, 0.5f, uint(c.seed) + 3u);
  eddy = min(max(eddy, Vec3(Real(-kHeroEddyMost))), Vec3(Real(kHeroEddyMost)));
  q += eddy * kHeroEddy;
  Real inside = -9.0f;
  for (int i = 0; i < c.parts; ++i) {
    Vec3 d = (q - Vec3(xyz(parts.part[2 * i]))) * Vec3(xyz(parts.part[2 * i + 1]));
    inside = max(inside, 1.0f - pow(dot(d, d), Real(0.6f)));
  }
  Real torn = perlinFbm3(Vec3(q.x / 230.0f, q.y / 190.0f, q.z / 150.0f) + eddy * 0.35f, 0, 6, 2, 0.72f, uint(c.seed));
  Real p = 0.55f * inside - 0.1f + 2.2f * min(torn, kHeroFbmMost);
  Real fine = 0.4f + perlinFbm3(q / 45.0f, 0, 3, 2, 0.7f, uint(c.seed) + 17u);
  p -= 0.35f * saturate(fine) * (1.0f - smoothstep(0.0f, 0.35f, p));
  return smoothstep(0.0f, 0.35f, p) * smoothstep(0.0f, 0.1f * c.low.w, x.z);
}

const float kHeroBend = 130.0f;

FN Real heroFilaments(IN(Vec3) x, IN(HeroParams) c, IN(HeroParts) parts) {
  Vec3 g = x * (1.0f / 1500.0f);
  Real px = x.x + kHeroBend * perlin3(g, 0, uint(c.seed) + 3u);
  Real py = x.y + kHeroBend * perlin3(g, 0, uint(c.seed) + 5u);
  Real sum = 0.0f;
  for (int b = 0; b < c.parts; ++b) {
    int first = b * (2 + 2 * kHeroStrands);
    vec4 box = parts.part[first];
    Mask near = both(abs(px - box.x) < box.y, abs(py - box.z) < box.w);
    if (!noneOf(near)) {
      vec4 head = parts.part[first + 1];
      Vec3 d = (Vec3(px, py, x.z) - Vec3(xyz(head))) / head.w;
      Real r = d.x * d.x + d.y * d.y + 2.5f * d.z * d.z;
      Real tuft = exp(-r) * saturate(0.35f + 1.3f * perlinFbm3(x / 210.0f, 0, 4, 2, 0.65f, uint(c.seed) + 9u));
      Real all = select(r < 6.0f, 0.9f * tuft, Real(0.0f));
      for (int k = 0; k < kHeroStrands; ++k) {
        vec4 at = parts.part[first + 2 + 2 * k];
        vec4 strand = parts.part[first + 3 + 2 * k];
        Real fallen = at.z - x.z;
        Real u = fallen / at.w;
        Real below = max(fallen, 0.0f);
        Real width = strand.y * (1.0f + 2.0f * saturate(u));
        Real slope = 2.0f * strand.x * below;
        Real dx = (px - (at.x - strand.x * below * below)) / (width * (1.0f + 0.55f * slope));
        Real dy = (py - at.y) / width;
        Real dz = min(fallen, 0.0f) / width;
        Real e = dx * dx + dy * dy + dz * dz;
        Real left = saturate(1.0f - u);
        all += select(e < 7.0f, strand.z * exp(-e) * pow(left, Real(1.1f)), Real(0.0f));
      }
      sum += select(near, all, Real(0.0f));
    }
  }
  return saturate(sum);
}

// Lowest reach of pouches, as a share of the depth that they hang.
const float kHeroPouchMost = 1.25f;

FN Real heroPouchField(IN(Vec2) p, IN(uint) seed) {
  Vec2 whole = floor(p);
  Real sum = 1e-6f;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      Uint h = hashCell2(toInt(whole.x) + i, toInt(whole.y) + j, seed);
      Real at = unitFromHash(h);
      h = nextHash(h);
      Real up = unitFromHash(h);
      h = nextHash(h);
      Real size = 0.45f + 0.55f * unitFromHash(h);
      Vec2 d = p - whole - Vec2(toReal(i) + 0.15f + 0.7f * at, toReal(j) + 0.15f + 0.7f * up);
      sum += exp(14.0f * size * (1.0f - dot(d, d) / (0.42f * size * size)));
    }
  return max(log(sum) / 14.0f, 0.0f);
}
FN Real heroPouches(IN(Vec3) x, IN(Real) footprint, IN(HeroParams) c) {
  float inverse = 1.0f / c.billowSize;
  Vec2 g = Vec2(x.x, x.y) * inverse;
  Vec2 bend = Vec2(perlinFbm2(g * 0.7f, 0, 2, 2, 0.5f, uint(c.seed) + 3u),
                   perlinFbm2(g * 0.7f, 0, 2, 2, 0.5f, uint(c.seed) + 5u));
  g += bend * 0.35f;
  Real hangs = heroPouchField(g, uint(c.seed)) * 0.85f + heroPouchField(g * 1.9f + Vec2(0.37f, 0.21f), uint(c.seed) + 7u) * 0.25f;
  Real fine = perlinFbm3(x * (3.0f * inverse), 0, 4, 2, 0.55f, uint(c.seed) + 11u);
  Real face = c.billow * (kHeroPouchMost - min(hangs, kHeroPouchMost)) + 0.06f * c.billowSize * fine;
  Real across = x.y / c.breadth;
  Real rim = c.halfWidth - sqrt(x.x * x.x + across * across);
  Real p = min(min(x.z - face, c.low.w - x.z), 0.4f * rim + 0.2f * c.billow * bend.x);
  Vec2 ramp = heroRamp(Real(c.edge), footprint);
  return smoothstep(ramp.x, ramp.y, p);
}

// 003 eq. 3.4: the shape gradient S(Tz) - Tx^2 - Ty^2 comes from the shape's grid; the offset O varies about 1, and
// billows bulge outward, as in its figures 32 and 33. Octaves of the cellular noise: two, of lacunarity 2, as ch. 4.2
// fixes them.
const int kHeroPeriod = 96;
FN Real heroClassicOffset(IN(Vec3) x, IN(HeroParams) c) {
  Vec3 p = x * c.rise.w + Vec3(xyz(c.rise));
  Real cells = 1.0f - smoothstep(0.0f, 1.0f, worley3(p, kHeroPeriod, kWorleyEuclidean, uint(c.seed)).x);
  Real small = 1.0f - smoothstep(0.0f, 1.0f, worley3(p * 2.0f, 2 * kHeroPeriod, kWorleyEuclidean, uint(c.seed) + 1u).x);
  cells = (cells + c.clump * small) / (1.0f + c.clump);
  float scale = c.rise.w * c.cellScale;
  Vec4 q = Vec4(x.x * scale + c.wind.x, x.y * scale + c.wind.y, x.z * scale + c.wind.z, Real(c.wind.w));
  Real waves = 0.5f + 0.5f * sin(18.0f * x.x / c.halfWidth *
                                 (1.0f + 0.5f * simplex4(q, kHeroPeriod, uint(c.seed) + 2u)));
  cells = mix(cells, waves, Real(c.wave));
  Real fbm = 0.0f;
  float weight = 0.5f;
  for (int i = 0; i < c.octaves; ++i) {
    fbm += weight * simplex4(q, kHeroPeriod << i, uint(c.seed) + 3u + uint(i));
    q = Vec4(q.x * 2.0f, q.y * 2.0f, q.z * 2.0f, q.w);
    weight *= c.whisp;
  }
  Real texture_ = 0.5f * mix(Real(1.0f), 2.0f * cells, Real(c.worley)) *
                  mix(Real(1.0f), 2.0f * saturate(0.5f + fbm), Real(c.simplex));
  return 1.5f - saturate(texture_);
}
FN Real heroClassic(IN(Vec3) x, IN(HeroParams) c, IN(Sampler3) shape) {
  Vec3 low = xyz(c.low);
  Real gradient = sample3(shape, (x - low) / (xyz(c.high) - low)).w;
  return max(gradient + c.distortion * (1.0f - heroClassicOffset(x, c)), 0.0f);
}

// Extinction in 1/m at a point of cloud space. `shape`: normal and depth of the base shape over the box, clamped;
// `billows`: the tile of billows.
FN Real heroExtinction(IN(Vec3) point, IN(Real) footprint, IN(HeroParams) c, IN(HeroParts) parts, IN(Sampler3) shape,
                       IN(Sampler3) billows) {
  Vec3 x = heroAxes(point, c);
  Mask within = both(both(both(x.x > c.low.x, x.x < c.high.x), both(x.y > c.low.y, x.y < c.high.y)),
                     both(x.z > c.low.z, x.z < c.high.z));
  Real dense = 0.0f;
  if (c.kind == kHeroSolid) dense = heroSolid(x, within, footprint, c, shape, billows);
  if (c.kind == kHeroPlates) dense = heroPlates(x, footprint, c, parts);
  if (c.kind == kHeroPatches) dense = heroPatches(x, c, parts);
  if (c.kind == kHeroFilaments) dense = heroFilaments(x, c, parts);
  if (c.kind == kHeroPouches) dense = heroPouches(x, footprint, c);
  if (c.kind == kHeroClassic) dense = heroClassic(x, c, shape);
  return select(within, c.high.w * dense, Real(0.0f));
}
