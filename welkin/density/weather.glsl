// The weather: a pure function of world position that says how clouds are spread over the land. Positions are
// relative to an anchor (the camera, or any point); lattices carry the anchor as integer cell and fraction, worked out in
// double precision, so that the pattern neither repeats nor loses precision far from the origin.
//
// A texel of weather is (height of the cloud top above its base in m, shift of the base in m, anvil 0..1,
// precipitation 0..1) for shape "profile" and (coverage, type, precipitation, shift of the base in m) for "nubis". It is
// cached in two textures of two channels, since "profile" rarely needs the second.

// A lattice of rectangles seen from the anchor: cell and fraction of the anchor in the lattice, edges of a cell in m,
// and its x axis as a unit vector.
struct Lattice {
  float fracX, fracY, inverseSizeX, inverseSizeY;
  float size, axisX, axisY, spare0;
  int cellX, cellY, spare1, spare2;
};

struct WeatherParams {
  Lattice cells;     // clouds; size = diameter of the largest
  Lattice clusters;  // clusters and large-scale pattern
  Lattice warp;      // outline warp and base variation
  Lattice streets;   // streets and fronts: x runs across them
  float coverage, precipitation, type, anvil;
  float probability, falloff, clustering, roughness;  // chance of class 0; chance of a class against the one before
  float thickness, baseVariation, baseRange, mapInverseSize;
  float mapOffsetX, mapOffsetY, downwindX, downwindY;
  int population, useMap, seed, spare0;
};

const int kPopulationDomes = 0;
const int kPopulationClusters = 1;
const int kPopulationStreets = 2;
const int kPopulationCells = 3;
const int kPopulationFront = 4;
const int kPopulationUniform = 5;

// Position in the lattice refined by `octave` halvings: whole cell and fraction.
FN Vec2 latticePoint(IN(Vec2) p, IN(Lattice) l, IN(float) scale) {
  Vec2 q = Vec2(p.x * l.axisX + p.y * l.axisY, p.y * l.axisX - p.x * l.axisY);
  return Vec2(q.x * l.inverseSizeX + l.fracX, q.y * l.inverseSizeY + l.fracY) * scale;
}

// Smooth value noise on the lattice, 0..1; `scale` is a whole number of subdivisions.
FN Real latticeNoise(IN(Vec2) p, IN(Lattice) l, IN(int) scale, IN(uint) seed) {
  Vec2 g = latticePoint(p, l, float(scale));
  Vec2 cell = floor(g);
  Vec2 f = g - cell;
  Vec2 w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  Int x = toInt(cell.x) + l.cellX * scale;
  Int y = toInt(cell.y) + l.cellY * scale;
  Real a = unitFromHash(hashCell2(x, y, seed));
  Real b = unitFromHash(hashCell2(x + 1, y, seed));
  Real c = unitFromHash(hashCell2(x, y + 1, seed));
  Real d = unitFromHash(hashCell2(x + 1, y + 1, seed));
  return mix(mix(a, b, w.x), mix(c, d, w.x), w.y);
}

// Three octaves of it.
FN Real latticeFbm(IN(Vec2) p, IN(Lattice) l, IN(uint) seed) {
  return 0.57f * latticeNoise(p, l, 1, seed) + 0.29f * latticeNoise(p, l, 2, seed + 1u) +
         0.14f * latticeNoise(p, l, 4, seed + 2u);
}

// The authoring map at p: (coverage, precipitation, type, base height 0..1).
FN Vec4 authoring(IN(Vec2) p, IN(WeatherParams) w, IN(Sampler2) map) {
  if (w.useMap == 0) return Vec4(w.coverage, w.precipitation, w.type, 0.0f);
  return sample2(map, p * w.mapInverseSize + Vec2(w.mapOffsetX, w.mapOffsetY));
}

// Place across a front: 0 on its line, 1 two cluster sizes behind it.
FN Real acrossFront(IN(Vec2) p, IN(WeatherParams) w) {
  return (latticePoint(p, w.streets, 1.0f).x + float(w.streets.cellX)) * w.streets.size / (2.0f * w.clusters.size);
}
// 0 ahead of the line, 1 behind it.
FN Real growthBehind(IN(Vec2) p, IN(WeatherParams) w) { return smoothstep(-0.05f, 0.35f, acrossFront(p, w)); }

