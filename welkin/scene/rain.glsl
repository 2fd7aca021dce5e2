// Where it rains or snows: rate below one layer of clouds, from its weather. A point of cloud space is (x, y relative to
// the anchor, altitude), in m.

// std140; see rainParams in rain.hpp.
struct RainParams {
  float rate;                     // mm/h where the weather's precipitation is 1; 0: none
  float lost;                     // root of the rate of which nothing reaches the ground, (mm/h)^(1/2)
  float top, inverseTop;          // base of the clouds, m
  float freezing;                 // altitude of 0 degrees C, m
  float behindRain, behindSnow;   // how far the rain stays behind the cloud for each m of shortfall()
  float streaks;                  // whole number of times by which the base noise is shrunk
};

const float kRainOverlap = 120.0f;  // m, how far into the cloud rain is followed

// How far what falls at this altitude has stayed behind the cloud that sent it, m.
FN Real rainBehind(IN(Real) altitude, IN(RainParams) r) {
  float melting = clamp(r.freezing, 0.0f, r.top);
  Real z = clamp(altitude, 0.0f, r.top);
  Real low = min(z, melting);
  Real high = max(z, melting);
  Real asRain = shortfall(Real(melting), r.inverseTop) - shortfall(low, r.inverseTop);
  Real asSnow = shortfall(Real(r.top), r.inverseTop) - shortfall(high, r.inverseTop);
  return asRain * r.behindRain + asSnow * r.behindSnow;
}

// Rate at a point, mm/h. Shallow parts of clouds of shape "profile" do not rain. Weather as for profileExtinction.
FN Real rainRate(IN(Vec3) point, IN(Real) dither, IN(LayerParams) c, IN(ClipParams) clip, IN(RainParams) r,
                 IN(Sampler2Array) weather, IN(Sampler2Array) weather2, IN(Sampler3) baseNoise) {
  Real behind = rainBehind(point.z, r);
  Vec2 source = Vec2(point.x + c.downwindX * behind, point.y + c.downwindY * behind);
  Vec3 place = weatherPlace(clip, source, dither);
  Vec2 column = xy(sample2Array(weather, xy(place), place.z));
  Vec2 extra = xy(sample2Array(weather2, xy(place), place.z));
  Real share = extra.y * smoothstep(0.2f, 0.5f, column.x / c.thickness);
  Real shift = column.y;
  if (c.shape != 0) {
    share = extra.x;
    shift = extra.y;
  }
  Real above = point.z - r.top - shift;
  share = share * (1.0f - smoothstep(0.0f, kRainOverlap, above));
  // Streaks: the cloud does not rain evenly, and what falls keeps its place among the rest.
  Real n = sample3(baseNoise, Vec3((source.x * c.noise.w + c.noise.x) * r.streaks,
                                   (source.y * c.noise.w + c.noise.y) * r.streaks, 0.37f)).x;
  share = share * (0.25f + 0.75f * smoothstep(0.25f, 0.75f, n));
  return leftOf(r.rate * share, 1.0f - point.z * r.inverseTop, r.lost);
}
