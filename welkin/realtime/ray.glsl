// What one ray of the picture shows: clouds, sheets and ground, with the air in between; not the sky behind. The
// reader supplies skySheetCount(Sky) and skySheet(int, Sky) besides what the march asks for, and
//   const int kLightVolume, Real skySunDepth(Vec3 q, Sky), Vec2 skyBelow(Vec2 p, Sky), Vec2 skyBelowAir(Vec2 p, Sky), AirShade skyAirShade(Sky)
// whether there is a light volume, its optical depth toward the sun, the light without direction that comes down below
// the clouds, and the shade along the ray (air_shade.glsl, to be included before); and
//   const int kRains, Vec4 skyRainSegment(int k, Sky)
// whether anything falls, and rainSegment() of the ray (rain_segments.glsl), from the view's picture of them.

// Light that a sheet sends along the ray: the sun's, and without direction that of the sky and of the ground, of which what
// it lets through stands in for what lies behind it.
FN Vec3 sheetLight(IN(Real) cosTheta, IN(Real) tau, IN(Real) slant, IN(Real) view, IN(Mask) below, IN(Vec3) sunlight,
                   IN(SheetParams) s, IN(MarchParams) m) {
  float g = 1.0f - sheetTurned(s);
  Real phase = s.kind == kSheetAltocumulus ? dropletPhase(cosTheta, m) : phaseHenyeyGreenstein(cosTheta, Real(g));
  Real lit = slabRadiance(phase, cosTheta, g, tau, max(slant, 0.02f), view, below);
  Vec3 sky = xyz(m.ambientSky) * m.ambientSky.w;
  Real behind = slabDiffuse(g, tau);
  Vec3 around = mix(xyz(m.ambientGround), sky, select(below, behind, 1.0f - behind));
  return sunlight * (lit * smoothstep(0.0f, 0.02f, slant)) + around * (1.0f - exp(-tau / view));
}

// Air that clouds shade: how much of it does not see the sun, in segments with a light volume and all in all without, and
// the radiance of that part, which is lit from all sides, in kcd/m^2.
struct ShadedAir {
  Vec3 radiance;
  Real share;
  AirShade segments;
  Vec2 way;
};

// The air on the way to `distance`, each metre taking `loss` of the light.
FN ShadedAir shadedAir(IN(Vec3) dir, IN(Real) distance, IN(Real) loss, IN(Vec3) sunlight, IN(MarchParams) m,
                       IN(Sky) sky) {
  ShadedAir s;
  s.radiance = xyz(m.shadedAir);
  s.share = Real(m.shadedAir.w);
  s.segments = skyAirShade(sky);
  s.way = wayInShade(dir, m.bottom, m.top, m.planet);
  if (kLightVolume == 0 && m.planet.altitude >= m.bottom) s.share = Real(0.0f);
  if (kLightVolume != 0) {
    Real end = 1.0f - exp(-loss * distance);
    Vec2 below = Vec2(0.0f);
    for (int i = 0; i < 2; ++i) {
      Vec3 d = dir * min(-log(1.0f - end * (0.25f + 0.5f * float(i))) / max(loss, 1e-7f), distance);
      below = below + 0.5f * skyBelowAir(Vec2(d.x, d.y), sky);
    }
    s.radiance = (sunlight * below.x + xyz(m.skyAround) * (3.14159265f * below.y)) * xyz(m.shadedAir);
  }
  return s;
}

// The air between the camera and what it sees.
FN void airBefore(IN(Vec3) dir, IN(Real) distance, IN(ShadedAir) shaded, IN(AtmosphereParams) air,
                  IN(Sampler3) aerialInscatter, IN(Sampler3) aerialTransmittance, OUT(Vec3) inscatter,
                  OUT(Vec3) through) {
  lookupAerial(aerialInscatter, aerialTransmittance, air, dir, distance, inscatter, through);
  Real share = shaded.share;
  if (kLightVolume != 0) share = shadeBefore(shaded.segments, distance, lossOf(through, distance), shaded.way);
  inscatter = mix(inscatter, shaded.radiance * (Vec3(1.0f) - through), share);
}

