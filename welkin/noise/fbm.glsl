// Sums of octaves (000 eq. 2.21): octave i has lacunarity^i times the cells of the first and gain^i times its weight;
// the weights sum to 1. p counts the first octave's cells; whole lacunarities keep it seamless. Octave i has the seed
// plus i.

FN Real perlinFbm2At(IN(IVec2) cell, IN(Vec2) f, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain,
                     IN(uint) seed) {
  IVec2 c = cell;
  Vec2 g = f;
  int n = period;
  float weight = 1.0f;
  float total = 0.0f;
  Real sum = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * perlin2At(c, g, n, seed + uint(i));
    total += weight;
    weight *= gain;
    n *= lacunarity;
    refineCell2(c, g, lacunarity);
  }
  return sum / total;
}
FN Real perlinFbm2(IN(Vec2) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  Vec2 whole = floor(p);
  return perlinFbm2At(IVec2(toInt(whole.x), toInt(whole.y)), p - whole, period, octaves, lacunarity, gain, seed);
}

FN Real perlinFbm3At(IN(IVec3) cell, IN(Vec3) f, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain,
                     IN(uint) seed) {
  IVec3 c = cell;
  Vec3 g = f;
  int n = period;
  float weight = 1.0f;
  float total = 0.0f;
  Real sum = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * perlin3At(c, g, n, seed + uint(i));
    total += weight;
    weight *= gain;
    n *= lacunarity;
    refineCell3(c, g, lacunarity);
  }
  return sum / total;
}
FN Real perlinFbm3(IN(Vec3) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  Vec3 whole = floor(p);
  return perlinFbm3At(IVec3(toInt(whole.x), toInt(whole.y), toInt(whole.z)), p - whole, period, octaves, lacunarity,
                      gain, seed);
}

// Ridges max(0, 1 - slope |Perlin|): thin bright sheets where the noise changes its sign.
FN Real ridgeFbm3(IN(Vec3) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(float) slope,
                  IN(uint) seed) {
  Vec3 whole = floor(p);
  IVec3 c = IVec3(toInt(whole.x), toInt(whole.y), toInt(whole.z));
  Vec3 g = p - whole;
  int n = period;
  float weight = 1.0f;
  float total = 0.0f;
  Real sum = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * max(0.0f, 1.0f - slope * abs(perlin3At(c, g, n, seed + uint(i))));
    total += weight;
    weight *= gain;
    n *= lacunarity;
    refineCell3(c, g, lacunarity);
  }
  return sum / total;
}

// Inverted Euclidean Worley noise, 1 at feature points, and its billows.
FN Real worleyFbm3(IN(Vec3) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  int n = period;
  float scale = 1.0f;
  float weight = 1.0f;
  float total = 0.0f;
  Real sum = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * worleyInverted(worley3(p * scale, n, kWorleyEuclidean, seed + uint(i)).x);
    total += weight;
    weight *= gain;
    scale *= toReal(lacunarity);
    n *= lacunarity;
  }
  return sum / total;
}
FN Real billowFbm3(IN(Vec3) p, IN(int) period, IN(int) octaves, IN(int) lacunarity, IN(float) gain, IN(uint) seed) {
  int n = period;
  float scale = 1.0f;
  float weight = 1.0f;
  float total = 0.0f;
  Real sum = 0.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * billow(worley3(p * scale, n, kWorleyEuclidean, seed + uint(i)).x);
    total += weight;
    weight *= gain;
    scale *= toReal(lacunarity);
    n *= lacunarity;
  }
  return sum / total;
}
