// Thin high clouds: a drifting two-dimensional field of vertical optical depth (004 ch. 4.5.4).

struct SheetParams {
  float height, opticalDepth, coverage, warp;
  Lattice fibres;   // stretched: x along the fibres
  Lattice patches;  // where the sheet is
  Lattice bend;     // the wind field that curls the fibres
  int kind, seed, spare0, spare1;
};

const int kSheetCirrus = 0;
const int kSheetCirrostratus = 1;
const int kSheetCirrocumulus = 2;
const int kSheetAltocumulus = 3;

const float kIceAsymmetry = 0.78f;    // mean cosine of scattering: .75 to .82 for ice
const float kWaterAsymmetry = 0.86f;  // droplets

// Ridges of gradient noise, each octave finer by 2 and weaker by `gain`, 0..1.
FN Real ridgedFbm(IN(Vec2) p, IN(Lattice) l, IN(float) gain, IN(int) octaves, IN(uint) seed) {
  Real sum = 0.0f;
  float weight = 1.0f;
  float total = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    Real ridge = 1.0f - abs(2.0f * latticeNoise(p, l, 1 << i, seed + uint(i)) - 1.0f);
    sum += weight * ridge * ridge;
    total += weight;
    weight *= gain;
  }
  return sum / total;
}

// Rounded tufts of a cellular sheet, 0..1: 1 - F1^2 of the lattice subdivided `scale` times.
FN Real tufts(IN(Vec2) p, IN(Lattice) l, IN(int) scale, IN(uint) seed) {
  Vec2 g = latticePoint(p, l, float(scale));
  Vec2 base = floor(g);
  Real nearest = 9.0f;
  for (int i = 0; i < 9; ++i) {
    Vec2 cell = base + Vec2(float(i % 3 - 1), float(i / 3 - 1));
    Uint h = hashCell2(toInt(cell.x) + l.cellX * scale, toInt(cell.y) + l.cellY * scale, seed);
    Vec2 d = g - cell - Vec2(unitFromHash(h), unitFromHash(nextHash(h)));
    nearest = min(nearest, dot(d, d));
  }
  return max(1.0f - nearest, 0.0f);
}

// Vertical optical depth of the sheet above (or below) p, relative to the anchor.
FN Real sheetOpticalDepth(IN(Vec2) p, IN(SheetParams) s) {
  uint seed = uint(s.seed) * 16u;
  Vec2 bend = Vec2(latticeFbm(p, s.bend, seed + 1u), latticeFbm(p, s.bend, seed + 5u)) - Vec2(0.5f);
  Real patch_ = 0.6f * latticeNoise(p + bend * s.warp, s.patches, 1, seed + 9u) +
                0.4f * latticeNoise(p, s.patches, 2, seed + 10u);
  Real open = mix(Real(0.85f), Real(0.05f), Real(s.coverage));
  Real mask = smoothstep(open, open + 0.35f, patch_);
  if (s.kind == kSheetCirrus) {
    Vec2 fine = Vec2(latticeNoise(p, s.bend, 6, seed + 31u), latticeNoise(p, s.bend, 6, seed + 37u)) - Vec2(0.5f);
    Real r = ridgedFbm(p + bend * (2.0f * s.warp) + fine * (0.12f * s.warp), s.fibres, 0.68f, 7, seed + 13u);
    return s.opticalDepth * mask * smoothstep(0.22f, 0.85f, r) * 1.4f;
  }
  if (s.kind == kSheetCirrostratus) {
    Real veil = 0.75f + 0.25f * ridgedFbm(p + bend * s.warp, s.fibres, 0.55f, 5, seed + 13u);
    return s.opticalDepth * mask * veil;
  }
  // Grains of two sizes, thin at their edges; here and there in ripples across the fibres; a faint veil between them.
  int grain = 1;
  if (s.kind == kSheetCirrocumulus) grain = 2;
  Vec2 fine = Vec2(latticeNoise(p, s.fibres, grain, seed + 25u), latticeNoise(p, s.fibres, grain, seed + 27u)) - Vec2(0.5f);
  Vec2 q = p + bend * s.warp + fine * (0.5f * s.fibres.size / float(grain));
  Real t = 0.6f * tufts(q, s.fibres, grain, seed + 17u) + 0.4f * tufts(q, s.fibres, 3 * grain, seed + 19u);
  Real rolls = smoothstep(0.35f, 0.65f, latticeNoise(p, s.bend, 3, seed + 23u));
  Real phase = latticePoint(q, s.fibres, 1.0f).y * float(grain + 1) + 2.0f * latticeNoise(p, s.bend, 6, seed + 29u);
  Real ripple = 0.5f + 0.5f * cos(6.2831853f * fract(phase));
  t = t * mix(Real(1.0f), 0.55f + 0.45f * ripple, rolls);
  Real edge = mix(Real(0.8f), Real(0.45f), mask * (0.6f + 0.4f * latticeNoise(p, s.bend, 5, seed + 33u)));
  Real grains = saturate((t - edge) / (1.0f - edge));
  return s.opticalDepth * mask * (0.08f + 1.04f * grains * (1.3f - 0.3f * grains));
}

// Share of its extinction that makes light forget where it came from.
FN float sheetTurned(IN(SheetParams) s) {
  return 1.0f - (s.kind == kSheetAltocumulus ? kWaterAsymmetry : kIceAsymmetry);
}

// Optical depth on the way from p toward a light, `rise` m below the sheet, as far as it turns light aside. The light
// stands at a height of sine `slant` over p; over the sheet it is higher, since the ground curves away.
FN Real sheetDepthToward(IN(Vec2) p, IN(Real) rise, IN(Vec3) light, IN(Real) slant, IN(float) inverseRadius,
                         IN(SheetParams) s) {
  Real low = max(slant, 0.01f);
  Real there = sqrt(max(low * low + 2.0f * inverseRadius * rise, 1e-4f));
  Real way = 2.0f * rise / (low + there);
  return sheetOpticalDepth(p + Vec2(light.x, light.y) * way, s) * sheetTurned(s) / there;
}
