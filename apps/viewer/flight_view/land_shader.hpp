#pragma once
// What land and sea look like. Follows Renderer::hostShader(), whose functions it calls.

namespace welkin::viewer {

inline constexpr const char* kLandVertex = R"(
uniform sampler2D uLevel;
uniform vec4 uCorner;  // of the level from the eye; size of a cell, m; 1 where a coarser level follows
uniform mat4 uClipFromEye;
uniform float uEyeHeight;
out vec3 vFromEye;
out vec2 vPlace;  // from the eye
out float vBlend;
const int kCells = 128;
float heightAt(ivec2 ij) { return max(texelFetch(uLevel, 2 * ij, 0).r, 0.0); }
void main() {
  ivec2 ij = ivec2(gl_VertexID % (kCells + 1), gl_VertexID / (kCells + 1));
  vPlace = uCorner.xy + vec2(ij) * uCorner.z;
  // Toward the edge the land takes the shape of the next level.
  float away = max(abs(vPlace.x), abs(vPlace.y)) / uCorner.z;
  vBlend = clamp((away - 50.0) / 12.0, 0.0, 1.0) * uCorner.w;
  ivec2 odd = ij & 1;
  float height = heightAt(ij);
  if (vBlend > 0.0 && odd != ivec2(0)) {
    ivec2 aside = ivec2(odd.x, -odd.y);
    height = mix(height, 0.5 * (heightAt(ij + aside) + heightAt(ij - aside)), vBlend);
  }
  vFromEye = vec3(vPlace, height - uEyeHeight - dot(vPlace, vPlace) / 12720000.0);
  gl_Position = uClipFromEye * vec4(vFromEye, 1.0);
}
)";

inline constexpr const char* kLandFragment = R"(
in vec3 vFromEye;
in vec2 vPlace;
in float vBlend;
uniform sampler2D uLevel;
uniform sampler2D uCoarser;
uniform vec4 uCorner;
uniform vec3 uCoarseCorner;
uniform vec4 uHole;
uniform vec2 uEyePlace;   // east and north of the eye, m
uniform float uPixel;     // rad
uniform float uExposure;
uniform float uTime;      // s, of the waves
uniform vec4 uRunway;     // sine and cosine of its heading, half its length, half its width
uniform vec2 uWind;       // m/s
uniform mat3 uBodyFromWorld;
uniform vec3 uAircraft;   // from the eye
out vec4 oColour;

const float kPi = 3.14159265;

vec4 landAt(sampler2D level, vec2 corner, float cell) {
  return textureLod(level, ((vPlace - corner) / (0.5 * cell) + 0.5) / vec2(textureSize(level, 0)), 0.0);
}

// Octaves that the level's texture is too coarse for, down to the pixel: slopes and value. `finest` is the length at
// which the texture ends, and grows with distance.
vec3 details(vec2 p, float finest, float pixel) {
  float lod = log2(finest);
  float whole = floor(lod), part = lod - whole;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    float size = exp2(whole + 1.0 - float(k));
    float weight = smoothstep(1.5, 4.0, size / pixel) * (k == 0 ? part : k == 3 ? 1.0 - part : 1.0);
    if (weight <= 0.0) continue;
    vec2 q = p / size;
    vec2 cell = floor(q);
    sum += weight * perlin2SlopeAt(ivec2(cell), q - cell, 0, uint(40 + int(whole) - k));
  }
  return sum;
}

float random2(vec2 cell) { return unitFromHash(hashCell2(int(cell.x), int(cell.y), 9u)); }

// Fields: rows of parcels, turned a little from one square mile to the next.
vec3 fields(vec2 p, float pixel) {
  vec2 mile = floor(p / 1700.0);
  float turn = 1.5 * random2(mile);
  vec2 q = mat2(cos(turn), -sin(turn), sin(turn), cos(turn)) * (p - 1700.0 * mile);
  vec2 size = mix(vec2(150.0, 90.0), vec2(420.0, 240.0), vec2(random2(mile + 31.0), random2(mile + 57.0)));
  q.x += size.x * random2(vec2(floor(q.y / size.y), mile.x + 91.0));
  vec2 cell = floor(q / size);
  float a = random2(cell + 17.0 * mile), b = random2(cell.yx + 29.0 * mile + 5.0);
  vec3 meadow = vec3(0.055, 0.088, 0.026), stubble = vec3(0.2, 0.165, 0.075), corn = vec3(0.075, 0.1, 0.03);
  vec3 earth = vec3(0.125, 0.09, 0.06);
  vec3 colour = a < 0.45 ? meadow : a < 0.68 ? corn : a < 0.87 ? stubble : earth;
  colour *= 0.8 + 0.4 * b;
  vec2 edge = min(fract(q / size), 1.0 - fract(q / size)) * size;
  float hedge = 1.0 - smoothstep(3.0, 5.0 + pixel, min(edge.x, edge.y));
  colour = mix(colour, vec3(0.03, 0.045, 0.018), 0.8 * hedge * clamp(6.0 / pixel, 0.0, 1.0));
  return mix(colour, vec3(0.095, 0.1, 0.04), smoothstep(60.0, 300.0, pixel));
}

