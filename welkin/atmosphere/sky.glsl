// The tables that renderers read: the sky round the camera and the air in front of what they draw. They are oriented by
// the world: heading relative to the sun (the sky is symmetric about it, unless a second light shines: then the tables
// hold both sides), elevation with most texels at the horizon.

const float kSkyViewWidth = 96.0f;
const float kSkyViewBelow = 40.0f;  // rows below the true horizon, up to the ground
const float kSkyViewAbove = 88.0f;
const float kSkyViewHeight = 128.0f;
const int kSkyViewSteps = 40;
const float kAerialWidth = 32.0f;
const float kAerialHeight = 64.0f;
const float kAerialDepth = 32.0f;
const float kAerialPower = 2.5f;
const float kAerialUnit = 2000.0f;  // m: in-scatter is stored for a path of this length, which hardly varies with depth
const int kAerialSteps = 4;
const float kHalfPi = 1.57079633f;

// sin(heading / 2), 0 toward the sun and 1 away from it: half a chord of the unit circle, exact at both ends.
FN Real headingFromDirection(IN(AtmosphereParams) air, IN(Vec3) direction) {
  Real r = max(length(Vec2(direction.x, direction.y)), 1e-6f);
  Vec2 chord = Vec2(direction.x, direction.y) * (1.0f / r) - xy(air.sunHeading);
  return min(0.5f * length(chord), 1.0f);
}
// The same as a coordinate of tables in [0, 1]: of a sky with a second light .5 is toward the sun, 1 away from it by its
// right side and 0 by its left.
FN Real headingUnit(IN(AtmosphereParams) air, IN(Vec3) direction) {
  Real heading = headingFromDirection(air, direction);
  if (air.secondDirection.w > 0.5f) {
    Real right = direction.x * air.sunHeading.y - direction.y * air.sunHeading.x;
    heading = 0.5f + 0.5f * select(right < 0.0f, -heading, heading);
  }
  return heading;
}
// The inverse: negative on the left side.
FN Real headingFromUnit(IN(AtmosphereParams) air, IN(Real) unit) {
  Real heading = unit;
  if (air.secondDirection.w > 0.5f) heading = 2.0f * unit - 1.0f;
  return heading;
}
FN Real elevationFromDirection(IN(Vec3) direction) { return arcSine(direction.z); }

// Cosine between the sun and a direction of this heading and elevation.
FN Real cosSunFrom(IN(AtmosphereParams) air, IN(Real) heading, IN(Real) elevation) {
  return clamp(sin(elevation) * air.sunDirection.z +
                   cos(elevation) * air.sunHeading.z * (1.0f - 2.0f * heading * heading), -1.0f, 1.0f);
}

// The same for the second light; here the side counts.
FN Real cosSecondFrom(IN(AtmosphereParams) air, IN(Real) heading, IN(Real) elevation) {
  Real ahead = 1.0f - 2.0f * heading * heading;
  Real right = 2.0f * heading * sqrt(max(1.0f - heading * heading, 0.0f));
  float along = air.secondDirection.x * air.sunHeading.x + air.secondDirection.y * air.sunHeading.y;
  float across = air.secondDirection.x * air.sunHeading.y - air.secondDirection.y * air.sunHeading.x;
  return clamp(sin(elevation) * air.secondDirection.z + cos(elevation) * (ahead * along + right * across), -1.0f, 1.0f);
}

// Coordinates of the sky-view table. Rows below and above the horizon are never filtered into each other.
FN Vec2 skyViewUv(IN(AtmosphereParams) air, IN(Vec3) direction) {
  Real e = elevationFromDirection(direction) - air.horizonElevation;
  Real above = sqrt(saturate(e / (kHalfPi - air.horizonElevation)));
  Real below = sqrt(saturate(-e / (kHalfPi + air.horizonElevation)));
  Real row = select(e >= 0.0f, kSkyViewBelow + above * (kSkyViewAbove - 1.0f),
                    (kSkyViewBelow - 1.0f) * (1.0f - below));
  return Vec2(texelFromUnit(headingUnit(air, direction), kSkyViewWidth), (row + 0.5f) / kSkyViewHeight);
}
// The inverse at texel centres: (heading, elevation).
FN Vec2 headingElevationFromUv(IN(AtmosphereParams) air, IN(Vec2) uv) {
  Real row = uv.y * kSkyViewHeight - 0.5f;
  Real above = max((row - kSkyViewBelow) / (kSkyViewAbove - 1.0f), 0.0f);
  Real below = max(1.0f - row / (kSkyViewBelow - 1.0f), 0.0f);
  Real e = select(row > kSkyViewBelow - 0.5f, above * above * (kHalfPi - air.horizonElevation),
                  -below * below * (kHalfPi + air.horizonElevation));
  return Vec2(headingFromUnit(air, unitFromTexel(uv.x, kSkyViewWidth)), air.horizonElevation + e);
}

