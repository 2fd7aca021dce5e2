// 000 eq. 4.6 with inverseGamma = 1 / gamma; c >= 0.
FN Real gammaCorrected(IN(Real) c, IN(float) inverseGamma) {
  if (inverseGamma == 1.0f) return c;
  return pow(c, inverseGamma);
}