// Large-scale share of clouds round a point, mean 1: clusters, streets, fronts.
FN Real gathering(IN(Vec2) p, IN(WeatherParams) w) {
  uint seed = uint(w.seed);
  Real n = 0.67f * latticeNoise(p, w.clusters, 1, seed + 11u) + 0.33f * latticeNoise(p, w.clusters, 2, seed + 12u);
  if (w.population == kPopulationStreets) {
    Vec2 g = latticePoint(p, w.streets, 1.0f);
    Real across = g.x + 0.9f * (n - 0.5f);
    Real wave = 0.5f + 0.5f * cos(6.2831853f * across);
    return mix(Real(1.0f), 2.4f * wave * wave * (0.6f + 0.8f * n), Real(w.clustering));
  }
  if (w.population == kPopulationFront) {
    Real across = acrossFront(p, w) + 0.7f * (n - 0.5f);
    return 0.12f + 2.2f * smoothstep(-0.6f, 0.15f, across);
  }
  return max(1.0f + w.clustering * 3.2f * (n - 0.5f), 0.0f);
}

// How tall clouds may grow round a point, 1 except behind and ahead of a front.
FN Real growth(IN(Vec2) p, IN(WeatherParams) w) {
  if (w.population != kPopulationFront) return Real(1.0f);
  Real across = acrossFront(p, w);
  return max(mix(Real(0.22f), Real(1.0f), exp(-across * across * 14.0f)), 0.7f * growthBehind(p, w));
}

// Height of a dome of radius r and height h (m) at squared distance d2 from its centre: half an ellipsoid where it is
// wider than high, a paraboloid where it is higher, since steep sides stand like walls.
FN Real dome(IN(Real) d2, IN(Real) r, IN(Real) h) {
  Real x = max(1.0f - d2 / (r * r), 0.0f);
  return h * mix(sqrt(x), x, saturate(h / r - 0.5f));
}

// Clouds of one size class: (height in m, anvil 0..1). `scale` = 2^class subdivisions of the cell lattice.
FN Vec2 cloudsOfClass(IN(Vec2) p, IN(WeatherParams) w, IN(Sampler2) map, IN(int) scale, IN(float) chance) {
  uint seed = uint(w.seed) * 8u + uint(scale);
  float size = w.cells.size / float(scale);
  Vec2 g = latticePoint(p, w.cells, float(scale));
  Vec2 corner = floor(g - Vec2(0.5f));
  Real height = 0.0f;
  Real anvil = 0.0f;
  for (int i = 0; i < 4; ++i) {
    Vec2 cell = corner + Vec2(float(i & 1), float(i >> 1));
    Uint h = hashCell2(toInt(cell.x) + w.cells.cellX * scale, toInt(cell.y) + w.cells.cellY * scale, seed);
    Vec2 centre = cell + Vec2(unitFromHash(h), unitFromHash(nextHash(h)));
    Vec2 d = (g - centre) * size;  // m, from the centre of the cloud
    Vec2 place = p - d;
    Uint h2 = nextHash(h ^ 0x68E31DA4u);
    Vec4 map4 = authoring(place, w, map);
    // The chance of a cloud saturates smoothly, so that coverage can be dialled to 1.
    Real rate = chance * gathering(place, w) * map4.x / max(w.coverage, 1e-3f);
    Mask here = unitFromHash(h2) < 1.0f - exp(-rate);
    Real u = unitFromHash(nextHash(h2));
    // Towers with anvils, and those that stand among them, are narrow: an anvil reaches 3.4 radii, and no cloud may reach
    // farther than half a cell.
    float reach = size * mix(0.5f, scale == 1 ? 0.147f : 0.25f, saturate(w.anvil * 4.0f));
    Real r = reach * (0.5f + 0.5f * u);
    Real relative = r / (0.5f * w.cells.size);
    // Tops grow with the cloud's width; type lowers or raises them.
    Real lift = 1.0f;
    if (w.anvil <= 0.0f || scale > 1) lift = exp(0.75f * log(max(relative, 1e-4f)));
    Real grown = growth(place, w);
    Real top = w.thickness * grown * mix(Real(0.6f), Real(1.4f), map4.z) * lift * (0.8f + 0.2f * u);
    // Under an anvil stands a narrow core among many turrets.
    float tower = scale == 1 ? saturate(w.anvil * 4.0f) : 0.0f;
    Real best = dome(dot(d, d), mix(mix(0.8f, 1.0f, w.anvil), 0.5f, tower) * r, mix(0.6f, 0.95f, w.anvil) * top);
    Uint s = h2;
    int domes = tower > 0.0f ? 18 : 6;
    for (int j = 0; j < domes; ++j) {
      s = nextHash(s);
      Real away = sqrt(unitFromHash(s)) * mix(0.68f, 0.95f, tower);
      s = nextHash(s);
      Real turn = 6.2831853f * unitFromHash(s);
      Real rs = r * (mix(0.3f, 0.17f, tower) + 0.28f * unitFromHash(nextHash(s ^ 0x1B56C4E9u)));
      Vec2 e = d - Vec2(cos(turn), sin(turn)) * (away * r);
      best = max(best, dome(dot(e, e), rs, min(top * (1.0f - 0.75f * away), mix(3.1f, 6.0f, tower) * rs)));
    }
    height = max(height, select(here, best, Real(0.0f)));
    // The anvil: a plume that the wind carries off and that widens on its way, blunt to windward.
    Real along = d.x * w.downwindX + d.y * w.downwindY;
    Real across = d.y * w.downwindX - d.x * w.downwindY;
    along = along / (select(along > 0.0f, Real(2.9f), Real(1.4f)) * r);
    across = across / (r * (1.15f + 0.6f * saturate(along)));
    Real plume = max(1.0f - along * along, 0.0f) * max(1.0f - across * across, 0.0f);
    // Only what has grown to the tropopause spreads there.
    plume = plume * smoothstep(0.75f, 0.95f, grown);
    anvil = max(anvil, select(here, plume, Real(0.0f)) * (scale == 1 ? w.anvil : 0.0f));
  }
  return Vec2(height, anvil);
}

