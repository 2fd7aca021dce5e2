// The air: densities, distances inside a spherical shell, and the table of transmittance to space.
// A point is its altitude above the ground and the cosine of a direction against the local vertical; lengths in metres.

// Filled by makeAtmosphereParams. Radiance in tables is multiplied by radianceScale, so that half floats hold the night.
struct AtmosphereParams {
  vec4 rayleigh;       // xyz scattering at the ground (1/m), w 1 / scale height
  vec4 mieScattering;  // xyz scattering at the ground (1/m), w 1 / scale height
  vec4 mieExtinction;  // xyz extinction at the ground (1/m), w asymmetry
  vec4 ozone;          // xyz absorption in the middle of the layer (1/m), w 1 / half width of the layer
  vec4 sunDirection;   // xyz unit vector toward the sun (at night the moon), w its angular radius (rad)
  vec4 sunHeading;     // xy unit vector: the sun's heading, z length of the horizontal part of sunDirection
  vec4 sunIrradiance;  // xyz outside the atmosphere, on a plane facing the sun (klx); w 1 when it is the moon
  vec4 secondDirection;   // xyz unit vector toward a second light of the air, w 1 when there is one
  vec4 secondIrradiance;  // xyz outside the atmosphere (klx); w airglow at the zenith (kcd/m^2)
  vec4 groundAlbedo;   // xyz; w: share of the light that clouds send back up
  float groundRadius, thickness, ozoneHeight, haze;
  float hazeFalloff, cameraAltitude, horizonElevation, aerialRange;
  float radianceScale;
  int skyKind;         // what fills the sky-view table: 0 this air, 1 Preetham, 2 gradient
  float cloudBottom, cloudTop;  // m, of those clouds
};

const float kTransmittanceWidth = 256.0f;
const float kTransmittanceHeight = 64.0f;
const int kTransmittanceSteps = 80;

// asin with an error of some 1e-7 rad in every reading (polynomial of the Cephes library's asinf): drivers' acos may be
// off by 1e-4, which shows at the horizon.
FN Real arcSine(IN(Real) x) {
  Real a = min(abs(x), 1.0f);
  Real folded = sqrt(0.5f * (1.0f - a));
  Real y = select(a > 0.5f, folded, a);
  Real z = y * y;
  Real p = (((0.042163199f * z + 0.024181311f) * z + 0.0454700260f) * z + 0.0749530027f) * z + 0.166667524f;
  Real r = y + y * z * p;
  return sign(x) * select(a > 0.5f, 1.57079633f - 2.0f * r, r);
}

// Maps [0, 1] onto the centres of the first and last of n texels, and back.
FN Real texelFromUnit(IN(Real) x, float n) { return (0.5f + x * (n - 1.0f)) / n; }
FN Real unitFromTexel(IN(Real) u, float n) { return saturate((u * n - 0.5f) / (n - 1.0f)); }

// Altitude at distance t along a ray from `altitude`, without the cancellation of |p| - groundRadius.
FN Real altitudeAlong(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith, IN(Real) t) {
  Real r = air.groundRadius + altitude;
  Real q = t * (2.0f * r * cosZenith + t);
  return altitude + q / (r + sqrt(max(r * r + q, 0.0f)));
}

// top^2 - r^2 and r^2 - ground^2, each as a product.
FN Real belowTop(IN(AtmosphereParams) air, IN(Real) altitude) {
  return (air.thickness - altitude) * (2.0f * air.groundRadius + air.thickness + altitude);
}
FN Real aboveGround(IN(AtmosphereParams) air, IN(Real) altitude) {
  return altitude * (2.0f * air.groundRadius + altitude);
}

// Cosine of the zenith angle of the ground's horizon, at most 0.
FN Real horizonCosine(IN(AtmosphereParams) air, IN(Real) altitude) {
  return -sqrt(max(aboveGround(air, altitude), 0.0f)) / (air.groundRadius + altitude);
}

// Where a ray leaves the air, with the ground taken away; 0 when it never meets it.
FN Real distanceToTop(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith) {
  Real b = (air.groundRadius + altitude) * cosZenith;
  Real c = belowTop(air, altitude);
  Real root = sqrt(max(b * b + c, 0.0f));
  return max(select(b > 0.0f, c / max(b + root, 1.0f), root - b), 0.0f);
}

// Where a ray from outside enters the air; 0 inside it. A ray that misses has this distance beyond distanceToTop.
FN Real distanceToAir(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith) {
  Real b = (air.groundRadius + altitude) * cosZenith;
  Real c = belowTop(air, altitude);
  Real root = sqrt(max(b * b + c, 0.0f));
  return select(both(c < 0.0f, b < 0.0f), -c / max(root - b, 1.0f), Real(0.0f));
}

// Where a ray at or below the horizon meets the ground.
FN Real distanceToGround(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith) {
  Real r = air.groundRadius + altitude;
  Real c = max(aboveGround(air, altitude), 0.0f);
  Real down = -cosZenith;
  Real h = sqrt(c) / r;
  return c / max(r * (down + sqrt(max((down - h) * (down + h), 0.0f))), 0.001f);
}

