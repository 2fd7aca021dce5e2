// Perlin-Worley noise: Perlin fBm P and inverted Worley fBm W, both in [0, 1], as one value in [0, 1] (000 fig. 4.8).

const int kPerlinWorleySquare = 0;
const int kPerlinWorleyLift = 1;
const int kPerlinWorleyCarve = 2;
const int kPerlinWorleyDilate = 3;
const int kPerlinWorleyErode = 4;
const int kPerlinWorleyProduct = 5;

// Each is remap (000 eq. 2.27) of P or W with one bound given by the other.
FN Real perlinWorley(IN(Real) perlin, IN(Real) worley, IN(int) combination) {
  Real lifted = worley + perlin * (1.0f - worley);                                              // remap(P, 0, 1, W, 1)
  if (combination == kPerlinWorleySquare) return saturate(lifted * lifted);
  if (combination == kPerlinWorleyLift) return saturate(lifted);
  if (combination == kPerlinWorleyCarve)                                                        // remap(P, W, 1, 0, 1)
    return saturate((perlin - worley) / max(1.0f - worley, 0.001f));
  if (combination == kPerlinWorleyDilate)                                                   // remap(P, W - 1, 1, 0, 1)
    return saturate((perlin + 1.0f - worley) / (2.0f - worley));
  if (combination == kPerlinWorleyErode)                                                    // remap(P, 1 - W, 1, 0, 1)
    return saturate((perlin - 1.0f + worley) / max(worley, 0.001f));
  return saturate(perlin * worley);                                                             // remap(W, 0, 1, 0, P)
}
