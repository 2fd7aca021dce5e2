// Light that a thin plane layer of matter scatters, when a parallel beam falls on it and nothing is absorbed.

// (exp(-a) - exp(-b)) / (b - a), also where the two are alike.
FN Real slabBetween(IN(Real) a, IN(Real) b) { return exp(-min(a, b)) * stepIntegral(abs(a - b), 1.0f); }

// Phase function of light that has been scattered toward the eye once and `more` times on the mean within its forward peak.
// Henyey-Greenstein functions convolve to one whose mean cosine is the product of theirs.
FN Real slabPhase(IN(Real) phase, IN(Real) cosTheta, IN(float) g, IN(Real) more) {
  Real weight = exp(-more);
  Real rest = 1.0f - weight;
  Real sum = weight * phase;
  float broad = g;
  for (int i = 1; i < 4; ++i) {
    broad *= g;
    weight = weight * more / float(i);
    rest -= weight;
    sum += weight * phaseHenyeyGreenstein(cosTheta, Real(broad));
  }
  return sum + rest * phaseHenyeyGreenstein(cosTheta, Real(broad * g));
}

// Radiance for each unit of the beam's irradiance. `tau`: vertical optical depth; `beam`, `view`: sines of the height of
// the light and of the eye's ray over the layer, both above 0; `beyond`: whether the eye is on the other side than the
// light; `phase`: phase function between the two in 1/sr, of mean cosine g, and `cosTheta` its cosine.
// Scattered once, under the depth that is left without the forward peak (Nakajima and Tanaka 1988), which broadens what
// it lets pass, and of which a grazing beam, which it turns into steeper ways, goes with less; scattered more often by the
// Eddington solution of what is left (Joseph et al. 1976), in the middle. The constants are fitted to photons of g .78 and
// .86, depths of .05 to 10 and beams of .07 to .8: root mean square of the logarithm .17, the mean for a beam and a depth
// .87 to 1.13 (tests/light/slab_test.cpp).
FN Real slabRadiance(IN(Real) phase, IN(Real) cosTheta, IN(float) g, IN(Real) tau, IN(Real) beam, IN(Real) view,
                     IN(Mask) beyond) {
  float peak = g * g;
  float left = g / (1.0f + g);
  Real depth = (1.0f - peak) * tau;
  Real a = depth / view;
  Real straight = 0.95f * peak * exp(0.11f * log(beam));
  Real b = (1.0f - straight) * tau / beam;
  Real once = a * select(beyond, slabBetween(a, b), stepIntegral(a + b, 1.0f));
  Real broad = 0.66f * peak * tau / view + straight * tau / (beam * (1.0f + 24.0f * b));
  broad = select(beyond, broad, min(broad, 1.0f));
  Real dim = exp(-b);
  Real drive = 0.238732415f * beam;  // 3 / (4 pi)
  Real flow = drive * (beam * (1.0f - dim) + 0.666666667f * (1.0f + dim)) / (1.33333333f + (1.0f - left) * depth);
  Real middle = exp(-0.5f * b);
  Real along = flow - drive * middle;
  Real mean = drive * (beam * (1.0f - middle) + 0.666666667f) - flow * (0.666666667f + 0.5f * (1.0f - left) * depth);
  Real often = 0.6f * max(mean + left * along * select(beyond, view, -view), 0.0f) * (1.0f - exp(-a));
  return slabPhase(phase, cosTheta, g, broad) / (1.0f - peak) * once + often;
}

// How much of the light without direction that enters one side of such a layer leaves through the other.
FN Real slabDiffuse(IN(float) g, IN(Real) tau) { return 1.0f / (1.0f + 0.75f * (1.0f - g) * tau); }