// The air's own light above it at night, seen without the air in front: a shell at 90 km, which is longer to look
// through near the horizon (van Rhijn 1921).
FN Vec3 airglow(IN(AtmosphereParams) air, IN(Real) cosZenith) {
  float ratio = air.groundRadius / (air.groundRadius + 90000.0f);
  Real sine2 = max(1.0f - cosZenith * cosZenith, 0.0f);
  return Vec3(air.secondIrradiance.w) * inversesqrt(1.0f - ratio * ratio * sine2);
}

// Radiance that the air sends to the camera from a direction, up to the top of the air or the ground, by a light of this
// height (sine) and irradiance at the angle of cosine `cosLight` from the ray; and what it lets through.
FN Vec3 scatteredRadiance(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air,
                          IN(Real) elevation, float lightHeight, IN(vec4) irradiance, IN(Real) cosLight,
                          IN(Mask) aboveHorizon, int steps, INOUT(Vec3) through) {
  Real h = air.cameraAltitude;
  Real cosZenith = sin(elevation);
  Real begin = distanceToAir(air, h, cosZenith);
  Real end = select(aboveHorizon, distanceToTop(air, h, cosZenith), distanceToGround(air, h, cosZenith));
  Vec3 radiance = Vec3(0.0f);
  addInscatter(transmittance, multiScattering, air, h, cosZenith, lightHeight, cosLight, begin, max(begin, end), steps,
               radiance, through);
  return radiance * xyz(irradiance);
}

// The same by the sun, with the airglow behind it (kcd/m^2).
FN Vec3 airRadiance(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air,
                    IN(Real) elevation, IN(Real) cosSun, IN(Mask) aboveHorizon, int steps) {
  Vec3 through = Vec3(1.0f);
  Vec3 radiance = scatteredRadiance(transmittance, multiScattering, air, elevation, air.sunDirection.z,
                                    air.sunIrradiance, cosSun, aboveHorizon, steps, through);
  return radiance + select(aboveHorizon, through * airglow(air, sin(elevation)), Vec3(0.0f));
}

// Radiance of the chosen model above the horizon, of the air below it (kcd/m^2).
FN Vec3 skyRadiance(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air,
                    IN(PreethamParams) preetham, IN(GradientParams) gradient, IN(Real) elevation, IN(Real) cosSun,
                    IN(Mask) aboveHorizon, int steps) {
  Vec3 radiance = airRadiance(transmittance, multiScattering, air, elevation, cosSun, aboveHorizon, steps);
  if (air.skyKind == 1)
    radiance = select(aboveHorizon, preethamRadiance(preetham, sin(elevation), cosSun), radiance);
  if (air.skyKind == 2)
    radiance = select(aboveHorizon, gradientRadiance(gradient, sin(elevation), cosSun), radiance);
  return radiance;
}

// One texel of the sky-view table.
FN Vec4 skyViewTexel(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air,
                     IN(PreethamParams) preetham, IN(GradientParams) gradient, IN(Vec2) uv) {
  Vec2 view = headingElevationFromUv(air, uv);
  Vec3 c = skyRadiance(transmittance, multiScattering, air, preetham, gradient, view.y,
                       cosSunFrom(air, view.x, view.y), uv.y * kSkyViewHeight > kSkyViewBelow, kSkyViewSteps);
  if (air.secondDirection.w > 0.5f) {
    Vec3 through = Vec3(1.0f);
    c += scatteredRadiance(transmittance, multiScattering, air, view.y, air.secondDirection.z, air.secondIrradiance,
                           cosSecondFrom(air, view.x, view.y), uv.y * kSkyViewHeight > kSkyViewBelow, kSkyViewSteps,
                           through);
  }
  c = c * air.radianceScale;
  return Vec4(c.x, c.y, c.z, 1.0f);
}

// Radiance of the sky toward a direction (kcd/m^2); below the horizon the air before the ground, without the ground.
FN Vec3 lookupSky(IN(Sampler2) skyView, IN(AtmosphereParams) air, IN(Vec3) direction) {
  return xyz(sample2(skyView, skyViewUv(air, direction))) * (1.0f / air.radianceScale);
}

// Coordinates of the aerial tables. Below the horizon the air goes on through the ground, so that nothing jumps there.
FN Vec2 aerialUv(IN(AtmosphereParams) air, IN(Vec3) direction) {
  Real e = elevationFromDirection(direction) - air.horizonElevation;
  Real above = sqrt(saturate(e / (kHalfPi - air.horizonElevation)));
  Real below = sqrt(saturate(-e / (kHalfPi + air.horizonElevation)));
  return Vec2(texelFromUnit(headingUnit(air, direction), kAerialWidth),
              texelFromUnit(0.5f + 0.5f * (above - below), kAerialHeight));
}
FN Vec2 headingElevationFromAerialUv(IN(AtmosphereParams) air, IN(Vec2) uv) {
  Real s = 2.0f * unitFromTexel(uv.y, kAerialHeight) - 1.0f;
  Real range = select(s > 0.0f, Real(kHalfPi - air.horizonElevation), Real(kHalfPi + air.horizonElevation));
  return Vec2(headingFromUnit(air, unitFromTexel(uv.x, kAerialWidth)), air.horizonElevation + s * abs(s) * range);
}
// Depth coordinate of a distance, and the distance of slice 0, 1, ... (the first stands for none at all).
FN Real aerialDepth(IN(AtmosphereParams) air, IN(Real) distance) {
  return texelFromUnit(pow(saturate(distance / air.aerialRange), Real(1.0f / kAerialPower)), kAerialDepth);
}
FN float aerialDistance(IN(AtmosphereParams) air, int slice) {
  return max(air.aerialRange * pow(toReal(slice) / (kAerialDepth - 1.0f), kAerialPower), 1.0f);
}

