// Sky models in closed form: Preetham, Shirley and Smits 1999 and a gradient. Radiance in kcd/m^2.

// CIE xyY to XYZ (000 eq. 4.3).
FN Vec3 xyzFromXyY(IN(Vec3) xyY) {
  Real scale = xyY.z / max(xyY.y, 1e-6f);
  return Vec3(xyY.x * scale, xyY.z, (1.0f - xyY.x - xyY.y) * scale);
}

// XYZ to linear Rec.709 with its D65 white (000 eq. 4.4, whose -0.9392660 should read -0.9692660: the row then gives
// 1 for white).
FN Vec3 rec709FromXyz(IN(Vec3) c) {
  return Vec3(3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z,
              -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
              0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z);
}

// Filled by makePreethamParams. x, y, z of each belong to luminance Y and chromaticities x and y.
struct PreethamParams {
  vec4 a, b, c, d, e;  // distribution (000 eq. 2.42-2.44)
  vec4 zenith;         // value at the zenith over F(0, sun's zenith angle) (000 eq. 4.2); w twilight factor
};

// Perez' distribution (000 eq. 2.36).
FN Vec3 perez(IN(PreethamParams) p, IN(Real) cosZenith, IN(Real) cosSun) {
  Real inverse = 1.0f / max(cosZenith, 0.001f);
  Real gamma = 1.57079633f - arcSine(cosSun);
  return (Vec3(1.0f) + xyz(p.a) * exp(xyz(p.b) * inverse)) *
         (Vec3(1.0f) + xyz(p.c) * exp(xyz(p.d) * gamma) + xyz(p.e) * (cosSun * cosSun));
}

// Radiance of Preetham's sky toward a direction above the horizon (000 eq. 2.38).
FN Vec3 preethamRadiance(IN(PreethamParams) p, IN(Real) cosZenith, IN(Real) cosSun) {
  Vec3 v = perez(p, cosZenith, cosSun) * xyz(p.zenith);
  return max(rec709FromXyz(xyzFromXyY(Vec3(v.y, v.z, v.x))), Vec3(0.0f)) * p.zenith.w;
}

// Filled from Atmosphere: kcd/m^2; glow.w is the exponent of the sun's glow.
struct GradientParams {
  vec4 horizon, zenith, glow;
};

// Two shades by height and the sun's glow by its angle (000 ch. 4.2.1).
FN Vec3 gradientRadiance(IN(GradientParams) p, IN(Real) cosZenith, IN(Real) cosSun) {
  return mix(Vec3(xyz(p.horizon)), Vec3(xyz(p.zenith)), saturate(cosZenith)) +
         xyz(p.glow) * pow(max(cosSun, 1e-6f), Real(p.glow.w));
}
