// How light dies along a path of optical depth tau, and what a homogeneous step adds.

// Beer and Lambert (000 eq. 2.5).
FN Real beerLambert(IN(Real) tau) { return exp(-tau); }

// Light that has not yet been scattered into the ray near a cloud's edge (004 ch. 4.4.4).
FN Real powder(IN(Real) tau) { return 1.0f - exp(-2.0f * tau); }

// Beer's law with dark edges (004 ch. 4.4.4).
FN Real beerPowder(IN(Real) tau) { return 2.0f * beerLambert(tau) * powder(tau); }

// Integral of exp(-extinction t) over a step of length d: (1 - exp(-extinction d)) / extinction (Hillaire 2016), by its
// series where the step is thin, so that it tends to d.
FN Real stepIntegral(IN(Real) extinction, IN(Real) d) {
  Real tau = extinction * d;
  Real series = 1.0f - tau * (0.5f - tau * (0.166666667f - tau * 0.0416666667f));
  return d * select(tau < 0.03f, series, (1.0f - exp(-tau)) / max(tau, 1e-6f));
}
FN Vec3 stepIntegral(IN(Vec3) extinction, IN(Real) d) {
  return Vec3(stepIntegral(extinction.x, d), stepIntegral(extinction.y, d), stepIntegral(extinction.z, d));
}
