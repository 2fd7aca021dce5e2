// Curl noise (R. Bridson, J. Hourihan, M. Nordenstam 2007; 000 ch. 2.3.2): flow without divergence, the curl of Perlin
// fBm from its analytic derivatives. In units of potential per cell of the first octave; seamless as perlinFbm.

// (d psi/dy, -d psi/dx) of a scalar potential psi.
FN Vec2 curlFbm2(IN(Vec2) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  Vec2 whole = floor(p);
  IVec2 c = IVec2(toInt(whole.x), toInt(whole.y));
  Vec2 f = p - whole;
  int n = period;
  float weight = 1.0f;
  float total = 0.0f;
  float scale = 1.0f;
  Vec2 sum = Vec2(0.0f);
  for (int i = 0; i < octaves; ++i) {
    Vec3 slope = perlin2SlopeAt(c, f, n, seed + uint(i));
    sum += Vec2(slope.y, -slope.x) * (weight * scale);
    total += weight;
    weight *= gain;
    scale *= toReal(lacunarity);
    n *= lacunarity;
    refineCell2(c, f, lacunarity);
  }
  return sum / total;
}

// The curl of a vector potential of three independent noises (000 eq. 2.23).
FN Vec3 curlFbm3(IN(Vec3) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  Vec3 whole = floor(p);
  IVec3 c = IVec3(toInt(whole.x), toInt(whole.y), toInt(whole.z));
  Vec3 f = p - whole;
  int n = period;
  float weight = 1.0f;
  float total = 0.0f;
  float scale = 1.0f;
  Vec3 sum = Vec3(0.0f);
  for (int i = 0; i < octaves; ++i) {
    Vec4 a = perlin3SlopeAt(c, f, n, seed + 3u * uint(i));
    Vec4 b = perlin3SlopeAt(c, f, n, seed + 3u * uint(i) + 1u);
    Vec4 d = perlin3SlopeAt(c, f, n, seed + 3u * uint(i) + 2u);
    sum += Vec3(d.y - b.z, a.z - d.x, b.x - a.y) * (weight * scale);
    total += weight;
    weight *= gain;
    scale *= toReal(lacunarity);
    n *= lacunarity;
    refineCell3(c, f, lacunarity);
  }
  return sum / total;
}
