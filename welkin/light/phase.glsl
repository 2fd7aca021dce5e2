// Phase functions, in 1/sr, normalised to 1 over the sphere. cosTheta = dot(direction before, direction after): +1 is
// straight on, g > 0 forward.

const float kInv4Pi = 0.0795774715f;

// Isotropic scattering (000 eq. 2.11).
FN float phaseIsotropic() { return kInv4Pi; }

// Rayleigh scattering by molecules (000 eq. 2.12).
FN Real phaseRayleigh(IN(Real) cosTheta) { return kInv4Pi * 0.75f * (1.0f + cosTheta * cosTheta); }

// Henyey and Greenstein 1941 (000 eq. 2.13); g in (-1, 1) is the mean cosine. The squared distance is summed from two
// terms that are small together, so that the peak keeps its height for g near 1. `versine` is 1 - cosTheta: a sampler
// that knows it directly keeps the digits that cosTheta loses near straight on.
FN Real phaseHenyeyGreensteinOfVersine(IN(Real) versine, IN(Real) g) {
  Real d = max((1.0f - g) * (1.0f - g) + 2.0f * g * versine, 1e-12f);
  return kInv4Pi * (1.0f - g * g) / (d * sqrt(d));
}
FN Real phaseHenyeyGreenstein(IN(Real) cosTheta, IN(Real) g) {
  return phaseHenyeyGreensteinOfVersine(1.0f - cosTheta, g);
}

// Two lobes of Henyey and Greenstein; `weight1` is the share of the second.
FN Real phaseDualHenyeyGreenstein(IN(Real) cosTheta, IN(Real) g0, IN(Real) g1, IN(Real) weight1) {
  return (1.0f - weight1) * phaseHenyeyGreenstein(cosTheta, g0) + weight1 * phaseHenyeyGreenstein(cosTheta, g1);
}

// Schlick's k for the asymmetry g of Henyey and Greenstein (000 eq. 2.16).
FN Real schlickFromAsymmetry(IN(Real) g) { return 1.55f * g - 0.55f * g * g * g; }

// Schlick's ellipse in place of Henyey and Greenstein (000 eq. 2.15, with the sign of our cosTheta).
FN Real phaseSchlick(IN(Real) cosTheta, IN(Real) k) {
  Real d = max((1.0f - k) + k * (1.0f - cosTheta), 1e-6f);
  return kInv4Pi * (1.0f - k * k) / (d * d);
}

// Draine 2003: Henyey and Greenstein for alpha 0, Rayleigh for g 0 and alpha 1.
FN Real phaseDraine(IN(Real) cosTheta, IN(Real) g, IN(Real) alpha) {
  return phaseHenyeyGreenstein(cosTheta, g) * (1.0f + alpha * cosTheta * cosTheta) /
         (1.0f + alpha * (1.0f + 2.0f * g * g) * 0.333333333f);
}

// Cornette and Shanks 1992: Draine for alpha 1.
FN Real phaseCornetteShanks(IN(Real) cosTheta, IN(Real) g) { return phaseDraine(cosTheta, g, 1.0f); }

// The fit to Mie scattering by fog and cloud droplets of Jendersie and d'Eon 2023; computeMiePhase fills it.
struct MiePhase {
  float gHG, gDraine, alpha, wDraine;
};
FN Real phaseMie(IN(Real) cosTheta, IN(MiePhase) mie) {
  return (1.0f - mie.wDraine) * phaseHenyeyGreenstein(cosTheta, mie.gHG) +
         mie.wDraine * phaseDraine(cosTheta, mie.gDraine, mie.alpha);
}
FN Real phaseMieOfVersine(IN(Real) versine, IN(MiePhase) mie) {
  return (1.0f - mie.wDraine) * phaseHenyeyGreensteinOfVersine(versine, mie.gHG) +
         mie.wDraine * phaseDraine(1.0f - versine, mie.gDraine, mie.alpha);
}
