// What stands in the sky at night: the moon's disc, a field of stars, the Milky Way. All as seen from outside the air, in
// kcd/m^2. The stars are made up, as many and as bright as the real ones; the moon's seas and the band of the Milky Way
// lie where the real ones do.

// Filled by nightParams.
struct NightParams {
  vec4 moon;        // xyz unit vector toward the moon, w its angular radius (rad); a radius of 0 stands for no moon
  vec4 moonRight;   // xyz unit vector on the sky to the right of the moon's north, w its light that the Earth sends back
                    // against the sun's
  vec4 moonUp;      // xyz unit vector on the sky toward the moon's north
  vec4 moonToSun;   // xyz unit vector from the moon toward the sun
  vec4 moonLight;   // xyz radiance of a sunlit point of reflectance 1 (kcd/m^2)
  vec4 skyX, skyY, skyZ;  // xyz axes of the stars (z to the celestial pole), in local axes
  vec4 galaxyPole, galaxyCentre;  // xyz unit vectors in the stars' axes
  float stars, milkyWay;          // light, as multiples
  float pad0, pad1;
};

// PCG (O'Neill 2014), as in noise/hash.glsl, which this room does not know.
FN Uint nightHash(IN(Uint) x) {
  Uint state = x * 747796405u + 2891336453u;
  Uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
FN Uint nightCell(IN(Int) x, IN(Int) y, IN(Int) z) {
  return nightHash(toUint(x) + nightHash(toUint(y) + nightHash(toUint(z) + 0x51ED27u)));
}
FN Real nightUnit(IN(Uint) h) { return toReal(h >> 8u) * 5.9604644775390625e-8f; }

// How much darker a sea of the moon makes a point `n` of its surface: a soft spot round `middle` of cosine `edge`.
FN Real mare(IN(Vec3) n, float x, float y, float z, float edge) {
  return smoothstep(edge - 0.03f, edge + 0.03f, n.x * x + n.y * y + n.z * z);
}

// Reflectance of the moon's surface against that of the highlands: x to lunar east, y north, z toward the Earth. Places
// and sizes of the larger seas after the IAU's gazetteer.
FN Real moonSurface(IN(Vec3) n) {
  Real seas = mare(n, -0.226f, 0.542f, 0.809f, 0.95f) + mare(n, 0.266f, 0.469f, 0.842f, 0.985f) +
              mare(n, 0.515f, 0.148f, 0.844f, 0.972f) + mare(n, 0.820f, 0.292f, 0.492f, 0.992f) +
              mare(n, 0.773f, -0.136f, 0.620f, 0.977f) + mare(n, -0.266f, -0.363f, 0.893f, 0.98f) +
              mare(n, -0.568f, -0.413f, 0.712f, 0.993f) + mare(n, -0.799f, 0.316f, 0.511f, 0.92f) +
              mare(n, 0.561f, -0.262f, 0.785f, 0.995f);
  return 1.0f - 0.42f * min(seas, 1.0f);
}

// The moon's disc, its edge smooth over `pixel` radians. Light from its dust by the law of Lommel and Seeliger, which
// makes a full moon even up to its edge; the dark side in the light of the Earth.
FN Vec3 moonDisc(IN(NightParams) night, IN(Vec3) direction, IN(Real) pixel) {
  Vec3 moon = Vec3(night.moon.x, night.moon.y, night.moon.z);
  Vec3 right = Vec3(night.moonRight.x, night.moonRight.y, night.moonRight.z);
  Vec3 above = Vec3(night.moonUp.x, night.moonUp.y, night.moonUp.z);
  Vec3 toSun = Vec3(night.moonToSun.x, night.moonToSun.y, night.moonToSun.z);
  float radius = max(night.moon.w, 1e-6f);
  Vec3 offset = direction - moon;
  Real distance = length(offset);
  Real x = dot(offset, right) * (1.0f / radius);
  Real y = dot(offset, above) * (1.0f / radius);
  Real z = sqrt(max(1.0f - x * x - y * y, 0.0f));
  Vec3 normal = right * x + above * y - moon * z;
  Real sunCosine = max(dot(normal, toSun), 0.0f);
  // At the edge both cosines vanish; their ratio does not.
  Real lit = sunCosine / max(sunCosine + z, 1e-3f);
  Real edge = saturate((radius - distance) / max(pixel, 1e-5f) + 0.5f);
  if (night.moon.w <= 0.0f) edge = Real(0.0f);
  return xyz(night.moonLight) * (moonSurface(Vec3(x, y, z)) * (lit + night.moonRight.w) * edge);
}

const float kStarCells = 48.0f;     // cells of space to the radius of the sphere that stars lie on
const float kStarShell = 0.25f;     // half thickness of the shell of points that become stars: 14,000 in all
const float kStarReach = 0.005f;    // rad, the largest spot: the eight cells looked at hold every star that near
const float kFaintest = 7.0f;       // magnitude
const float kStarSlope = 0.51f;     // of the logarithm of counts by magnitude, near the sixth

// Colour of a star of luminance 1, red for t = 0 to blue for 1: black bodies of 3500 to 12000 K.
FN Vec3 starColour(IN(Real) t) {
  Vec3 warm = mix(Vec3(1.62f, 0.87f, 0.46f), Vec3(1.02f, 0.99f, 1.03f), saturate(2.0f * t));
  return mix(warm, Vec3(0.80f, 1.02f, 1.38f), saturate(2.0f * t - 1.0f));
}

// Light of the star in one cell, if there is one, at `place` on the sphere of radius kStarCells, spread over a spot of
// `reach` radians that carries all of it (klx over sr).
FN Vec3 starInCell(IN(Vec3) place, IN(Vec3) cell, IN(Real) reach) {
  Uint h = nightCell(toInt(cell.x), toInt(cell.y), toInt(cell.z));
  Real x = cell.x + nightUnit(h);
  h = nightHash(h + 1u);
  Real y = cell.y + nightUnit(h);
  h = nightHash(h + 1u);
  Real z = cell.z + nightUnit(h);
  h = nightHash(h + 1u);
  Real rank = max(nightUnit(h), 1e-5f);
  h = nightHash(h + 1u);
  Vec3 star = Vec3(x, y, z);
  Real far = length(star);
  Vec3 offset = place * (1.0f / kStarCells) - star * (1.0f / max(far, 1e-3f));
  Real d = saturate(1.0f - dot(offset, offset) / (reach * reach));
  // Magnitude 0 is 2.54e-6 lx; counts grow tenfold in 1 / kStarSlope magnitudes. None is brighter than -1.5.
  Real magnitude = max(kFaintest + log2(rank) * (0.30103f / kStarSlope), -1.5f);
  // Points leave the shell by a thin border rather than a step, which rounding would move.
  Real light = 2.54e-9f * exp2(-1.328771f * magnitude) * saturate(50.0f * (kStarShell - abs(far - kStarCells)));
  return starColour(nightUnit(h)) * (light * d * d * 0.954929659f / (reach * reach));
}

// The stars toward a direction in their own axes, each as a soft spot about a pixel wide whatever the pixel, of an energy
// that does not depend on it.
FN Vec3 starField(IN(Vec3) direction, IN(Real) pixel) {
  Real reach = clamp(1.25f * pixel, Real(2e-5f), Real(kStarReach));
  Vec3 place = direction * kStarCells;
  Vec3 low = floor(place - Vec3(0.5f));
  Vec3 sum = starInCell(place, low, reach);
  sum += starInCell(place, low + Vec3(1.0f, 0.0f, 0.0f), reach);
  sum += starInCell(place, low + Vec3(0.0f, 1.0f, 0.0f), reach);
  sum += starInCell(place, low + Vec3(1.0f, 1.0f, 0.0f), reach);
  sum += starInCell(place, low + Vec3(0.0f, 0.0f, 1.0f), reach);
  sum += starInCell(place, low + Vec3(1.0f, 0.0f, 1.0f), reach);
  sum += starInCell(place, low + Vec3(0.0f, 1.0f, 1.0f), reach);
  return sum + starInCell(place, low + Vec3(1.0f, 1.0f, 1.0f), reach);
}

// Smooth noise in [0, 1] on a lattice of unit cells.
FN Real nightNoise(IN(Vec3) p) {
  Vec3 cell = floor(p);
  Vec3 f = p - cell;
  f = f * f * (Vec3(3.0f) - f * 2.0f);
  Int x = toInt(cell.x);
  Int y = toInt(cell.y);
  Int z = toInt(cell.z);
  Real a = mix(nightUnit(nightCell(x, y, z)), nightUnit(nightCell(x + 1, y, z)), f.x);
  Real b = mix(nightUnit(nightCell(x, y + 1, z)), nightUnit(nightCell(x + 1, y + 1, z)), f.x);
  Real c = mix(nightUnit(nightCell(x, y, z + 1)), nightUnit(nightCell(x + 1, y, z + 1)), f.x);
  Real d = mix(nightUnit(nightCell(x, y + 1, z + 1)), nightUnit(nightCell(x + 1, y + 1, z + 1)), f.x);
  return mix(mix(a, b, f.y), mix(c, d, f.y), f.z);
}

// The Milky Way's unresolved stars toward a direction in the stars' axes: a band of up to 4e-4 cd/m^2 in Cygnus and twice
// that at its bulge, parted by dust. From taste, within what photometry of the night sky gives (Leinert et al. 1998).
FN Vec3 milkyWay(IN(NightParams) night, IN(Vec3) direction) {
  Real height = dot(direction, xyz(night.galaxyPole));  // sine of galactic latitude
  Real toCentre = dot(direction, xyz(night.galaxyCentre));
  Real broad = nightNoise(direction * 7.0f);
  Real fine = 0.6f * nightNoise(direction * 17.0f) + 0.4f * nightNoise(direction * 41.0f);
  Real width = 0.11f + 0.05f * saturate(toCentre);
  Real across = height + 0.06f * (broad - 0.5f);
  Real band = exp(-across * across / (width * width));
  Real bulge = 0.75f + 1.25f * saturate(toCentre) * saturate(toCentre);
  Real lane = exp(-across * across / 0.0022f) * smoothstep(-0.4f, 0.5f, toCentre);
  Real dust = 1.0f - saturate(lane * (0.35f + 1.1f * fine));
  Real glow = 4e-7f * band * bulge * (0.45f + 0.9f * fine * (0.5f + broad)) * dust;
  return Vec3(1.02f, 0.99f, 1.04f) * glow;
}

// Stars and Milky Way toward a direction in local axes; none in front of the moon.
FN Vec3 starlight(IN(NightParams) night, IN(Vec3) direction, IN(Real) pixel) {
  Vec3 d = Vec3(dot(direction, xyz(night.skyX)), dot(direction, xyz(night.skyY)), dot(direction, xyz(night.skyZ)));
  Vec3 sum = starField(d, pixel) * night.stars + milkyWay(night, d) * night.milkyWay;
  return sum * step(night.moon.w, length(direction - xyz(night.moon)));
}
