// Perlin-Worley noise: Perlin fBm P and inverted Worley fBm W, both in [0, 1], as one value in [0, 1] (000 fig. 4.8).

const int kPerlinWorleySquare = 0;
const int kPerlinWorleyLift = 1;
const int kPerlinWorleyCarve = 2;
const int kPerlinWorleyDilate = 3;
const int kPerlinWorleyErode = 4;
const int kPerlinWorleyProduct = 5;

FN Real perlinWorley(IN(Real) perlin, IN(Real) worley, IN(int) combination) {
  Real lifted = remap(perlin, 0.0f, 1.0f, worley, 1.0f);
  if (combination == kPerlinWorleySquare) return saturate(lifted * lifted);
  if (combination == kPerlinWorleyLift) return saturate(lifted);
  if (combination == kPerlinWorleyCarve) return saturate(remap(perlin, min(worley, 0.999f), 1.0f, 0.0f, 1.0f));
  if (combination == kPerlinWorleyDilate) return saturate(remap(perlin, worley - 1.0f, 1.0f, 0.0f, 1.0f));
  if (combination == kPerlinWorleyErode) return saturate(remap(perlin, min(1.0f - worley, 0.999f), 1.0f, 0.0f, 1.0f));
  return saturate(remap(worley, 0.0f, 1.0f, 0.0f, perlin));
}
