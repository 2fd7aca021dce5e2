// The march with a light volume: what one ray sees of clouds and ground. Empty space is crossed by the weather's bounds
// (clearance.glsl), the near part of the way toward the sun is sampled, the volume knows the rest. Loops inside the loop
// bring the lanes of a wide machine together before the costly parts. As for march.glsl the includer supplies `Sky` and
// its questions; besides them
//   float skyClearance(vec3 q, vec3 way, Sky)
// how far a ray can go from q without meeting cloud, `way` being how q changes with each of its metres.

const int kMostSkips = 400;
const float kFarthestSkip = 4000.0;  // m, over which the earth bends by a metre
const int kFineSteps = 4;            // after the first hit
const float kFineStep = 0.5;         // share of the usual step
const float kEyeStep = 2.0, kEyeGrowth = 0.12;  // m and share of the distance: most of a step near an eye in fog
const float kShortPath = 100.0, kLongPath = 300.0;  // m; a cell of the light volume, and the longest
// Lumps of cloud smaller than a cell of the volume: how wide they are (m, and share of the height of all clouds at most),
// and how much light without direction there is at the sunlit face of one that is thick.
const float kLump = 250.0, kLumpHeight = 0.15, kLumpLight = 0.1;
const float kThin = 1.0, kThick = 4.6;  // optical depths of a ray: it sees through the cloud; it may have ended early
const float kPeak = 0.5;             // share of the sky in a thin cloud that comes from right behind it
const float kOutside = 0.5;          // share of the depth outside the outlines that is taken for clear, within 4 steps

float spacingAt(float t, MarchParams m) {
  return min(clamp(t * m.stepScale, m.minStep, m.maxStep), kEyeStep + kEyeGrowth * t);
}

// Radiance of the ground round the foot of a place, as much of it as clouds see.
vec3 groundUnder(vec2 p, vec3 sunLow, MarchParams m, Sky sky) {
  float direct = max(m.sun.z, 0.0) * exp(-kReduced * textureLod(uSun, placeBelow(p, uVolume), 0.0).x);
  vec2 below = skyBelow(p, sky);
  vec3 falling = sunLow * (direct + below.x) + skyOnGround(m.skyOpen.xyz, m.skyAround.xyz, below.y);
  return groundRadiance(falling, m.groundAlbedo.xyz, below.y);
}