// Closed cells (stratocumulus): height in m. Walls of clear air between Worley cells, wider where coverage is low.
FN Real closedCells(IN(Vec2) p, IN(WeatherParams) w, IN(Real) coverage) {
  uint seed = uint(w.seed) + 77u;
  Vec2 g = latticePoint(p, w.cells, 1.0f);
  Vec2 base = floor(g);
  Real f1 = 9.0f;
  Real f2 = 9.0f;
  Real u = 0.0f;  // of the cell
  for (int i = 0; i < 9; ++i) {
    Vec2 cell = base + Vec2(float(i % 3 - 1), float(i / 3 - 1));
    Uint h = hashCell2(toInt(cell.x) + w.cells.cellX, toInt(cell.y) + w.cells.cellY, seed);
    Vec2 d = g - cell - Vec2(unitFromHash(h), unitFromHash(nextHash(h)));
    Real q = dot(d, d);
    u = select(q < f1, unitFromHash(nextHash(nextHash(h))), u);
    f2 = min(f2, max(f1, q));
    f1 = min(f1, q);
  }
  Real d1 = sqrt(f1);
  Real gap = sqrt(f2) - d1;
  Real large = latticeFbm(p, w.clusters, seed + 5u) - 0.5f;
  // The share of the plane with a gap below g is about 1 - exp(-3 g).
  Real open = -0.33f * log(max(coverage, 0.02f)) - 0.15f - 0.8f * w.clustering * large;
  // Where cells stand apart, some are small and some are gone.
  open = select(open > 0.0f, open * (0.2f + 1.6f * u), open);
  Real fill = smoothstep(open, open + 0.3f, gap);
  Real rounded = sqrt(max(1.0f - d1 * d1, 0.0f));
  Real vary = 0.75f + 0.5f * latticeFbm(p, w.warp, seed + 9u);
  return w.thickness * fill * (0.4f + 0.6f * rounded) * vary;
}

// A closed sheet (stratus, altostratus, nimbostratus): height in m.
FN Real uniformSheet(IN(Vec2) p, IN(WeatherParams) w, IN(Real) coverage) {
  uint seed = uint(w.seed) + 131u;
  Real large = latticeFbm(p, w.clusters, seed);
  Real small = latticeFbm(p, w.cells, seed + 7u);
  Real n = 0.6f * large + 0.4f * small;
  Real threshold = mix(Real(0.78f), Real(0.05f), coverage);
  return w.thickness * smoothstep(threshold, threshold + 0.18f, n) * (0.55f + 0.9f * (small - 0.25f * large));
}

// Weather for shape "profile" at p.
FN Vec4 profileWeather(IN(Vec2) p, IN(WeatherParams) w, IN(Sampler2) map) {
  uint seed = uint(w.seed);
  Vec2 bend = Vec2(latticeFbm(p, w.warp, seed + 21u), latticeFbm(p, w.warp, seed + 31u)) - Vec2(0.5f);
  Vec2 q = p + bend * (2.0f * w.roughness * min(w.warp.size, 0.35f * w.cells.size));
  Vec4 map4 = authoring(q, w, map);
  Real height = 0.0f;
  Real anvil = 0.0f;
  if (w.population == kPopulationCells) {
    height = closedCells(q, w, map4.x) * mix(Real(0.6f), Real(1.4f), map4.z);
  } else if (w.population == kPopulationUniform) {
    height = uniformSheet(q, w, map4.x);
  } else {
    float chance = w.probability;
    for (int c = 0; c < 3; ++c) {
      Vec2 found = cloudsOfClass(q, w, map, 1 << c, chance);
      height = max(height, found.x);
      anvil = max(anvil, found.y);
      chance *= w.falloff;
    }
    // Separate clouds cannot close the sky: above two thirds of coverage a sheet grows in their gaps. Behind a front it
    // is always there.
    float closing = saturate((w.coverage - 0.66f) * 3.0f);
    Real cover = map4.x * closing;
    if (w.population == kPopulationFront) cover = saturate(1.2f * map4.x) * growthBehind(q, w);
    if (closing > 0.0f || w.population == kPopulationFront)
      height = max(height, 0.45f * uniformSheet(q, w, cover) * smoothstep(0.05f, 0.5f, cover));
  }
  Real vary = latticeNoise(p, w.warp, 1, seed + 41u);
  Real shift = 2.0f * w.baseVariation * (vary - 0.5f) + w.baseRange * map4.w;
  Real rain = map4.y;
  // A sheet rains harder in some places than in others.
  if (w.population == kPopulationUniform && w.useMap == 0)
    rain = saturate(rain * 2.0f * smoothstep(0.3f, 0.7f, latticeFbm(p, w.cells, seed + 151u)));
  return Vec4(height, shift, anvil, rain);
}

