// Light scattered by the air (Hillaire 2020): single scattering by a march, all further orders from a small table.
// Radiance here is per unit irradiance of the sun outside the atmosphere, in 1/sr, until a table is filled.

const float kMultiScatteringSize = 32.0f;
const float kMultiScatteringScale = 1024.0f;  // of the table's values: half floats then hold the twilight
const int kMultiScatteringSteps = 24;
const int kMultiScatteringRings = 8;

// Coordinates of the multiple-scattering table: sun cosine and altitude, dense where the sun sets and near the ground.
FN Vec2 multiScatteringUv(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) sunCosine) {
  Real x = 0.5f + 0.5f * sign(sunCosine) * sqrt(min(abs(sunCosine), 1.0f));
  Real y = sqrt(saturate(altitude / air.thickness));
  return Vec2(texelFromUnit(x, kMultiScatteringSize), texelFromUnit(y, kMultiScatteringSize));
}
FN Vec2 altitudeSunFromUv(IN(AtmosphereParams) air, IN(Vec2) uv) {
  Real x = 2.0f * unitFromTexel(uv.x, kMultiScatteringSize) - 1.0f;
  Real y = unitFromTexel(uv.y, kMultiScatteringSize);
  return Vec2(air.thickness * y * y, x * abs(x));
}

// Cosine of the sun's zenith angle at distance t along a ray; `cosSun` is the angle between ray and sun.
FN Real sunCosineAlong(IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) sunCosine, IN(Real) cosSun,
                       IN(Real) t, IN(Real) altitudeThere) {
  return clamp(((air.groundRadius + altitude) * sunCosine + t * cosSun) / (air.groundRadius + altitudeThere), -1.0f,
               1.0f);
}

// Light that reaches a point on the ground and leaves it diffusely.
FN Vec3 groundRadiance(IN(Vec3) albedo, IN(Vec3) sunIrradiance, IN(Real) sunCosine, IN(Vec3) skyIrradiance) {
  return albedo * (sunIrradiance * max(sunCosine, 0.0f) + skyIrradiance) * 0.318309886f;
}

// Albedo of a ground that lights a point of the air as ground and clouds do. Air below them is lit by their undersides
// and sides: kCloudsAbove of what it would get from their tops, by the path tracer's hazy air under broken clouds.
const float kCloudsAbove = 0.6f;
FN Vec3 albedoRound(IN(AtmosphereParams) air, IN(Real) altitude) {
  Real above = smoothstep(air.cloudBottom, max(air.cloudTop, air.cloudBottom + 1.0f), altitude);
  Real clouds = air.groundAlbedo.w * mix(Real(kCloudsAbove), Real(1.0f), above);
  Vec3 ground = xyz(air.groundAlbedo);
  return Vec3(clouds) + ground * ((1.0f - clouds) * (1.0f - clouds)) / (Vec3(1.0f) - ground * clouds);
}

// One direction of multiScatteringTexel: adds the second order's radiance for isotropic scattering and the share of
// uniform light that is scattered once more.
FN void addSecondOrder(IN(Sampler2) transmittance, IN(AtmosphereParams) air, IN(Real) altitude, IN(Real) sunCosine,
                       float cosZenith, float azimuth, INOUT(Vec3) second, INOUT(Vec3) again) {
  Real cosSun = cosZenith * sunCosine +
                sqrt(1.0f - cosZenith * cosZenith) * cos(azimuth) * sqrt(max(1.0f - sunCosine * sunCosine, 0.0f));
  Mask hit = cosZenith < horizonCosine(air, altitude);
  Real end = select(hit, distanceToGround(air, altitude, cosZenith), distanceToTop(air, altitude, cosZenith));
  Real t0 = lowestPoint(air, altitude, cosZenith, 0.0f, end);
  Real s0 = -sqrt(t0);
  Real ds = (sqrt(end - t0) - s0) / toReal(kMultiScatteringSteps);
  Real t = 0.0f;
  Vec3 through = Vec3(1.0f);
  for (int k = 0; k < kMultiScatteringSteps; ++k) {
    Real middle = s0 + ds * (toReal(k) + 0.5f);
    Real next = middle + 0.5f * ds;
    Real tNext = t0 + next * abs(next);
    Real there = t0 + middle * abs(middle);
    Real dt = max(tNext - t, 0.0f);
    Real h = altitudeAlong(air, altitude, cosZenith, there);
    Vec3 d = airDensity(air, h);
    Vec3 scattering = xyz(air.rayleigh) * d.x + xyz(air.mieScattering) * d.y;
    Vec3 extinction = xyz(air.rayleigh) * d.x + xyz(air.mieExtinction) * d.y + xyz(air.ozone) * d.z;
    Vec3 left = through * stepIntegral(extinction, dt);
    Vec3 share = left * scattering;
    // What aerosol scatters forward is not yet spread over all directions: g^2 of it (delta-Eddington).
    float g = air.mieExtinction.w;
    Vec3 turned = left * (xyz(air.rayleigh) * d.x + xyz(air.mieScattering) * ((1.0f - g * g) * d.y));
    Real sun = sunCosineAlong(air, altitude, sunCosine, cosSun, there, h);
    second += turned * lookupTransmittanceToSun(transmittance, air, h, sun) * kInv4Pi;
    again += share;
    through = through * exp(-extinction * dt);
    t = tNext;
  }
  Real sunGround = sunCosineAlong(air, altitude, sunCosine, cosSun, end, 0.0f);
  Vec3 direct = lookupTransmittanceToSun(transmittance, air, 0.0f, sunGround);
  Vec3 bounce = through * groundRadiance(albedoRound(air, altitude), direct, sunGround, Vec3(0.0f));
  second += select(hit, bounce, Vec3(0.0f));
}

