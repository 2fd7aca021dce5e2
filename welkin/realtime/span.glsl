// What both marches (march.glsl, shaders/march_volume.glsl) begin and end with.

struct MarchResult {
  Vec3 radiance;      // light that the clouds send, without the air in between
  Real transmittance;
  Real depth;         // opacity-weighted mean distance, m; maxDistance where there is no cloud
  Real ground;        // share of sunlight that reaches the ground where the ray meets it; -1 where it does not
  Real groundDepth;   // distance of that point
  Real samples;       // density samples taken
};

// Phase function of light that cloud droplets scatter for the first time, 1/sr.
FN Real dropletPhase(IN(Real) cosTheta, IN(MarchParams) m) {
  MiePhase droplets;
  droplets.gHG = m.droplets.x;
  droplets.gDraine = m.droplets.y;
  droplets.alpha = m.droplets.z;
  droplets.wDraine = m.droplets.w;
  Real lobes = mix(phaseHenyeyGreenstein(cosTheta, Real(m.forwardG)), phaseHenyeyGreenstein(cosTheta, Real(m.backwardG)),
                   Real(m.backwardWeight));
  return m.useDroplets != 0 ? phaseMie(cosTheta, droplets) : lobes;
}

// The part of a ray that may meet clouds, and where it meets the ground (1e9 where it does not); m.
struct RaySpan {
  Real start, end, ground;
  Mask drawGround;  // whether it meets the ground before `limit`, and there is one to draw
};

FN RaySpan raySpan(IN(Vec3) dir, IN(Real) limit, IN(MarchParams) m) {
  Vec2 outer = crossings(dir, m.top, m.planet);
  Vec2 inner = crossings(dir, m.bottom, m.planet);
  Vec2 surface = crossings(dir, 0.0f, m.planet);
  Mask hitsGround = surface.x > 0.0f;
  RaySpan s;
  s.ground = select(hitsGround, surface.x, Real(1e9f));
  s.start = max(outer.x, 0.0f);
  s.end = outer.y;
  if (m.planet.altitude < m.bottom) {
    s.start = inner.y;
  } else {
    s.end = select(inner.x > 0.0f, min(s.end, inner.x), s.end);
  }
  s.end = min(min(s.end, min(s.ground, limit)), m.maxDistance);
  s.drawGround = both(both(hitsGround, s.ground <= limit), toMask(m.groundAlbedo.w > 0.0f));
  return s;
}
