// The texels of the noise textures, at a point of their tile in [0, 1)^3. Parameters are std140-clean and come from
// noise/params.hpp.

const uint kWorleySeed = 0x632BE5ABu;
const uint kOtherSeed = 0x2545F491u;

struct BaseShapeParams {
  int perlinCells, perlinOctaves; float perlinGain; int worleyCells;
  float lowWeight, midWeight, highWeight, topWeight;
  int combination; float inverseGamma; uint seed; int padding;
};

struct DetailParams {
  int worleyCells; float lowWeight, midWeight, highWeight;
  float topWeight, inverseGamma; uint seed; int padding;
};

struct CurlParams {
  int cells, octaves; float gain, amplitude;
  uint seed; int paddingA, paddingB, paddingC;
};

// low and scale stretch a raw channel: saturate((raw - low) scale).
struct ProfileBaseParams {
  int perlinCells, perlinOctaves; float perlinGain; int billowCells;
  int billowOctaves; float billowGain; uint seed; float billowMix;
  float lowR, scaleR, lowG, scaleG;
};

struct ProfileDetailParams {
  int cells, octaves; float gain, ridgeSlope;
  uint seed; int paddingA, paddingB, paddingC;
  float lowR, scaleR, lowG, scaleG;
};

struct ProfileWarpParams {
  int cells, octaves; float gain; uint seed;
  float lowR, scaleR, lowG, scaleG;
};

// Four inverted Worley noises of doubling frequency as three channels: fBm from the first, from the second, and the
// last two (000 ch. 4.3.1).
FN Vec3 worleyChannels(IN(Vec4) n, IN(float) low, IN(float) mid, IN(float) high, IN(float) top) {
  return Vec3(low * n.x + mid * n.y + high * n.z, low * n.y + mid * n.z + high * n.w, top * n.z + (1.0f - top) * n.w);
}
FN Vec4 worleyLattices(IN(Vec3) uvw, IN(int) cells, IN(uint) seed) {
  Vec3 p = uvw * toReal(cells);
  return Vec4(worleyInverted(worley3(p, cells, kWorleyEuclidean, seed).x),
              worleyInverted(worley3(p * 2.0f, cells * 2, kWorleyEuclidean, seed + 1u).x),
              worleyInverted(worley3(p * 4.0f, cells * 4, kWorleyEuclidean, seed + 2u).x),
              worleyInverted(worley3(p * 8.0f, cells * 8, kWorleyEuclidean, seed + 3u).x));
}

// Base shape: Perlin-Worley in red, Worley fBm of rising frequency in green, blue and alpha. The composing half takes
// the noises themselves.
FN Vec4 baseShapeOf(IN(Real) perlinFbm, IN(Vec4) lattices, IN(BaseShapeParams) p) {
  Vec3 worley = worleyChannels(lattices, p.lowWeight, p.midWeight, p.highWeight, p.topWeight);
  Real r = perlinWorley(saturate(0.5f + 0.5f * perlinFbm), worley.x, p.combination);
  return Vec4(gammaCorrected(r, p.inverseGamma), gammaCorrected(worley.x, p.inverseGamma),
              gammaCorrected(worley.y, p.inverseGamma), gammaCorrected(worley.z, p.inverseGamma));
}
FN Vec4 baseShapeTexel(IN(Vec3) uvw, IN(BaseShapeParams) p) {
  Real perlin = perlinFbm3(uvw * toReal(p.perlinCells), p.perlinCells, p.perlinOctaves, 2, p.perlinGain, p.seed);
  return baseShapeOf(perlin, worleyLattices(uvw, p.worleyCells, p.seed + kWorleySeed), p);
}
// What the shape "nubis" samples: Perlin-Worley and L_FBM (000 eq. 2.28).
FN Vec2 baseShapePacked(IN(Vec4) base) { return Vec2(base.x, 0.625f * base.y + 0.25f * base.z + 0.125f * base.w); }

