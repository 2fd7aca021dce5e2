// Linear map of [oldMin, oldMax] to [newMin, newMax] (000 eq. 2.27).
FN Real remap(IN(Real) v, IN(Real) oldMin, IN(Real) oldMax, IN(Real) newMin, IN(Real) newMax) {
  return newMin + (v - oldMin) / (oldMax - oldMin) * (newMax - newMin);
}
