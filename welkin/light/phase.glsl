// Phase functions, in 1/sr, normalised to 1 over the sphere. cosTheta = dot(direction before, direction after): +1 is
// straight on, g > 0 forward.

const float kInv4Pi = 0.0795774715f;

// Isotropic scattering (000 eq. 2.11).
FN float phaseIsotropic() { return kInv4Pi; }

// Rayleigh scattering by molecules (000 eq. 2.12).
FN Real phaseRayleigh(IN(Real) cosTheta) { return kInv4Pi * 0.75f * (1.0f + cosTheta * cosTheta); }

// Henyey and Greenstein 1941 (000 eq. 2.13); g in (-1, 1) is the mean cosine.
FN Real phaseHenyeyGreenstein(IN(Real) cosTheta, IN(Real) g) {
  Real d = max(1.0f + g * g - 2.0f * g * cosTheta, 1e-7f);
  return kInv4Pi * (1.0f - g * g) / (d * sqrt(d));
}