// Weather for shape "nubis" at p (004 ch. 4.3.3): rain stands only where coverage is high, and turns the type to
// cumulonimbus.
FN Vec4 nubisWeather(IN(Vec2) p, IN(WeatherParams) w, IN(Sampler2) map) {
  uint seed = uint(w.seed);
  Vec4 map4 = authoring(p, w, map);
  Real large = latticeFbm(p, w.clusters, seed + 51u);
  Real small = latticeFbm(p, w.cells, seed + 61u);
  Real n = 0.55f * large + 0.45f * small;
  Real varied = saturate(map4.x + 1.6f * w.clustering * (n - 0.5f));
  Real coverage = varied;
  if (w.useMap != 0) coverage = map4.x;
  Real rain = map4.y * smoothstep(0.55f, 0.9f, coverage);
  Real type = saturate(map4.z + 0.5f * (latticeNoise(p, w.clusters, 2, seed + 71u) - 0.5f));
  return Vec4(max(coverage, 0.7f * rain), mix(type, Real(1.0f), rain), rain, w.baseRange * map4.w);
}

// Clip levels: nested squares round the camera, each a layer of one texture, cached texels of the function above.
struct ClipLevel {
  float offsetX, offsetY, inverseSize, margin;  // uv = p * inverseSize + offset; margin: uv left free at the border
};
struct ClipParams {
  ClipLevel level0, level1, level2, level3;
  float firstSlice, spare0, spare1;
  int count;
};

FN Mask insideLevel(IN(Vec2) uv, IN(Real) margin) {
  return max(abs(uv.x - 0.5f), abs(uv.y - 0.5f)) < 0.5f - margin;
}

// 1 / edge of a level.
FN Real levelScale(IN(ClipParams) clip, IN(Real) level) {
  Real scale = select(level > 0.5f, Real(clip.level1.inverseSize), Real(clip.level0.inverseSize));
  scale = select(level > 1.5f, Real(clip.level2.inverseSize), scale);
  return select(level > 2.5f, Real(clip.level3.inverseSize), scale);
}

// Where the cached weather of p stands, (u, v, layer): the finest level that holds it. `dither` in [0, 1) moves the
// border of the levels a little, so that it does not show.
FN Vec3 weatherPlace(IN(ClipParams) clip, IN(Vec2) p, IN(Real) dither) {
  Vec2 uv = p * clip.level0.inverseSize + Vec2(clip.level0.offsetX, clip.level0.offsetY);
  Real layer = 0.0f;
  Real edge = 1.0f + 3.0f * dither;
  Mask outside = invert(insideLevel(uv, clip.level0.margin * edge));
  Vec2 uv1 = p * clip.level1.inverseSize + Vec2(clip.level1.offsetX, clip.level1.offsetY);
  uv = select(outside, uv1, uv);
  layer = select(outside, Real(1.0f), layer);
  if (clip.count > 2) {
    outside = both(outside, invert(insideLevel(uv1, clip.level1.margin * edge)));
    Vec2 uv2 = p * clip.level2.inverseSize + Vec2(clip.level2.offsetX, clip.level2.offsetY);
    uv = select(outside, uv2, uv);
    layer = select(outside, Real(2.0f), layer);
    if (clip.count > 3) {
      outside = both(outside, invert(insideLevel(uv2, clip.level2.margin * edge)));
      uv = select(outside, p * clip.level3.inverseSize + Vec2(clip.level3.offsetX, clip.level3.offsetY), uv);
      layer = select(outside, Real(3.0f), layer);
    }
  }
  return Vec3(uv.x, uv.y, layer + clip.firstSlice);
}