// Share of paint on the runway; `at` along and to the right of its middle, m.
float markings(vec2 at, vec2 half_, float pixel) {
  vec2 a = abs(at);
  float along = half_.x - a.x;
  float soft = max(pixel, 0.05);
  float line = 0.0;
  float dash = step(fract(at.x / 60.0), 0.55) * step(70.0, along);
  line = max(line, dash * clamp((0.5 + soft - a.y) / soft, 0.0, 1.0) * min(1.0, 1.0 / soft));
  float side = clamp((0.45 + 0.5 * soft - abs(a.y - half_.y + 1.2)) / soft, 0.0, 1.0) * min(1.0, 0.9 / soft);
  line = max(line, side);
  float bars = step(fract(a.y / 3.4), 0.53) * step(2.0, a.y) * step(a.y, half_.y - 2.5);
  line = max(line, mix(bars, 0.5, clamp(pixel - 0.8, 0.0, 1.0)) * step(6.0, along) * step(along, 36.0));
  float aim = step(300.0, along) * step(along, 345.0) * step(4.0, a.y) * step(a.y, 9.0);
  return max(line, aim);
}

// How much of the sun the aircraft leaves to a point: wing, body and tail as soft plates.
float aircraftShade(vec3 toSun) {
  vec3 from = uBodyFromWorld * (vFromEye - uAircraft), dir = uBodyFromWorld * toSun;
  if (abs(dir.z) < 0.05) return 1.0;
  float soft = 0.15 + 0.009 * length(from);  // the sun is half a degree wide
  vec3 wing = from + dir * ((-1.0 - from.z) / dir.z), low = from - dir * (from.z / dir.z);
  vec2 w = smoothstep(vec2(-soft), vec2(soft), vec2(0.8, 5.5) - abs(wing.xy - vec2(0.1, 0.0)));
  vec2 b = smoothstep(vec2(-soft), vec2(soft), vec2(3.9, 0.6) - abs(low.xy - vec2(-1.3, 0.0)));
  vec2 t = smoothstep(vec2(-soft), vec2(soft), vec2(0.5, 1.7) - abs(low.xy - vec2(-4.7, 0.0)));
  float ahead = dot(vFromEye - uAircraft, toSun) < 0.0 ? 1.0 : 0.0;
  return 1.0 - ahead * max(max(w.x * w.y, b.x * b.y), t.x * t.y);
}

// C. Cox and W. Munk 1954: mean square slope of a sea by wind; reflectance of a rough sea: E. Bruneton, F. Neyret and
// N. Holzschuch 2010, eq. 12.
vec3 seaColour(vec2 p, float distance_, float pixel, WelkinLight light, vec3 toEye) {
  float slopes = 0.003 + 0.00512 * (2.0 + length(uWind));
  vec3 wave = details(p + uTime * vec2(1.3, 0.4), max(6.0, 0.02 * distance_), pixel) +
              details(p * 1.7 - uTime * vec2(0.3, 1.1), max(4.0, 0.013 * distance_), pixel);
  // What is drawn as waves is no longer roughness.
  float shown = smoothstep(8.0, 0.5, pixel);
  vec3 normal = normalize(vec3(-0.08 * shown * wave.xy, 1.0));
  float spread = mix(slopes, 0.4 * slopes, shown);
  vec3 half_ = normalize(toEye + light.toSun);
  float nh = max(dot(normal, half_), 0.05), nv = max(dot(normal, toEye), 0.0), nl = max(dot(normal, light.toSun), 0.0);
  float tangent2 = (1.0 - nh * nh) / (nh * nh);
  float lobe = exp(-tangent2 / spread) / (kPi * spread * nh * nh * nh * nh);
  float mirror = 0.02 + 0.98 * pow(1.0 - max(dot(toEye, half_), 0.0), 5.0);
  float sigma = sqrt(slopes);
  float reflectance = 0.02 + 0.98 * pow(1.0 - nv, 5.0 * exp(-2.69 * sigma)) / (1.0 + 22.7 * pow(sigma, 1.5));
  vec3 water = vec3(0.0035, 0.014, 0.02) * (light.sun * nl + light.sky) / kPi;
  vec3 glitter = light.sun * (mirror * lobe * step(0.0, light.toSun.z) / (4.0 * max(nv, 0.06)));
  float foam = smoothstep(0.55, 0.8, wave.z) * smoothstep(6.0, 14.0, length(uWind)) * shown;
  water += 0.3 * foam * (light.sun * nl + light.sky) / kPi;
  return water * (1.0 - reflectance) + reflectance * light.sky / kPi + glitter;
}

