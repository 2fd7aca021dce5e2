// Shape "profile": a height field in metres minus noise in metres. A point of cloud space is (x, y relative to the
// anchor, altitude), all in m.

struct LayerParams {
  float base, thickness, extinction, shear;
  float downwindX, downwindY, lengthScale, lengthFraction;
  float minLength, erosion, baseErosion, baseCut;
  float detail, fineDetail, inverseRamp, baseFade;
  float baseRagged, liquidGradient, warp, anvilDensity;
  float bottom, top, anvilRamp, detailErosion;
  vec4 noise;   // xyz: offset of the base noise in tiles, w: 1 / tile
  vec4 warping; // of the warp noise
  vec4 detailing;
  vec4 fine;
  vec4 curl;     // nubis: curl noise, w: 1 / tile
  vec4 fibres;   // of the anvil: x along the wind, drawn out by kFibreStretch
  float curlAmplitude, detailTileRatio, spare0, spare1;
  int shape, transition, hasAnvil, needsExtra;
};

// What a layer answers at a point: (extinction in 1/m, depth inside the outline that detail carves, extinction times
// precipitation). The depth is in m, roughly, and not above 0 where no cloud can be.

// Height above the base as a share of the layer's thickness.
FN Real heightFraction(IN(Vec3) q, IN(LayerParams) c) { return saturate((q.z - c.base) / c.thickness); }

// The point that the wind has carried to q: tops lean downwind (004 ch. 4.3.4).
FN Vec3 unsheared(IN(Vec3) q, IN(LayerParams) c) {
  Real lean = c.shear * (q.z - c.base) / c.thickness;
  return Vec3(q.x - c.downwindX * lean, q.y - c.downwindY * lean, q.z);
}

// 1 while detail of tile size `tile` (m) is resolved by steps of `footprint` (m), 0 where only its mean remains.
FN Real detailShare(IN(Real) footprint, IN(float) near, IN(float) far) {
  return 1.0f - smoothstep(near, far, footprint);
}

// Smooth maximum of depths, in units of the profile.
FN Real smoothMax(IN(Real) a, IN(Real) b, IN(float) k) {
  Real h = max(k - abs(a - b), 0.0f) / k;
  return max(a, b) + h * h * k * 0.25f;
}

// Where in the weather the column of a point stands: overhangs come from a sideways warp that grows with height.
FN Vec2 profileColumn(IN(Vec3) q, IN(LayerParams) c, IN(Sampler3) warpNoise) {
  Vec4 drift = sample3(warpNoise, q * c.warping.w + xyz(c.warping));
  Real rise = saturate((q.z - c.base) * 0.0025f);
  return Vec2(q.x + c.warp * rise * (drift.x - 0.5f), q.y + c.warp * rise * (drift.y - 0.5f));
}

// The anvil of a cumulonimbus: ice that spreads below the tropopause, which is its flat top, and hangs lower toward the
// tower. Heights are shares of the layer's thickness; `anvil` is 0 at its rim and 1 over the tower, hb in m above the
// base.
const float kAnvilTop = 0.84f;
const float kFibreStretch = 12.0f;
const float kFibreDepth = 5.0f;
const float kFibreTile = 0.6f;  // of the base noise's

// Height of its top in m: the strongest ascent shoots a little beyond the tropopause.
FN Real anvilCeiling(IN(Real) anvil, IN(LayerParams) c) {
  return c.thickness * (kAnvilTop + 0.03f * smoothstep(0.75f, 1.0f, anvil));
}

// How far it reaches down from there, m.
FN Real anvilThickness(IN(Real) anvil, IN(LayerParams) c) {
  Real near = smoothstep(0.45f, 1.0f, anvil);
  return c.thickness * (0.1f * saturate(1.6f * anvil) + 0.16f * near * near);
}

// Fibres that the wind has drawn out, 0..1; they hardly change through its depth.
FN Real anvilFibre(IN(Vec3) q, IN(LayerParams) c, IN(Sampler3) baseNoise) {
  Real along = q.x * c.downwindX + q.y * c.downwindY;
  Real across = q.y * c.downwindX - q.x * c.downwindY;
  Vec3 drawn = Vec3(along / kFibreStretch, across, q.z / kFibreDepth);
  return sample3(baseNoise, drawn * c.fibres.w + xyz(c.fibres)).x;
}

// The anvil that evaporation has left between its fibres, at most `anvil`.
FN Real anvilLeft(IN(Real) anvil, IN(Real) fibre) {
  return anvil - 0.5f * (1.0f - fibre) * (1.0f - anvil);
}

