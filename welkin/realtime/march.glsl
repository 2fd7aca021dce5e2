// The march: what one ray sees of clouds and ground. One density sample per turn of the loop; the ray's state says what
// the sample is for. That form is the fastest on wide SIMD machines, Mesa's software driver among them. The reader
// supplies, before this file, `struct Sky` and
//   Vec3 skyExtinction(Vec3 q, Real footprint, Mask full, Sky sky)
// which answers (extinction in 1/m, profile, extinction times precipitation) of all layers at a point of cloud space.

const float kLightFirst = 15.0f;   // m, first step toward the sun
const float kAmbientFirst = 60.0f;
const float kAmbientRatio = 2.5f;

// A fixed pseudo-random vector in [-1, 1]^3 for the k-th sample of the cone (004 ch. 4.5.3).
FN Vec3 coneKernel(IN(Real) k) {
  Uint h = hashUint(toUint(toInt(k)) + 17u);
  Real x = unitFromHash(h);
  Real y = unitFromHash(nextHash(h));
  Real z = unitFromHash(nextHash(nextHash(h)));
  return Vec3(x, y, z) * 2.0f - Vec3(1.0f);
}

// Marches the ray from the anchor along `dir` to `limit` (m). `sunLow` and `sunHigh`: sunlight (klx) at the bottom and
// top of the clouds. `jitter`: three numbers in [0, 1) that place the steps along the ray, those of its light,
// and those of the ground's light.
FN MarchResult march(IN(Vec3) dir, IN(Real) limit, IN(Vec3) sunLow, IN(Vec3) sunHigh, IN(Vec3) jitter,
                     IN(MarchParams) m, IN(Sky) sky) {
  Vec3 sun = Vec3(m.sun.x, m.sun.y, m.sun.z);
  Vec3 up = Vec3(m.planet.up.x, m.planet.up.y, m.planet.up.z);
  RaySpan span = raySpan(dir, limit, m);
  Real t = span.start;
  Real tEnd = span.end;
  Real tGround = span.ground;
  Mask marchGround = span.drawGround;

  // Octaves of multiple scattering (Wrenninge 2013, Hillaire 2016): each with less energy, less extinction and a rounder
  // phase function than the one before.
  Real cosTheta = dot(dir, sun);
  Real phases[8];
  float octaveGain = 1.0f;
  float roundness = 1.0f;
  for (int i = 0; i < 8; ++i) {
    phases[i] = octaveGain * mix(phaseHenyeyGreenstein(cosTheta, Real(m.forwardG * roundness)),
                                 phaseHenyeyGreenstein(cosTheta, Real(m.backwardG * roundness)), Real(m.backwardWeight));
    if (i == 0) phases[i] = dropletPhase(cosTheta, m);
    if (i >= m.octaves) phases[i] = Real(0.0f);
    if (i == 0) octaveGain = m.octaveGain;
    octaveGain *= m.contribution;
    roundness *= m.eccentricity;
  }
  Real steps = mix(Real(float(m.fixedStepsHorizon)), Real(float(m.fixedSteps)), abs(dot(dir, up)));
  Real rayStep = max((tEnd - t) / max(steps, 1.0f), 1.0f);
  Real lastStep = clamp(t * m.stepScale, m.minStep, m.maxStep);
  if (m.fixedSteps > 0) lastStep = rayStep;
  t += jitter.x * lastStep;

  // mode: 0 along the ray, 1 toward the sun, 2 upward, 3 from the ground toward the sun, 4 done.
  Real mode = select(t < tEnd, Real(0.0f), select(marchGround, Real(3.0f), Real(4.0f)));
  Real k = 0.0f;          // number of the sample within its mode
  Real fineLeft = 0.0f;   // refined steps to go
  Real zeros = 0.0f;      // full samples without cloud, one after the other
  Mask searching = toMask(m.cheapSearch != 0);
  Real transmittance = 1.0f;
  Vec3 radiance = Vec3(0.0f);
  Real depthSum = 0.0f;
  Real depthWeight = 0.0f;
  Real tau = 0.0f;        // toward the sun
  Real tauUp = 0.0f;
  Real sigma = 0.0f;      // at the point that is being lit
  Real rain = 0.0f;
  Real lightAt = 0.0f;
  Real lightStep = 0.0f;
  Real samples = 0.0f;
  Real points = 0.0f;      // points lit so far
  Real groundTau = 0.0f;
  Real slant = max(dot(sun, up), 0.02f);
  float shell = m.top - m.bottom;

  for (int turn = 0; turn < m.maxTurns; ++turn) {
    Mask along = mode < 0.5f;
    Mask toSun = both(mode > 0.5f, mode < 1.5f);
    Mask upward = both(mode > 1.5f, mode < 2.5f);
    Mask fromGround = both(mode > 2.5f, mode < 3.5f);
    if (noneOf(mode < 3.5f)) break;

    // Where the sample is. Each step of the light has a place of its own, for every point anew, so that errors cancel.
    Real within = fract(jitter.y + 0.61803399f * k + 0.38196601f * points);
    Vec3 offset = sun * (lightAt + lightStep * within);
    if (m.nubis != 0) offset = sun * lightAt + coneKernel(k) * (lightStep * 0.5f * k);
    offset = select(upward, up * (lightAt + lightStep * within), offset);
    Vec3 ground = sun * ((m.bottom + shell * (k + jitter.z) / float(m.groundSteps)) / slant);
    Vec3 d = dir * select(fromGround, tGround, t);
    d = d + select(fromGround, ground, select(along, Vec3(0.0f), offset));
    Vec3 q = cloudSpace(d, m.planet);
    Real spacing = clamp(t * m.stepScale, m.minStep, m.maxStep);
    if (m.fixedSteps > 0) spacing = rayStep;
    Real footprint = max(t * m.footprintPerMetre, select(along, 0.5f * spacing, max(0.5f * spacing, 0.3f * lightStep)));
    Mask full = invert(both(along, searching));
    if (m.nubis != 0) full = both(full, either(along, transmittance > 0.7f));
    Vec3 found = skyExtinction(q, footprint, full, sky);
    samples += select(mode < 3.5f, Real(1.0f), Real(0.0f));

    // Along the ray: find cloud, refine its edge, then light the point.
    Mask cloud = both(along, found.x > 0.0f);
    Real dt = spacing;
    if (m.fixedSteps == 0) {
      dt = select(fineLeft > 0.5f, 0.25f * spacing, select(found.y <= 0.0f, 1.8f * spacing, spacing));
    }
    Mask backUp = both(cloud, both(fineLeft < 0.5f, both(transmittance > 0.98f, toMask(m.refine != 0))));
    Mask foundCheap = both(cloud, searching);
    Mask light = both(cloud, invert(either(backUp, foundCheap)));
    Mask empty = both(along, invert(cloud));
    searching = both(searching, invert(foundCheap));
    if (m.cheapSearch != 0) {
      zeros = select(both(empty, invert(searching)), zeros + 1.0f, select(light, Real(0.0f), zeros));
      Mask lost = zeros > 5.5f;
      searching = either(searching, lost);
      zeros = select(lost, Real(0.0f), zeros);
    }
    t = select(empty, t + dt, select(backUp, t - lastStep, t));
    lastStep = select(empty, dt, lastStep);
    fineLeft = select(backUp, Real(10.0f), select(empty, max(fineLeft - 1.0f, 0.0f), fineLeft));
    sigma = select(light, found.x, sigma);
    rain = select(light, found.z / max(found.x, 1e-9f), rain);
    tau = select(light, Real(0.0f), tau);
    tauUp = select(light, Real(0.0f), tauUp);

    // Toward the sun, then upward.
    tau += select(toSun, found.x * lightStep, Real(0.0f));
    tauUp += select(upward, found.x * lightStep, Real(0.0f));
    groundTau += select(fromGround, found.x * (shell / (float(m.groundSteps) * slant)), Real(0.0f));
    k = select(either(light, empty), Real(0.0f), k + 1.0f);
    Mask sunDone = both(toSun, k > float(m.lightSteps) - 0.5f);
    Mask upDone = both(upward, k > float(m.ambientSteps) - 0.5f);
    Real first = kLightFirst;
    if (m.nubis != 0) first = Real(shell * 0.03f);
    lightAt = select(light, Real(0.0f), select(either(toSun, upward), lightAt + lightStep, lightAt));
    if (m.nubis != 0) lightAt = select(either(light, both(toSun, k < 4.5f)), first * (k + 1.0f),
                                       select(toSun, first * 18.0f, lightAt));
    lightStep = select(light, first, lightStep);
    if (m.nubis == 0) lightStep = select(both(toSun, invert(sunDone)), lightStep * m.lightRatio, lightStep);
    lightStep = select(both(upward, invert(upDone)), lightStep * kAmbientRatio, lightStep);
    mode = select(light, Real(1.0f), mode);
    Mask startUp = both(sunDone, toMask(m.ambientSteps > 0));
    lightAt = select(startUp, Real(0.0f), lightAt);
    lightStep = select(startUp, Real(kAmbientFirst), lightStep);
    k = select(startUp, Real(0.0f), k);
    mode = select(startUp, Real(2.0f), mode);

    // Shade and step on.
    Mask shade = either(both(sunDone, invert(startUp)), upDone);
    Real height = saturate((q.z - m.bottom) / shell);
    Vec3 sunlight = mix(sunLow, sunHigh, height);
    Real thick = tau * (1.0f + m.rainAbsorption * rain);
    Vec3 source = Vec3(0.0f);
    if (m.nubis != 0) {
      Real energy = 2.0f * exp(-thick) * (1.0f - exp(-2.0f * thick)) * phaseHenyeyGreenstein(cosTheta, Real(m.forwardG));
      source = sunlight * energy;
      source += xyz(m.ambientSky) * (m.ambientSky.w * (0.35f + 0.65f * height));
      source += xyz(m.ambientGround) * (0.25f * m.ambientGround.w * (1.0f - height));
    } else {
      Real powder = mix(Real(1.0f), 1.0f - exp(-2.0f * tau), Real(m.sun.w));
      Real scattered = 0.0f;
      Real reach = thick;
      for (int i = 0; i < 8; ++i) {
        if (i < m.octaves) scattered += phases[i] * exp(-reach);
        reach *= m.octaveExtinction;
      }
      source = sunlight * (scattered * powder);
      Real above = sigma * max(q.z - m.bottom, 0.0f);
      source += xyz(m.ambientSky) * (m.ambientSky.w * 0.75f * exp(-0.12f * tauUp));
      // Deep inside, light has lost its direction and falls off as in two-stream theory with g = 0.86.
      Real over = tauUp * (1.0f + m.rainAbsorption * rain);
      source += xyz(m.diffused) * (m.diffused.w * (1.0f - exp(-0.12f * tauUp)) / (1.0f + 0.105f * over));
      source += xyz(m.ambientGround) * (m.ambientGround.w * (0.5f * exp(-0.072f * above) + 0.03f));
    }
#ifdef LIGHTNING
    source += skyLightning(cloudSpace(dir * t, m.planet), sky);
#endif
    Real stride = select(fineLeft > 0.5f, 0.25f * spacing, spacing);
    Real kept = exp(-sigma * stride);
    Real weight = select(shade, transmittance * (1.0f - kept), Real(0.0f));
    radiance += source * (weight * m.skyIrradiance.w);
    depthSum += weight * t;
    depthWeight += weight;
    transmittance = select(shade, transmittance * kept, transmittance);
    points = select(shade, points + 1.0f, points);
    t = select(shade, t + stride, t);
    lastStep = select(shade, stride, lastStep);
    fineLeft = select(shade, max(fineLeft - 1.0f, 0.0f), fineLeft);
    mode = select(shade, Real(0.0f), mode);
    k = select(shade, Real(0.0f), k);

    // The ray's end, then the ground's.
    Mask rayDone = both(mode < 0.5f, either(t >= tEnd, transmittance < m.earlyExit));
    Mask needGround = both(marchGround, transmittance > 0.004f);
    mode = select(rayDone, select(needGround, Real(3.0f), Real(4.0f)), mode);
    k = select(rayDone, Real(0.0f), k);
    mode = select(both(fromGround, k > float(m.groundSteps) - 0.5f), Real(4.0f), mode);
  }

  MarchResult r;
  r.radiance = radiance;
  r.transmittance = select(transmittance < m.earlyExit, Real(0.0f), transmittance);
  r.depth = select(depthWeight > 1e-4f, depthSum / max(depthWeight, 1e-4f), Real(m.maxDistance));
  // Direct light, and what the cloud scatters down (two-stream, g = 0.86), of which about half falls elsewhere.
  Real direct = exp(-min(groundTau, 40.0f));
  Real lit = direct + 0.5f * (1.0f - direct) / (1.0f + 0.105f * groundTau);
  r.ground = select(span.drawGround, lit, Real(-1.0f));
  r.groundDepth = tGround;
  r.samples = samples;
  return r;
}