void main() {
  if (vPlace.x > uHole.x && vPlace.y > uHole.y && vPlace.x < uHole.z && vPlace.y < uHole.w) discard;
  vec4 land = mix(landAt(uLevel, uCorner.xy, uCorner.z), landAt(uCoarser, uCoarseCorner.xy, uCoarseCorner.z), vBlend);
  float distance_ = length(vFromEye);
  vec3 toEye = -vFromEye / max(distance_, 1e-3);
  // Metres on the ground that a pixel covers: between across and along the view.
  float pixel = distance_ * uPixel / mix(1.0, max(abs(toEye.z), 0.1), 0.5);
  vec2 p = vPlace + uEyePlace;
  WelkinLight light = welkinLight(vFromEye);
  light.sun *= aircraftShade(light.toSun);
  vec3 radiance;
  float depth = -land.x;
  vec3 sea = vec3(0.0), ground = vec3(0.0);
  if (depth > -0.4) sea = seaColour(p, distance_, pixel, light, toEye);
  if (depth < 0.4) {
    vec3 detail = details(p, 14.0 * max(1.0, distance_ / 900.0), pixel);
    float steep = length(land.yz);
    float wild = smoothstep(0.12, 0.5, steep + land.x * 0.0001);
    vec2 at = vec2(dot(p, uRunway.xy), dot(p, vec2(uRunway.y, -uRunway.x)));
    float even = smoothstep(40.0, 250.0, max(abs(at.x) - uRunway.z, abs(at.y) - uRunway.w));
    vec3 normal = normalize(vec3(-land.yz - even * mix(0.035, 0.3, wild) * detail.xy, 1.0));
    float tree = land.w + 0.35 * detail.z;
    vec3 colour = fields(p, pixel) * (1.0 + 0.25 * detail.z);
    vec3 wood = vec3(0.024, 0.038, 0.015) * (1.0 + 0.5 * detail.z);
    vec3 grass = vec3(0.07, 0.085, 0.032) * (1.0 + 0.35 * detail.z);
    vec3 heath = vec3(0.105, 0.095, 0.055) * (1.0 + 0.35 * detail.z);
    colour = mix(colour, grass, smoothstep(0.05, 0.16, steep + 0.03 * detail.z) * 0.9);
    float high = land.x + 260.0 * detail.z;
    colour = mix(colour, wood,
                 smoothstep(0.1, 0.22, tree + 0.5 * smoothstep(0.05, 0.25, steep)) * smoothstep(1500.0, 1050.0, high) *
                     smoothstep(0.75, 0.5, steep) * even * smoothstep(3.0, 9.0, land.x));
    colour = mix(colour, heath, smoothstep(1000.0, 1500.0, high));
    vec3 rock = mix(vec3(0.13, 0.12, 0.11), vec3(0.2, 0.185, 0.165), 0.5 + 0.7 * detail.z);
    colour = mix(colour, rock, smoothstep(0.55, 0.85, steep + 0.22 * detail.z));
    colour = mix(colour, vec3(0.78, 0.8, 0.84),
                 smoothstep(1650.0, 1900.0, high) * smoothstep(0.95, 0.65, steep + 0.15 * detail.z));
    colour = mix(vec3(0.3, 0.26, 0.19), colour, smoothstep(1.5, 4.0, land.x + 1.5 * detail.z));
    colour = mix(vec3(0.075, 0.095, 0.035) * (1.0 + 0.2 * detail.z), colour, even);
    vec2 paved = smoothstep(vec2(0.5 * pixel), vec2(-0.5 * pixel), abs(at) - uRunway.zw);
    float old = 0.9 + 0.25 * detail.z - 0.25 * smoothstep(9.0, 2.0, abs(abs(at.y) - 3.5)) *
                                           smoothstep(250.0, 400.0, abs(at.x)) * smoothstep(700.0, 500.0, abs(at.x));
    vec3 tarmac = mix(vec3(0.09, 0.088, 0.085) * old, vec3(0.55), markings(at, uRunway.zw, pixel));
    colour = mix(colour, tarmac, paved.x * paved.y);
    vec3 irradiance = light.sun * max(dot(normal, light.toSun), 0.0) + light.sky * (0.5 + 0.5 * normal.z);
    ground = max(colour, vec3(0.0)) * irradiance / kPi;
  }
  radiance = mix(ground, sea, smoothstep(-0.4, 0.4, depth));
  WelkinFront air = welkinAir(vFromEye);
  oColour = vec4(radiance * uExposure * air.through + air.light, 1.0);
}
)";

}  // namespace welkin::viewer