// What the sheets above a point of cloud space leave of sunlight that comes from a height of sine `slant`, where no light
// volume knows it.
FN Real sheetsThrough(IN(Vec3) q, IN(Real) slant, IN(MarchParams) m, IN(Sky) sky) {
  Vec3 sun = Vec3(m.sun.x, m.sun.y, m.sun.z);
  Real depth = 0.0f;
  for (int i = 0; i < skySheetCount(sky); ++i) {
    SheetParams s = skySheet(i, sky);
    Real rise = s.height - q.z;
    Real own = sheetDepthToward(Vec2(q.x, q.y), max(rise, 0.0f), sun, slant, 1.0f / m.planet.radius, s);
    depth += select(rise > 0.0f, own, Real(0.0f));
  }
  return exp(-depth);
}

// Rain and snow along a ray: light toward the eye over its opacity, opacity, and the distance that most of it has.
struct RainSeen {
  Vec3 source;
  Real opacity, depth;
};

FN RainSeen rainSeen(IN(Vec3) dir, IN(Real) limit, IN(Vec3) sunlight, IN(MarchParams) m, IN(Sky) sky) {
  Vec2 way = wayBelow(dir, m.rain.x, m.planet);
  Real end = min(way.y, limit);
  Vec3 weights = Vec3(0.0f);
  Real through = 1.0f;
  Real depth = 0.0f;
  for (int k = 0; k < kRainSegments; ++k) {
    float from = rainStart(k), to = rainStart(k + 1);
    if (noneOf(end > from)) break;
    Real a = max(way.x, Real(from));
    Real on = max(min(end, Real(to)) - a, 0.0f);
    Vec4 segment = skyRainSegment(k, sky);
    Real kept = exp(-segment.w * (on * (1.0f / (to - from))));
    Real opacity = through * (1.0f - kept);
    weights = weights + Vec3(segment.x, segment.y, segment.z) * (opacity / max(segment.w, 1e-7f));
    depth += opacity * (a + 0.5f * on);
    through *= kept;
  }
  RainSeen r;
  r.opacity = 1.0f - through;
  Real some = 1.0f / max(r.opacity, 1e-6f);
  Vec3 around = xyz(m.shadedAir);
  if (kLightVolume != 0)
    around = (sunlight * (weights.y * some) + xyz(m.skyAround) * (3.14159265f * (weights.z * some))) * around;
  r.source = sunlight * (weights.x * some) + around;
  r.depth = depth * some;
  return r;
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

  if (kLightVolume == 0) {
    Real left = sheetsThrough(cloudSpace(dir * entry, m.planet), sunCosine, m, sky);
    sunLow = sunLow * left;
    sunHigh = sunHigh * left;
  }

  MarchResult r = march(dir, limit, sunLow, sunHigh, jitter, m, sky);
  Vec3 inscatter = Vec3(0.0f);
  Vec3 through = Vec3(1.0f);
  Mask ground = r.ground > -0.5f;
  Real tGround = select(ground, r.groundDepth, Real(0.0f));
  // As far as the air may be shaded: to the cloud, the ground, or out of the clouds' shell.
  Vec2 leave = crossings(dir, m.top, m.planet);
  Real reach = select(ground, tGround, max(leave.y, 0.0f));
  reach = min(select(r.transmittance < 0.5f, min(r.depth, reach), reach), min(limit, Real(m.maxDistance)));
  lookupAerial(aerialInscatter, aerialTransmittance, air, dir, reach, inscatter, through);
  Real loss = lossOf(through, reach);
  ShadedAir shaded = shadedAir(dir, reach, loss, sunLow, m, sky);
  // What is seen past the clouds is the sky of its table, which knows no shade.
  Vec3 missing = Vec3(0.0f);
  if (kLightVolume != 0)
    missing = (shaded.radiance * (Vec3(1.0f) - through) - inscatter) *
              (m.skyBehind *
               select(either(ground, limit < 5e7f), Real(0.0f), shadeBefore(shaded.segments, reach, loss, shaded.way)));
  airBefore(dir, r.depth, shaded, air, aerialInscatter, aerialTransmittance, inscatter, through);
  Real fade = 1.0f - smoothstep(0.55f * m.maxDistance, 0.98f * m.maxDistance, r.depth);
  Real opacity = (1.0f - r.transmittance) * fade;
  Vec3 radiance = (r.radiance * through) * fade + inscatter * opacity;
  Real kept = 1.0f - opacity;
  radiance = radiance + missing * kept;
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
    Real rise = dot(dir, normal);
    Real view = max(abs(rise), 0.12f);
    Real opaque = select(seen, 1.0f - exp(-vertical / view), Real(0.0f));
    Vec3 sunlight = irradiance * lookupTransmittanceToSun(transmittance, air, Real(s.height), slant);
    // Below tops of clouds it stands in their shade.
    if (kLightVolume != 0 && s.height < m.top)
      sunlight = sunlight * exp(-kReduced * skySunDepth(cloudSpace(dir * t, m.planet), sky));
    lookupAerial(aerialInscatter, aerialTransmittance, air, dir, t, inscatter, through);
    Vec3 light = sheetLight(cosTheta, vertical, slant, view, rise > 0.0f, sunlight, s, m) * through + inscatter * opaque;
    light = select(seen, light, Vec3(0.0f));
    Mask front = t < r.depth;
    radiance = select(front, light + radiance * (1.0f - opaque), radiance + light * kept);
    kept = kept * (1.0f - opaque);
    depth = select(both(front, opaque > 0.1f), t, select(depth >= m.maxDistance, select(seen, t, depth), depth));
  }

  if (kRains != 0) {
    RainSeen rain = rainSeen(dir, min(limit, select(ground, tGround, Real(1e9f))), sunLow, m, sky);
    airBefore(dir, rain.depth, shaded, air, aerialInscatter, aerialTransmittance, inscatter, through);
    Vec3 light = (rain.source * through + inscatter) * rain.opacity;
    Mask front = either(rain.depth < r.depth, toMask(m.planet.altitude < m.bottom));
    radiance = select(front, light + radiance * (1.0f - rain.opacity), radiance + light * kept);
    kept = kept * (1.0f - rain.opacity);
    depth = select(both(rain.opacity > 0.3f, rain.depth < depth), rain.depth, depth);
  }

  Vec3 normal = normalize(up * m.planet.up.w + dir * tGround);
  Real cosSun = max(dot(sun, normal), 0.0f);
  Vec3 lit = irradiance * lookupTransmittanceToSun(transmittance, air, Real(0.0f), dot(sun, normal));
  Vec3 diffuse = xyz(m.skyIrradiance);
  if (kLightVolume == 0) lit = lit * sheetsThrough(Vec3(dir.x * tGround, dir.y * tGround, 0.0f), dot(sun, normal), m, sky);
  Real open = 1.0f;
  if (kLightVolume != 0) {
    Vec2 below = skyBelow(Vec2(dir.x * tGround, dir.y * tGround), sky);
    diffuse = sunLow * below.x + skyOnGround(xyz(m.skyOpen), xyz(m.skyAround), below.y);
    open = below.y;
  }
  Vec3 surface = groundRadiance(lit * (cosSun * max(r.ground, 0.0f)) + diffuse, xyz(m.groundAlbedo), open);
  airBefore(dir, tGround, shaded, air, aerialInscatter, aerialTransmittance, inscatter, through);
  radiance = select(ground, radiance + (surface * through + inscatter) * kept, radiance);
  depth = select(both(ground, depth >= m.maxDistance), tGround, depth);
  kept = select(ground, Real(0.0f), kept);
  colour = Vec4(radiance.x, radiance.y, radiance.z, kept);
}