// Depth inside it in m, negative outside.
FN Real anvilDepth(IN(Real) left, IN(Real) hb, IN(Real) fibre, IN(LayerParams) c) {
  Real below = anvilCeiling(left, c) - hb;
  Real torn = 0.035f * c.thickness * (1.0f - fibre) * saturate(3.0f * left);
  return select(left > 0.0f, min(2.5f * below, anvilThickness(left, c) - below) - torn, Real(-1000.0f));
}

// The answer at the unsheared point q whose column has weather w.
FN Vec3 profileExtinctionIn(IN(Vec4) w, IN(Vec3) q, IN(Real) footprint, IN(LayerParams) c, IN(Sampler3) baseNoise,
                            IN(Sampler3) detailNoise) {
  Real hb = q.z - c.base - w.y;
  Real amplitude = min(Real(c.lengthScale), c.lengthFraction * w.x + c.minLength);
  Real profile = min(min((w.x - hb) / amplitude, Real(1.0f)), (w.x - 20.0f) * 0.02f);
  Real ice = 0.0f;
  Real thin = 1.0f;
  Real n = sample3(baseNoise, q * c.noise.w + xyz(c.noise)).x;
  if (c.hasAnvil != 0) {
    // Towers end inside the anvil, so that no turret of water stands out of the ice.
    Real limit = (kAnvilTop - 0.12f) * c.thickness;
    Real tower = min(w.x, limit + 0.04f * max(w.x - limit, 0.0f));
    profile = min(min((tower - hb) / amplitude, Real(1.0f)), (tower - 20.0f) * 0.02f);
    Real fibre = anvilFibre(q, c, baseNoise);
    Real left = anvilLeft(w.z, fibre);
    thin = smoothstep(0.0f, 0.5f, left);
    Real sheet = anvilDepth(left, hb, fibre, c) / amplitude;
    ice = saturate(0.5f + 4.0f * (sheet - profile)) * smoothstep(0.45f, 0.65f, hb / c.thickness);
    profile = smoothMax(profile, sheet, 0.3f);
  }
  Real low = saturate(hb * 0.00333333f);
  Real eaten = c.erosion * (1.0f - ice) *
               (c.baseErosion + (1.0f - c.baseErosion) * smoothstep(0.0f, 260.0f, hb));
  Real depth = profile - eaten * (1.0f - n) - c.baseCut * (1.0f - low);
  Vec4 d = sample3(detailNoise, q * c.detailing.w + xyz(c.detailing));
  Real e = mix(1.0f - d.y, 1.0f - d.x, saturate(hb * 0.00285714f));
  e = mix(Real(0.45f), e, detailShare(footprint, 0.015f / c.detailing.w, 0.115f / c.detailing.w));
  Real carved = c.detail * e;
  if (c.fineDetail > 0.0f) {
    Real f = sample3(detailNoise, q * c.fine.w + xyz(c.fine)).x;
    carved += c.fineDetail * (0.5f - f) * detailShare(footprint, 0.08f / c.fine.w, 0.2f / c.fine.w);
  }
  Real outline = depth * amplitude;
  depth = outline - carved * (1.0f - 0.8f * ice);
  Real dense = saturate(depth * mix(Real(c.inverseRamp), Real(c.anvilRamp), ice)) *
               smoothstep(0.0f, c.baseFade, hb + 2.0f * c.baseRagged * (n - 0.5f));
  Real liquid = 1.0f - c.liquidGradient + c.liquidGradient * sqrt(saturate(hb / c.thickness));
  Real sigma = c.extinction * dense * liquid * mix(Real(1.0f), c.anvilDensity * thin, ice);
  Mask within = both(q.z > c.bottom, q.z < c.top);
  sigma = select(within, sigma, Real(0.0f));
  outline += max(0.5f * c.fineDetail, 0.0f);  // fine noise fills as much as it carves
  return Vec3(sigma, select(within, outline, Real(-1.0f)), sigma * w.w);
}

// The answer at a point of cloud space, weather looked up in clip levels.
FN Vec3 profileExtinction(IN(Vec3) point, IN(Real) footprint, IN(Real) dither, IN(LayerParams) c, IN(ClipParams) clip,
                          IN(Sampler2Array) weather, IN(Sampler2Array) weather2, IN(Sampler3) baseNoise,
                          IN(Sampler3) detailNoise, IN(Sampler3) warpNoise) {
  Vec3 q = unsheared(point, c);
  Vec3 place = weatherPlace(clip, profileColumn(q, c, warpNoise), dither);
  Vec2 column = xy(sample2Array(weather, xy(place), place.z));
  Vec2 extra = Vec2(0.0f);
  if (c.needsExtra != 0) extra = xy(sample2Array(weather2, xy(place), place.z));
  return profileExtinctionIn(Vec4(column.x, column.y, extra.x, extra.y), q, footprint, c, baseNoise, detailNoise);
}