// One texel: radiance of all orders from the second on, as if each were isotropic: L2 / (1 - f) (Hillaire 2020 eq. 10).
FN Vec4 multiScatteringTexel(IN(Sampler2) transmittance, IN(AtmosphereParams) air, IN(Vec2) uv) {
  Vec2 place = altitudeSunFromUv(air, uv);
  float rings = toReal(kMultiScatteringRings);
  Vec3 second = Vec3(0.0f);
  Vec3 again = Vec3(0.0f);
  for (int i = 0; i < kMultiScatteringRings; ++i) {
    for (int j = 0; j < kMultiScatteringRings; ++j) {
      float cosZenith = (2.0f * toReal(i) + 1.0f) / rings - 1.0f;
      float azimuth = 3.14159265f * (toReal(j) + 0.5f) / rings;
      addSecondOrder(transmittance, air, place.x, place.y, cosZenith, azimuth, second, again);
    }
  }
  float share = 1.0f / (rings * rings);
  Vec3 all = (second * (share * kMultiScatteringScale)) / (Vec3(1.0f) - again * share);
  return Vec4(all.x, all.y, all.z, 1.0f);
}

// Radiance of all orders from the second on at a point.
FN Vec3 lookupMultiScattering(IN(Sampler2) multiScattering, IN(AtmosphereParams) air, IN(Real) altitude,
                              IN(Real) sunCosine) {
  return xyz(sample2(multiScattering, multiScatteringUv(air, altitude, sunCosine))) * (1.0f / kMultiScatteringScale);
}

// Adds what the air scatters toward the start of a ray between distances `begin` and `end` to `radiance`, dimmed by
// `through`, which is carried on. `cosSun` is the cosine between ray and sun, `sunCosine` the sun's at the ray's start.
FN void addInscatter(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air,
                     IN(Real) altitude, IN(Real) cosZenith, IN(Real) sunCosine, IN(Real) cosSun, IN(Real) begin,
                     IN(Real) end, int steps, INOUT(Vec3) radiance, INOUT(Vec3) through) {
  Real phaseR = phaseRayleigh(cosSun);
  Real phaseM = phaseCornetteShanks(cosSun, air.mieExtinction.w);
  Real t0 = lowestPoint(air, altitude, cosZenith, begin, end);
  Real s0 = -sqrt(t0 - begin);
  Real ds = (sqrt(end - t0) - s0) / toReal(steps);
  Real t = begin;
  for (int i = 0; i < steps; ++i) {
    Real middle = s0 + ds * (toReal(i) + 0.5f);
    Real next = middle + 0.5f * ds;
    Real tNext = t0 + next * abs(next);
    Real there = t0 + middle * abs(middle);
    Real h = max(altitudeAlong(air, altitude, cosZenith, there), 0.0f);
    Vec3 d = airDensity(air, h);
    Vec3 rayleigh = xyz(air.rayleigh) * d.x;
    Vec3 mie = xyz(air.mieScattering) * d.y;
    Vec3 extinction = rayleigh + xyz(air.mieExtinction) * d.y + xyz(air.ozone) * d.z;
    Real sun = sunCosineAlong(air, altitude, sunCosine, cosSun, there, h);
    Vec3 source = lookupTransmittanceToSun(transmittance, air, h, sun) * (rayleigh * phaseR + mie * phaseM) +
                  lookupMultiScattering(multiScattering, air, h, sun) * (rayleigh + mie);
    Real dt = max(tNext - t, 0.0f);
    radiance += through * source * stepIntegral(extinction, dt);
    through = through * exp(-extinction * dt);
    t = tNext;
  }
}
