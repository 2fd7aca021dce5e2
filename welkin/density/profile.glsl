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
  float curlAmplitude, detailTileRatio, spare0, spare1;
  int shape, transition, hasAnvil, needsExtra;
};

// What a layer answers at a point: (extinction in 1/m, profile: <= 0 where no cloud can be, extinction times
// precipitation).
FN Vec3 noCloud() { return Vec3(0.0f, -1.0f, 0.0f); }

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

// The answer at the unsheared point q whose column has weather w.
FN Vec3 profileExtinctionIn(IN(Vec4) w, IN(Vec3) q, IN(Real) footprint, IN(LayerParams) c, IN(Sampler3) baseNoise,
                            IN(Sampler3) detailNoise) {
  Real hb = q.z - c.base - w.y;
  Real amplitude = min(Real(c.lengthScale), c.lengthFraction * w.x + c.minLength);
  Real profile = min(min((w.x - hb) / amplitude, Real(1.0f)), (w.x - 20.0f) * 0.02f);
  Real ice = 0.0f;
  Real n = sample3(baseNoise, q * c.noise.w + xyz(c.noise)).x;
  if (c.hasAnvil != 0) {
    Real flare = smoothstep(0.35f, 1.0f, w.z);
    Real above = hb - 0.76f * c.thickness;
    Real half_ = c.thickness * 0.085f * (0.15f + 0.85f * w.z);
    Real inside = min(half_ - above, half_ + above + 0.34f * c.thickness * flare);
    Real sheet = select(w.z > 0.0f, min(inside / (0.6f * amplitude), saturate(4.0f * w.z)), Real(-1.0f));
    ice = smoothstep(0.0f, 0.35f, sheet) * smoothstep(0.55f, 0.8f, hb / c.thickness);
    profile = smoothMax(profile, sheet, 0.3f);
  }
  Real low = saturate(hb * 0.00333333f);
  Real eaten = c.erosion * mix(Real(1.0f), Real(0.6f), ice) *
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
  depth = depth * amplitude - carved;
  Real dense = saturate(depth * mix(Real(c.inverseRamp), Real(c.anvilRamp), ice)) *
               smoothstep(0.0f, c.baseFade, hb + 2.0f * c.baseRagged * (n - 0.5f));
  Real liquid = 1.0f - c.liquidGradient + c.liquidGradient * sqrt(saturate(hb / c.thickness));
  Real sigma = c.extinction * dense * liquid * mix(Real(1.0f), Real(c.anvilDensity), ice);
  Mask within = both(q.z > c.bottom, q.z < c.top);
  sigma = select(within, sigma, Real(0.0f));
  return Vec3(sigma, select(within, profile, Real(-1.0f)), sigma * w.w);
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