// Densities of molecules, aerosol and ozone against their greatest values.
FN Vec3 airDensity(IN(AtmosphereParams) air, IN(Real) altitude) {
  Real h = max(altitude, 0.0f);
  return Vec3(exp(-h * air.rayleigh.w),
              exp(-h * air.mieScattering.w) + air.haze * exp(-h * air.hazeFalloff),
              max(1.0f - abs(h - air.ozoneHeight) * air.ozone.w, 0.0f));
}

// Extinction in 1/m.
FN Vec3 atmosphereExtinction(IN(AtmosphereParams) air, IN(Real) altitude) {
  Vec3 d = airDensity(air, altitude);
  return xyz(air.rayleigh) * d.x + xyz(air.mieExtinction) * d.y + xyz(air.ozone) * d.z;
}

// A march samples t = t0 + s |s| at equal steps of s: densest round the lowest point t0 of the ray.
FN Real lowestPoint(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith, IN(Real) begin, IN(Real) end) {
  return clamp(-(air.groundRadius + altitude) * cosZenith, begin, end);
}

// Coordinates of the transmittance table (Bruneton and Neyret 2008; Hillaire 2020): the ray's length to the top of the
// air and the distance to the horizon, both against their extremes. Altitude in [0, thickness].
FN Vec2 transmittanceUv(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith) {
  float full = sqrt(air.thickness * (2.0f * air.groundRadius + air.thickness));
  Real rho = sqrt(max(aboveGround(air, altitude), 0.0f));
  Real shortest = air.thickness - altitude;
  Real x = (distanceToTop(air, altitude, cosZenith) - shortest) / (rho + full - shortest);
  return Vec2(texelFromUnit(saturate(x), kTransmittanceWidth), texelFromUnit(rho / full, kTransmittanceHeight));
}

// The inverse of transmittanceUv: (altitude, cosZenith).
FN Vec2 altitudeCosineFromUv(IN(AtmosphereParams) air, IN(Vec2) uv) {
  float full = sqrt(air.thickness * (2.0f * air.groundRadius + air.thickness));
  Real rho = full * unitFromTexel(uv.y, kTransmittanceHeight);
  Real r = sqrt(rho * rho + air.groundRadius * air.groundRadius);
  Real altitude = min(rho * rho / (r + air.groundRadius), air.thickness);
  Real shortest = air.thickness - altitude;
  Real d = mix(shortest, rho + full, unitFromTexel(uv.x, kTransmittanceWidth));
  Real cosZenith = select(d < 1.0f, Real(1.0f), (belowTop(air, altitude) - d * d) / max(2.0f * r * d, 1.0f));
  return Vec2(altitude, clamp(cosZenith, -1.0f, 1.0f));
}

// One texel: transmittance to space along a ray that is free of the ground.
FN Vec4 transmittanceTexel(IN(AtmosphereParams) air, IN(Vec2) uv) {
  Vec2 ray = altitudeCosineFromUv(air, uv);
  Real end = distanceToTop(air, ray.x, ray.y);
  Real t0 = lowestPoint(air, ray.x, ray.y, 0.0f, end);
  Real s0 = -sqrt(t0);
  Real ds = (sqrt(end - t0) - s0) / toReal(kTransmittanceSteps);
  Real t = 0.0f;
  Vec3 depth = Vec3(0.0f);
  for (int i = 0; i < kTransmittanceSteps; ++i) {
    Real middle = s0 + ds * (toReal(i) + 0.5f);
    Real next = middle + 0.5f * ds;
    Real tNext = t0 + next * abs(next);
    depth += atmosphereExtinction(air, altitudeAlong(air, ray.x, ray.y, t0 + middle * abs(middle))) * (tNext - t);
    t = tNext;
  }
  Vec3 transmittance = exp(-depth);
  return Vec4(transmittance.x, transmittance.y, transmittance.z, 1.0f);
}

// Transmittance to space with the ground taken away; from outside the air, along the part of the ray inside it.
FN Vec3 lookupTransmittance(IN(Sampler2) transmittance, IN(AtmosphereParams) air, IN(Real) altitude,
                            IN(Real) cosZenith) {
  Real h = clamp(altitude, 0.0f, air.thickness);
  Real entry = distanceToAir(air, altitude, cosZenith);
  Real mu = ((air.groundRadius + altitude) * cosZenith + entry) / (air.groundRadius + air.thickness);
  mu = select(altitude > air.thickness, mu, cosZenith);
  return xyz(sample2(transmittance, transmittanceUv(air, h, mu)));
}

// The share of the sun's disc that stands above the ground's horizon, smooth as it sets.
FN Real sunVisibility(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) cosZenith) {
  Real h = max(altitude, 0.0f);
  Real width = air.sunDirection.w * air.groundRadius / (air.groundRadius + h);
  return smoothstep(-width, width, cosZenith - horizonCosine(air, h));
}

// What is left of the sun's irradiance at a point: transmittance times the visible share of the disc.
FN Vec3 lookupTransmittanceToSun(IN(Sampler2) transmittance, IN(AtmosphereParams) air, IN(Real) altitude,
                                 IN(Real) cosZenith) {
  return lookupTransmittance(transmittance, air, altitude, cosZenith) * sunVisibility(air, altitude, cosZenith);
}
