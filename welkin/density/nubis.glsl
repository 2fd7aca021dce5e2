// Shape "nubis": Schneider's model, each step a named function (004 ch. 4.3; 000 eq. 2.27-2.30, 4.7).

// Height profiles of the three cloud types (000 eq. 4.7), h = height fraction. The printed products rise again where
// both factors are negative, so each factor is held to [0, 1], as the curves of fig. 4.9 are drawn.
FN Real stratusGradient(IN(Real) h) {
  return saturate(remap(h, 0.01f, 0.05f, 0.0f, 1.0f)) * saturate(remap(h, 0.0f, 0.2f, 1.0f, 0.0f));
}
FN Real stratocumulusGradient(IN(Real) h) {
  return saturate(remap(h, 0.01f, 0.25f, 0.0f, 1.0f)) * saturate(remap(h, 0.3f, 0.65f, 1.0f, 0.0f));
}
FN Real cumulusGradient(IN(Real) h) {
  return saturate(remap(h, 0.01f, 0.3f, 0.0f, 1.0f)) * saturate(remap(h, 0.6f, 0.95f, 1.0f, 0.0f));
}

// Their blend: type 0 stratus, 0.5 stratocumulus, 1 cumulus (004 ch. 4.3.2).
FN Real densityHeightGradient(IN(Real) h, IN(Real) type) {
  Real low = saturate(1.0f - 2.0f * type);
  Real high = saturate(2.0f * type - 1.0f);
  return stratusGradient(h) * low + stratocumulusGradient(h) * (1.0f - low - high) + cumulusGradient(h) * high;
}

// Eq. 2.28: Perlin-Worley lifted by the Worley fBm; `shape` = (Perlin-Worley, Worley fBm).
FN Real baseCloud(IN(Vec2) shape) { return remap(shape.x, shape.y - 1.0f, 1.0f, 0.0f, 1.0f); }

// Eq. 2.29 with its slip mended: more coverage, more cloud.
FN Real applyCoverage(IN(Real) base, IN(Real) coverage) {
  return saturate(remap(base, 1.0f - coverage, 1.0f, 0.0f, 1.0f)) * coverage;
}

// Eq. 2.30: wisps at the base, billows above.
FN Real detailModifier(IN(Real) detail, IN(Real) h, IN(int) transition) {
  Real t = h;
  if (transition == 0) t = saturate(10.0f * h);
  return mix(detail, 1.0f - detail, t);
}
FN Real erode(IN(Real) base, IN(Real) modifier, IN(float) amount) {
  return saturate(remap(base, amount * modifier, 1.0f, 0.0f, 1.0f));
}

// As profileExtinctionIn; `full` false leaves the detail out (the cheap sample of 004 ch. 4.5.2). Its second number is
// the cheap density in place of a depth, zero where no full sample can be in cloud.
FN Vec3 nubisExtinctionIn(IN(Vec4) w, IN(Vec3) q, IN(Mask) full, IN(LayerParams) c, IN(Sampler3) baseNoise,
                          IN(Sampler3) detailNoise, IN(Sampler2) curlNoise) {
  Real h = (q.z - c.base - w.w) / c.thickness;
  Mask within = both(h > 0.0f, h < 1.0f);
  h = saturate(h);
  Vec4 shape = sample3(baseNoise, q * c.noise.w + xyz(c.noise));
  Real base = baseCloud(Vec2(shape.x, shape.y)) * densityHeightGradient(h, w.y);
  base = select(within, applyCoverage(base, w.x), Real(0.0f));
  Vec4 curl = sample2(curlNoise, Vec2(q.x * c.curl.w + c.curl.x, q.y * c.curl.w + c.curl.y));
  Real swirl = c.curlAmplitude * (1.0f - h);
  Vec3 moved = Vec3(q.x + swirl * curl.x, q.y + swirl * curl.y, q.z);
  Real detail = sample3(detailNoise, moved * c.detailing.w + xyz(c.detailing)).x;
  Real eroded = erode(base, detailModifier(detail, h, c.transition), c.detailErosion);
  Real density = select(full, eroded, base);
  return Vec3(c.extinction * density, base, c.extinction * density * w.z);
}

// As profileExtinction.
FN Vec3 nubisExtinction(IN(Vec3) point, IN(Mask) full, IN(Real) dither, IN(LayerParams) c, IN(ClipParams) clip,
                        IN(Sampler2Array) weather, IN(Sampler2Array) weather2, IN(Sampler3) baseNoise,
                        IN(Sampler3) detailNoise, IN(Sampler2) curlNoise) {
  Vec3 q = unsheared(point, c);
  Vec3 place = weatherPlace(clip, Vec2(q.x, q.y), dither);
  Vec2 w = xy(sample2Array(weather, xy(place), place.z));
  Vec2 extra = xy(sample2Array(weather2, xy(place), place.z));
  return nubisExtinctionIn(Vec4(w.x, w.y, extra.x, extra.y), q, full, c, baseNoise, detailNoise, curlNoise);
}
