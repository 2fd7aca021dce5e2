// The light volume: what a lattice round the camera knows of light inside the clouds, in clip levels, one on top of the
// other in volume textures. One holds the optical depth toward the sun; the other how much light without direction there
// is (x: of the sun's, y: of the sky's), by diffusion.
//
// Diffusion: light that is scattered forward (g = .86) goes on as if nothing had happened; the rest, a share 1 - g of the
// extinction, has forgotten its direction and spreads like heat. `u` is a quarter of the fluence of an irradiance of 1, so
// that u / pi is the mean radiance. In units of flux, two surfaces are separated by a resistance of 3/4 of the reduced
// optical depth between them and 1/2 at each boundary, which makes the transmittance of a slab 1 / (1 + 3/4 (1 - g) tau),
// as in two-stream theory (Eddington's).

struct LightVolumeParams {
  ClipParams levels;
  float bottom, inverseHeight;  // of the shell that it fills, m
  float slices, inverseDepth;   // slices of a level; 1 / slices of all
  vec4 shift;                   // xy: way of the sunlight across from one slice to the next, m; z: 1 / planet's radius; w: cells
                                // across a level
};

const float kReduced = 0.14f;  // share of the extinction that makes light forget where it came from
// The same of the sun's, on the way to where it begins to spread: fitted to the path tracer between that, 1 - g, and the
// 1 - g^2 = .26 of delta-Eddington theory, whose spreading light still prefers its old direction.
const float kSpreading = 0.16f;

const float kClearing = 800.0f;  // m: air is taken for clear where light goes so far before it meets a droplet

// The finest level that holds q: how its texture coordinates follow from a place (x: scale, yz: offset), w: its number.
FN Vec4 lightVolumeLevel(IN(Vec3) q, IN(Real) dither, IN(LightVolumeParams) v) {
  Vec3 place = weatherPlace(v.levels, Vec2(q.x, q.y), dither);
  Real scale = levelScale(v.levels, place.z);
  return Vec4(scale, place.x - q.x * scale, place.y - q.y * scale, place.z);
}

// Width of its cells against those of the finest.
FN Real lightVolumeCoarseness(IN(Vec4) level, IN(LightVolumeParams) v) {
  return v.levels.level0.inverseSize / level.x;
}

// Where the volume holds what that level knows of q.
FN Vec3 lightVolumePlace(IN(Vec4) level, IN(Vec3) q, IN(LightVolumeParams) v) {
  Real slice = clamp((q.z - v.bottom) * v.inverseHeight * v.slices, 0.5f, v.slices - 0.5f);
  return Vec3(q.x * level.x + level.y, q.y * level.x + level.z, (level.w * v.slices + slice) * v.inverseDepth);
}

// Optical depth toward the sun. Between slices the light runs aslant, and so does the interpolation, by a cell at most:
// straight up it would mix the shadows of two slices side by side.
FN Real sunDepthIn(IN(Vec4) level, IN(Vec3) q, IN(LightVolumeParams) v, IN(Sampler3) sun) {
  Real at = (q.z - v.bottom) * v.inverseHeight * v.slices - 0.5f;
  Real slice = clamp(at, 0.0f, v.slices - 1.0f);
  Real below = floor(slice);
  Real share = slice - below;
  Vec2 place = Vec2(q.x * level.x + level.y, q.y * level.x + level.z);
  Vec2 shift = Vec2(v.shift.x, v.shift.y) * level.x;
  Vec2 scale = shift * min(1.0f / max(length(shift) * v.shift.w, 1e-6f), 1.0f);
  Real first = level.w * v.slices + below + 0.5f;
  Vec2 low = place - scale * share;
  Vec2 high = place + scale * (1.0f - share);
  Real a = sample3(sun, Vec3(low.x, low.y, first * v.inverseDepth)).x;
  Real b = sample3(sun, Vec3(high.x, high.y, min(first + 1.0f, (level.w + 1.0f) * v.slices - 0.5f) * v.inverseDepth)).x;
  return mix(a, b, share);
}

// From anywhere: from below the way is followed up to the lowest slice.
FN Real lookupSunDepth(IN(Vec3) q, IN(Real) dither, IN(LightVolumeParams) v, IN(Sampler3) sun) {
  Real down = max(0.5f - (q.z - v.bottom) * v.inverseHeight * v.slices, 0.0f);
  Vec3 above = Vec3(q.x + v.shift.x * down, q.y + v.shift.y * down, q.z);
  return sunDepthIn(lightVolumeLevel(above, dither, v), above, v, sun);
}

// Where the coarsest level knows what comes out of the clouds below.
FN Vec3 placeBelow(IN(Vec2) p, IN(LightVolumeParams) v) {
  float last = float(v.levels.count) - 1.0f;
  ClipLevel level = v.levels.level2;
  if (v.levels.count > 3) level = v.levels.level3;
  return Vec3(p.x * level.inverseSize + level.offsetX, p.y * level.inverseSize + level.offsetY,
              Real((last * v.slices + 0.5f) * v.inverseDepth));
}

// The light that comes down on what lies below the clouds, without direction, per irradiance of the sun and per radiance of
// the sky times pi: x, y of a place in `below` (shaders/light_ground.frag.glsl), a slice for each level.
FN Vec2 belowIn(IN(Vec3) place, IN(LightVolumeParams) v, IN(Sampler3) below) {
  return 2.0f * xy(sample3(below, Vec3(place.x, place.y, (place.z + 0.5f) / float(v.levels.count))));
}

// On the ground.
FN Vec2 lookupBelow(IN(Vec2) p, IN(LightVolumeParams) v, IN(Sampler3) below) {
  return belowIn(weatherPlace(v.levels, p, Real(0.5f)), v, below);
}

// In the air, which is lit from all sides: a mean over the wide squares of the coarsest level.
FN Vec2 lookupBelowAir(IN(Vec2) p, IN(LightVolumeParams) v, IN(Sampler3) below) {
  Vec3 place = placeBelow(p, v);
  return belowIn(Vec3(place.x, place.y, Real(float(v.levels.count) - 1.0f)), v, below);
}

// Light of the sky on level ground, klx, when clouds leave the share `open` of it: `clear`, weighed by the cosine, where
// they leave all, and the more like `around`, its mean radiance, the less they leave, since what they leave is low.
FN Vec3 skyOnGround(IN(Vec3) clear, IN(Vec3) around, IN(Real) open) {
  return open * mix(3.14159265f * around, clear, open);
}

// Radiance of ground on which so much light falls from above, klx, when the share `open` of the light that it sends up does
// not come back from the clouds: the same share that these let through of the sky's.
FN Vec3 groundRadiance(IN(Vec3) falling, IN(Vec3) albedo, IN(Real) open) {
  return albedo * falling / (Vec3(1.0f) - albedo * (1.0f - open)) * 0.318309886f;
}

// How freely light passes from a cell of extinction `own` (1/m) to its neighbour of `other`, `h` m away (x), and through
// what is clear of the neighbour to the surroundings (y); per m. Light that leaves a dense cell has not come from its
// middle, but from within a transport path of its surface.
FN Vec2 exchange(IN(Real) own, IN(Real) other, IN(float) h) {
  float half_ = 0.375f * kReduced * h;
  Real clear = exp(-kClearing * other);
  return Vec2((1.0f - clear) / ((own + other) * half_ + 0.02f), clear / (own * half_ + 0.5f)) / h;
}
