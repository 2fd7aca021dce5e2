// What one ray of the picture shows: clouds, sheets and ground, with the air in between; not the sky behind. The
// reader supplies skySheetCount(Sky) and skySheet(int, Sky) besides what march.glsl asks for.

// The sheet's light over its opacity: a thin layer lit through half of itself.
FN Vec3 sheetSource(IN(Real) cosTheta, IN(Real) tau, IN(Real) slant, IN(Vec3) sunlight, IN(MarchParams) m) {
  Real phase = 2.7f * mix(Real(phaseIsotropic()), phaseHenyeyGreenstein(cosTheta, Real(0.75f)), Real(0.7f));
  Real reach = exp(-0.5f * tau / max(slant, 0.1f));
  return sunlight * (phase * (0.25f + 0.75f * reach)) + xyz(m.ambientSky) * (0.6f * m.ambientSky.w) +
         xyz(m.ambientGround) * 0.15f;
}

// The air between the camera and what it sees; from below the clouds a part of it lies in their shade, where light comes
// from all sides and is white.
FN void airBefore(IN(Vec3) dir, IN(Real) distance, IN(MarchParams) m, IN(AtmosphereParams) air,
                  IN(Sampler3) aerialInscatter, IN(Sampler3) aerialTransmittance, OUT(Vec3) inscatter,
                  OUT(Vec3) through) {
  lookupAerial(aerialInscatter, aerialTransmittance, air, dir, distance, inscatter, through);
  if (m.planet.altitude < m.bottom)
    inscatter = mix(inscatter, xyz(m.shadedAir) * (Vec3(1.0f) - through), Real(m.shadedAir.w));
}

FN void renderRay(IN(Vec3) dir, IN(Real) limit, IN(Vec3) jitter, IN(MarchParams) m, IN(AtmosphereParams) air,
                  IN(Sampler2) transmittance, IN(Sampler3) aerialInscatter, IN(Sampler3) aerialTransmittance,
                  IN(Sky) sky, OUT(Vec4) colour, OUT(Real) depth, OUT(Real) samples) {
  Vec3 sun = Vec3(m.sun.x, m.sun.y, m.sun.z);
  Vec3 up = Vec3(m.planet.up.x, m.planet.up.y, m.planet.up.z);
  Vec3 irradiance = xyz(air.sunIrradiance);

  // Sunlight at the bottom and the top of the clouds, where the ray comes to them.
  Vec2 first = crossings(dir, m.bottom, m.planet);
  Real entry = select(first.x > 0.0f, first.x, max(first.y, 0.0f));
  if (m.planet.altitude > m.bottom && m.planet.altitude < m.top) entry = Real(0.0f);
  entry = min(entry, m.maxDistance);
  Real sunCosine = dot(sun, normalize(up * m.planet.up.w + dir * entry));
  Vec3 sunLow = irradiance * lookupTransmittanceToSun(transmittance, air, Real(m.bottom), sunCosine);
  Vec3 sunHigh = irradiance * lookupTransmittanceToSun(transmittance, air, Real(m.top), sunCosine);

  MarchResult r = march(dir, limit, sunLow, sunHigh, jitter, m, sky);
  Vec3 inscatter = Vec3(0.0f);
  Vec3 through = Vec3(1.0f);
  airBefore(dir, r.depth, m, air, aerialInscatter, aerialTransmittance, inscatter, through);
  Real fade = 1.0f - smoothstep(0.55f * m.maxDistance, 0.98f * m.maxDistance, r.depth);
  Real opacity = (1.0f - r.transmittance) * fade;
  Vec3 radiance = (r.radiance * through) * fade + inscatter * opacity;
  Real kept = 1.0f - opacity;
  depth = r.depth;
  samples = r.samples;

  Real cosTheta = dot(dir, sun);
  int sheets = skySheetCount(sky);
  for (int i = 0; i < sheets; ++i) {
    SheetParams s = skySheet(i, sky);
    Vec2 cross_ = crossings(dir, s.height, m.planet);
    Real t = cross_.y;
    if (m.planet.altitude > s.height) t = cross_.x;
    Mask seen = both(both(t > 0.0f, t < limit), either(r.groundDepth > t, t < 0.0f));
    seen = both(seen, t < 4.0f * m.maxDistance);
    t = select(seen, t, Real(0.0f));
    Vec3 normal = normalize(up * m.planet.up.w + dir * t);
    Real vertical = sheetOpticalDepth(Vec2(dir.x * t, dir.y * t), s);
    Real slant = dot(sun, normal);
    Real opaque = select(seen, 1.0f - exp(-vertical / max(abs(dot(dir, normal)), 0.12f)), Real(0.0f));
    Vec3 sunlight = irradiance * lookupTransmittanceToSun(transmittance, air, Real(s.height), slant);
    lookupAerial(aerialInscatter, aerialTransmittance, air, dir, t, inscatter, through);
    Vec3 light = (sheetSource(cosTheta, vertical, slant, sunlight, m) * through + inscatter) * opaque;
    Mask front = t < r.depth;
    radiance = select(front, light + radiance * (1.0f - opaque), radiance + light * kept);
    kept = kept * (1.0f - opaque);
    depth = select(both(front, opaque > 0.1f), t, select(depth >= m.maxDistance, select(seen, t, depth), depth));
  }

  Mask ground = r.ground > -0.5f;
  Real tGround = select(ground, r.groundDepth, Real(0.0f));
  Vec3 normal = normalize(up * m.planet.up.w + dir * tGround);
  Real cosSun = max(dot(sun, normal), 0.0f);
  Vec3 lit = irradiance * lookupTransmittanceToSun(transmittance, air, Real(0.0f), dot(sun, normal));
  Vec3 surface = xyz(m.groundAlbedo) * (lit * (cosSun * max(r.ground, 0.0f)) + xyz(m.skyIrradiance)) * 0.318309886f;
  airBefore(dir, tGround, m, air, aerialInscatter, aerialTransmittance, inscatter, through);
  radiance = select(ground, radiance + (surface * through + inscatter) * kept, radiance);
  depth = select(both(ground, depth >= m.maxDistance), tGround, depth);
  kept = select(ground, Real(0.0f), kept);
  colour = Vec4(radiance.x, radiance.y, radiance.z, kept);
}
