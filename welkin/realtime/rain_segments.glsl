// Rain and snow along a ray, in segments. A coarse picture of the view holds them (shaders/rain_segments.frag.glsl): each
// has more samples than the rays of the march could take, and none of its own, which would be grain. The reader supplies
//   Vec2 skyRain(Vec3 q, Sky)
// (extinction in 1/m of what falls, the share of that which is snow);
//   const int kLightVolume, Real skySunDepth(Vec3 q, Sky), Vec2 skyBelowAir(Vec2 p, Sky)
// as for ray.glsl; rain_picture.glsl and drops.glsl come before.

// Of a whole segment: optical depth (w), and that times how much of the sunlight it sends back along the ray in 1/sr (x)
// and how much of the sun's (y) and the sky's light (z) reaches it from all sides through clouds. Points above the
// rain count as at its top, for the segments' neighbours.
FN Vec4 rainSegment(int k, IN(Vec3) dir, IN(MarchParams) m, IN(Sky) sky) {
  Real cosTheta = dot(dir, Vec3(m.sun.x, m.sun.y, m.sun.z));
  Vec4 sum = Vec4(0.0f);
  for (int i = 0; i < kRainSamples; ++i) {
    float at = (float(k) + (float(i) + 0.5f) / float(kRainSamples)) / float(kRainSegments);
    float t = kRainReach * at * at;
    float stride = 2.0f * kRainReach * at / float(kRainSegments * kRainSamples);
    Vec3 q = cloudSpace(dir * t, m.planet);
    q.z = min(q.z, Real(m.rain.x));
    Vec2 found = skyRain(q, sky);
    Real depth = found.x * (stride * (1.0f - m.rain.y * (1.0f - smoothstep(kRainFade * m.rain.z, m.rain.z, t))));
    Real share = Real(m.rain.w);
    Vec2 below = Vec2(0.0f);
    if (kLightVolume != 0) {
      share = exp(-kReduced * skySunDepth(q, sky));
      below = skyBelowAir(Vec2(q.x, q.y), sky);
    }
    Real phase = phaseHenyeyGreenstein(cosTheta, mix(Real(kRainAsymmetry), Real(kSnowAsymmetry), found.y));
    sum = sum + Vec4(phase * share, below.x, below.y, Real(1.0f)) * depth;
  }
  return sum;
}
