// How much of the air before the eye clouds shade: its mean over eight segments of a ray, each as long as all before it
// but the first. A coarse picture of the view holds them (shaders/air_shade.frag.glsl), so that shafts of light and shade
// are smooth where samples of each pixel's own would be grain.

struct AirShade {
  Vec4 near, far;  // the first four segments, the others
};

// Far away few rows of that picture lie between what is below the clouds and what is above them. So the segments from
// kShadeFar on hold the shade below the middle of the clouds' shell, sampled no higher than that, for which each ray
// knows its own way: above it their air counts as sunlit.
const int kShadeFar = 5;

const float kShadeFirst = 500.0f;  // m, the first segment's end; the last one's is 64 km

// Altitude below which they do, m.
FN float shadeAltitude(IN(float) bottom, IN(float) top) { return bottom + 0.15f * (top - bottom); }
// From where to where the ray along the unit vector `dir` is below an altitude, m.
FN Vec2 wayBelow(IN(Vec3) dir, IN(float) altitude, IN(PlanetParams) planet) {
  Vec2 way = crossings(dir, altitude, planet);
  return Vec2(max(way.x, 0.0f), max(way.y, 0.0f));
}
FN Vec2 wayInShade(IN(Vec3) dir, IN(float) bottom, IN(float) top, IN(PlanetParams) planet) {
  return wayBelow(dir, shadeAltitude(bottom, top), planet);
}

// What a metre of air takes of the light, from what `distance` m let through.
FN Real lossOf(IN(Vec3) through, IN(Real) distance) {
  return -log(clamp(through.y, 1e-4f, 1.0f)) / max(distance, 1.0f);
}

// Share of the light that a segment from `start` to `end` m scatters toward the eye, each metre taking `loss` of it.
FN Real segmentLight(IN(Real) start, IN(Real) end, IN(Real) distance, IN(Real) loss) {
  return exp(-loss * min(start, distance)) - exp(-loss * min(end, distance));
}

// The same of its part on the way from `way.x` to `way.y`.
FN Real segmentLightOn(IN(float) start, IN(float) end, IN(Real) distance, IN(Real) loss, IN(Vec2) way) {
  return segmentLight(clamp(Real(start), way.x, way.y), clamp(Real(end), way.x, way.y), distance, loss);
}

// Share of the air's light on the way to `distance` that is scattered in shade; `way` is wayInShade().
FN Real shadeBefore(IN(AirShade) s, IN(Real) distance, IN(Real) loss, IN(Vec2) way) {
  const float f = kShadeFirst;
  Real dark = segmentLight(0.0f, f, distance, loss) * s.near.x;
  dark += segmentLight(f, 2.0f * f, distance, loss) * s.near.y;
  dark += segmentLight(2.0f * f, 4.0f * f, distance, loss) * s.near.z;
  dark += segmentLight(4.0f * f, 8.0f * f, distance, loss) * s.near.w;
  dark += segmentLight(8.0f * f, 16.0f * f, distance, loss) * s.far.x;
  dark += segmentLightOn(16.0f * f, 32.0f * f, distance, loss, way) * s.far.y;
  dark += segmentLightOn(32.0f * f, 64.0f * f, distance, loss, way) * s.far.z;
  dark += segmentLightOn(64.0f * f, 1e8f, distance, loss, way) * s.far.w;
  return min(dark / max(1.0f - exp(-loss * distance), 1e-6f), Real(1.0f));
}