// Detail: Worley fBm of rising frequency in red, green and blue.
FN Vec3 detailOf(IN(Vec4) lattices, IN(DetailParams) p) {
  Vec3 worley = worleyChannels(lattices, p.lowWeight, p.midWeight, p.highWeight, p.topWeight);
  return Vec3(gammaCorrected(worley.x, p.inverseGamma), gammaCorrected(worley.y, p.inverseGamma),
              gammaCorrected(worley.z, p.inverseGamma));
}
FN Vec3 detailTexel(IN(Vec3) uvw, IN(DetailParams) p) {
  return detailOf(worleyLattices(uvw, p.worleyCells, p.seed + kWorleySeed), p);
}
FN Real detailPacked(IN(Vec3) detail) { return 0.625f * detail.x + 0.25f * detail.y + 0.125f * detail.z; }

// Curl: a flow in the plane, about +-amplitude.
FN Vec2 curlTexel(IN(Vec2) uv, IN(CurlParams) p) {
  return curlFbm2(uv * toReal(p.cells), p.cells, p.octaves, 2, p.gain, p.seed) * p.amplitude;
}

// Shape "profile": Perlin fBm lifted on the billow floor in red, billows in green.
FN Vec2 profileBaseRawOf(IN(Real) perlinFbm, IN(Real) billows) {
  return Vec2(perlinWorley(saturate(0.5f + 0.5f * perlinFbm), billows, kPerlinWorleyLift), billows);
}
FN Vec2 profileBaseRaw(IN(Vec3) uvw, IN(ProfileBaseParams) p) {
  Real perlin = perlinFbm3(uvw * toReal(p.perlinCells), p.perlinCells, p.perlinOctaves, 2, p.perlinGain, p.seed);
  Real billows = billowFbm3(uvw * toReal(p.billowCells), p.billowCells, p.billowOctaves, 2, p.billowGain,
                            p.seed + kWorleySeed);
  return profileBaseRawOf(perlin, billows);
}
FN Vec2 profileBaseStretched(IN(Vec2) raw, IN(ProfileBaseParams) p) {
  return Vec2(saturate((raw.x - p.lowR) * p.scaleR), saturate((raw.y - p.lowG) * p.scaleG));
}
FN Vec2 profileBaseTexel(IN(Vec3) uvw, IN(ProfileBaseParams) p) {
  return profileBaseStretched(profileBaseRaw(uvw, p), p);
}
FN Real profileBasePacked(IN(Vec2) base, IN(ProfileBaseParams) p) {
  return base.x * (1.0f - p.billowMix) + base.y * p.billowMix;
}

// Its detail: billows in red, ridges in green.
FN Vec2 profileDetailRaw(IN(Vec3) uvw, IN(ProfileDetailParams) p) {
  Vec3 q = uvw * toReal(p.cells);
  return Vec2(billowFbm3(q, p.cells, p.octaves, 2, p.gain, p.seed + kWorleySeed),
              ridgeFbm3(q, p.cells, p.octaves, 2, p.gain, p.ridgeSlope, p.seed));
}
FN Vec2 profileDetailStretched(IN(Vec2) raw, IN(ProfileDetailParams) p) {
  return Vec2(saturate((raw.x - p.lowR) * p.scaleR), saturate((raw.y - p.lowG) * p.scaleG));
}
FN Vec2 profileDetailTexel(IN(Vec3) uvw, IN(ProfileDetailParams) p) {
  return profileDetailStretched(profileDetailRaw(uvw, p), p);
}

// Its warp: two independent smooth fields, centred on 1/2.
FN Vec2 profileWarpRaw(IN(Vec3) uvw, IN(ProfileWarpParams) p) {
  Vec3 q = uvw * toReal(p.cells);
  return Vec2(perlinFbm3(q, p.cells, p.octaves, 2, p.gain, p.seed),
              perlinFbm3(q, p.cells, p.octaves, 2, p.gain, p.seed + kOtherSeed));
}
FN Vec2 profileWarpTexel(IN(Vec3) uvw, IN(ProfileWarpParams) p) {
  Vec2 raw = profileWarpRaw(uvw, p);
  return Vec2(saturate((raw.x - p.lowR) * p.scaleR), saturate((raw.y - p.lowG) * p.scaleG));
}