MarchResult march(vec3 dir, float limit, vec3 sunLow, vec3 sunHigh, vec3 jitter, MarchParams m, Sky sky) {
  vec3 sun = m.sun.xyz, up = m.planet.up.xyz;
  RaySpan span = raySpan(dir, limit, m);
  float cosTheta = dot(dir, sun);
  float first = m.octaveGain * dropletPhase(cosTheta, m);
  // Its part that has no direction is in the light that is turned aside.
  float broad = phaseHenyeyGreenstein(cosTheta, 0.6) - phaseHenyeyGreenstein(-1.0, 0.6);
  vec3 ground = groundUnder(dir.xy * span.start, sunLow, m, sky);
  float inverseShell = 1.0 / (m.top - m.bottom);

  float t = span.start;
  float lastStep = spacingAt(t, m);
  t += jitter.x * lastStep;
  float fineLeft = 0.0, points = 0.0, samples = 0.0;
  float transmittance = 1.0;
  vec3 radiance = vec3(0.0);
  vec3 onceRadiance = vec3(0.0), turnedRadiance = vec3(0.0);  // of light that has been turned aside once, or often
  vec2 depth = vec2(0.0);  // weighted sum, weights

  for (int turn = 0; turn < m.maxTurns; ++turn) {
    // To the next point in cloud.
    vec3 q, found;
    float spacing;
    for (int search = 0; search < m.maxTurns; ++search) {
      bool skipped = false;
      for (int i = 0; i < kMostSkips; ++i) {
        if (t >= span.end) break;
        q = cloudSpace(dir * t, m.planet);
        float slope = (m.planet.up.w * dot(dir, up) + t) / (m.planet.radius + q.z);
        float clear = skyClearance(q, vec3(dir.xy, slope), sky);
        if (clear <= 0.0) break;
        t += min(clear, kFarthestSkip) + 0.5;
        skipped = true;
      }
      spacing = spacingAt(t, m);
      if (skipped) {
        lastStep = jitter.x * spacing;
        t += lastStep;
      }
      if (t >= span.end) break;
      q = cloudSpace(dir * t, m.planet);
      found = skyExtinction(q, max(t * m.footprintPerMetre, 0.5 * spacing), true, sky);
      samples += 1.0;
      bool fine = fineLeft > 0.5;
      if (found.x > 0.0) {
        if (fine || transmittance < 0.98 || m.refine == 0) break;
        // Found from outside: once more from the last clear point, by smaller steps.
        fineLeft = float(kFineSteps);
        t -= (1.0 - kFineStep * jitter.x) * lastStep;
      } else {
        lastStep = fine ? kFineStep * spacing : found.y <= 0.0 ? clamp(-kOutside * found.y, 1.8 * spacing, 4.0 * spacing) : spacing;
        fineLeft = max(fineLeft - 1.0, 0.0);
        t += lastStep;
      }
    }
    if (t >= span.end) break;

    // Toward the sun: near steps as far as the volume's cells are wide, the wider the more of them, each with a place of
    // its own for every point anew.
    vec4 level = lightVolumeLevel(q, sky.dither, uVolume);
    int steps = m.lightSteps + int(level.w);
    float way = 0.0, tau = 0.0;
    float step_ = m.nearReach * lightVolumeCoarseness(level, uVolume) * (m.lightRatio - 1.0) /
                  (pow(m.lightRatio, float(steps)) - 1.0);
    for (int k = 0; k < steps; ++k) {
      float within = fract(jitter.y + 0.61803399 * float(k) + 0.38196601 * points);
      vec3 at = cloudSpace(dir * t + sun * (way + step_ * within), m.planet);
      tau += step_ * skyExtinction(at, max(t * m.footprintPerMetre, max(0.5 * spacing, 0.3 * step_)), true, sky).x;
      samples += 1.0;
      way += step_;
      step_ *= m.lightRatio;
    }
    tau += sunDepthIn(level, cloudSpace(dir * t + sun * way, m.planet), uVolume, uSun);
    // The light that comes toward the eye has set out deeper inside, after the path on which it forgets its direction. A
    // path that is long, in fog, may end beyond the cloud, and would draw its end as an edge: then it is a random one.
    float free = -log(1.0 - fract(jitter.x + 0.61803399 * points));
    float path = m.transportPath * mix(1.0, free, smoothstep(kShortPath, kLongPath, m.transportPath));
    vec3 deeper = lightVolumePlace(level, cloudSpace(dir * (t + path), m.planet), uVolume);
    vec2 spread = textureLod(uDiffuse, deeper, 0.0).xy;

    vec3 sunlight = mix(sunLow, sunHigh, clamp((q.z - m.bottom) * inverseShell, 0.0, 1.0));
    float thick = tau * (1.0 + m.rainAbsorption * found.z / max(found.x, 1e-9));
    float powder = mix(1.0, 1.0 - exp(-2.0 * tau), m.sun.w);
    // What has been scattered forward goes on in nearly the same direction, the rest spreads.
    float straight = exp(-thick), forward = exp(-kReduced * thick);
    // A lump of cloud smaller than the cells keeps more light than they know of.
    float lump = 1.0 - exp(-kReduced * min(kLump, kLumpHeight / inverseShell) * found.x);
    float within = min(0.5 * (lightVolumeCoarseness(level, uVolume) - 1.0), 1.0);
    spread.x = max(spread.x, kLumpLight * within * lump * forward);
    // Light that has been turned aside once comes from that path too, on which it falls with the depth toward the sun;
    // where little light has lost its direction the cloud is too thin for it.
    float here = textureLod(uSun, lightVolumePlace(level, q, uVolume), 0.0).x;
    float falls = kReduced * (textureLod(uSun, deeper, 0.0).x - here) * (m.transportPath / path);
    float once = m.once * forward * min(10.0 * spread.x, 1.0) / max(1.0 + falls, 0.5);
    vec3 source = sunlight * ((first * straight + broad * (forward - straight)) * powder);
    vec3 turned = sunlight * (spread.x * 0.318309886);
    turned += m.ambientSky.xyz * (m.ambientSky.w * spread.y);
    turned += ground * (m.ambientGround.w * (1.0 - spread.y));
#ifdef LIGHTNING
    source += skyLightning(q, sky);
#endif
    float stride = spacing * (fineLeft > 0.5 ? kFineStep : 1.0);
    float kept = exp(-found.x * stride);
    float weight = transmittance * (1.0 - kept);
    radiance += source * (weight * m.skyIrradiance.w);
    onceRadiance += sunlight * (once * 0.318309886 * weight * m.skyIrradiance.w);
    turnedRadiance += turned * (weight * m.skyIrradiance.w);
    depth += weight * vec2(t, 1.0);
    transmittance *= kept;
    points += 1.0;
    t += stride;
    lastStep = stride;
    fineLeft = max(fineLeft - 1.0, 0.0);
    if (transmittance < m.earlyExit) break;
  }

  // Of what a thin cloud takes out of a ray only a part has lost its direction; for the rest comes what stands behind,
  // blurred by the forward peak. Light that has been turned aside once is not yet told from single scattering before the
  // third.
  float whole = -log(max(transmittance, 1e-6));
  float opaque = smoothstep(kThin, kThick, whole);
  float lost = mix((1.0 - exp(-kReduced * whole)) / max(1.0 - transmittance, 1e-6), 1.0, opaque);
  float thrice = mix(1.0 - transmittance * (1.0 + whole * (1.0 + 0.5 * whole)), 1.0, opaque);
  vec3 above = mix(m.ambientSky.xyz, lookupSky(uSkyView, uAir, dir), kPeak) * m.ambientSky.w;
  vec3 behind = mix(ground * m.ambientGround.w, above, smoothstep(-0.3, 0.3, dot(dir, up)));

  MarchResult r;
  r.radiance = radiance + lost * (turnedRadiance + thrice * onceRadiance) + (1.0 - lost) * depth.y * m.skyIrradiance.w * behind;
  r.transmittance = transmittance < m.earlyExit ? 0.0 : transmittance;
  r.depth = depth.y > 1e-4 ? depth.x / depth.y : m.maxDistance;
  // What has been scattered forward arrives nearly from where it came.
  r.ground = span.drawGround ? exp(-kReduced * skySunDepth(cloudSpace(dir * span.ground, m.planet), sky)) : -1.0;
  r.groundDepth = span.ground;
  r.samples = samples;
  return r;
}