// Carries one column of the aerial tables on to `slice`: radiance from the camera on (times radianceScale) and
// transmittance. What is stored is the transmittance and aerialStored(radiance).
FN void aerialTexel(IN(Sampler2) transmittance, IN(Sampler2) multiScattering, IN(AtmosphereParams) air, IN(Vec2) uv,
                    int slice, INOUT(Vec3) inscatter, INOUT(Vec3) through) {
  Vec2 view = headingElevationFromAerialUv(air, uv);
  float begin = slice > 0 ? aerialDistance(air, slice - 1) : 0.0f;
  Real h = air.cameraAltitude;
  Real cosZenith = sin(view.y);
  Real entry = distanceToAir(air, h, cosZenith);
  Real exit = max(distanceToTop(air, h, cosZenith), entry);
  Real from = clamp(Real(begin), entry, exit);
  Real to = clamp(Real(aerialDistance(air, slice)), entry, exit);
  Vec3 before = through;
  Vec3 radiance = Vec3(0.0f);
  addInscatter(transmittance, multiScattering, air, h, cosZenith, air.sunDirection.z, cosSunFrom(air, view.x, view.y),
               from, to, kAerialSteps, radiance, through);
  inscatter += radiance * xyz(air.sunIrradiance) * air.radianceScale;
  if (air.secondDirection.w > 0.5f) {
    radiance = Vec3(0.0f);
    addInscatter(transmittance, multiScattering, air, h, cosZenith, air.secondDirection.z,
                 cosSecondFrom(air, view.x, view.y), from, to, kAerialSteps, radiance, before);
    inscatter += radiance * xyz(air.secondIrradiance) * air.radianceScale;
  }
}
FN Vec3 aerialStored(IN(AtmosphereParams) air, int slice, IN(Vec3) inscatter) {
  return inscatter * (kAerialUnit / aerialDistance(air, slice));
}

// The air between the camera and a point at `distance`: what it adds (kcd/m^2) and what it lets through.
FN void lookupAerial(IN(Sampler3) aerialInscatter, IN(Sampler3) aerialTransmittance, IN(AtmosphereParams) air,
                     IN(Vec3) direction, IN(Real) distance, OUT(Vec3) inscatter, OUT(Vec3) through) {
  Vec2 uv = aerialUv(air, direction);
  Vec3 uvw = Vec3(uv.x, uv.y, aerialDepth(air, distance));
  Real units = clamp(distance, 0.0f, air.aerialRange) * (1.0f / (kAerialUnit * air.radianceScale));
  inscatter = xyz(sample3(aerialInscatter, uvw)) * units;
  through = xyz(sample3(aerialTransmittance, uvw));
}

// Transmittance from the camera to the ground along a direction below the horizon, at any distance: the way up from the
// ground point to space over the way up from the camera.
FN Vec3 lookupTransmittanceToGround(IN(Sampler2) transmittance, IN(AtmosphereParams) air, IN(Vec3) direction) {
  Real h = air.cameraAltitude;
  Real t = distanceToGround(air, h, direction.z);
  Real up = -((air.groundRadius + h) * direction.z + t) / air.groundRadius;
  Vec3 whole = lookupTransmittance(transmittance, air, 0.0f, max(up, 0.0f));
  return min(whole / max(lookupTransmittance(transmittance, air, h, -direction.z), 1e-6f), Vec3(1.0f));
}

// Radiance of the sun's disc outside the atmosphere (kcd/m^2, up to 2e6), its edge smooth over `pixel` radians; none
// when the moon has taken the sun's place. Limb
// darkening after Hestroffer and Magnan 1998: mu^alpha, with the disc's mean kept.
FN Vec3 sunDisc(IN(AtmosphereParams) air, IN(Vec3) direction, IN(Real) pixel) {
  float radius = air.sunDirection.w;
  Real angle = length(direction - xyz(air.sunDirection));
  Real x = min(angle / radius, 1.0f);
  Real mu = sqrt(max(1.0f - x * x, 1e-4f));
  Vec3 limb = Vec3(1.1985f * pow(mu, Real(0.397f)), 1.2515f * pow(mu, Real(0.503f)),
                   1.326f * pow(mu, Real(0.652f)));
  Real edge = saturate((radius - angle) / max(pixel, 1e-5f) + 0.5f);
  return limb * xyz(air.sunIrradiance) * (edge * (1.0f - air.sunIrradiance.w) * 0.318309886f / (radius * radius));
}
