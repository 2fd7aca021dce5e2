#pragma once
// Land and sea in two steps: first how far they are (kShape...), then once for each pixel what they look like. The
// software driver shades blocks of 4 x 4 pixels and all of a block for every triangle that touches it.

namespace welkin::viewer {

inline constexpr const char* kShapeVertex = R"(
uniform highp sampler2DArray uLand;  // of each level height, slopes to east and north, woods
uniform vec4 uCorner;  // of the level from the eye; size of a cell, m; how far it has taken the next one's shape throughout
uniform vec2 uLevel;   // its number; 1 where a coarser level follows
uniform mat4 uClipFromEye;
uniform float uEyeHeight;
uniform int uStep;     // from vertex to vertex, in cells
const int kCells = 128;
float heightAt(ivec2 ij) { return max(texelFetch(uLand, ivec3(2 * ij, int(uLevel.x + 0.5)), 0).r, 0.0); }
void main() {
  ivec2 ij = ivec2(gl_VertexID % (kCells + 1), gl_VertexID / (kCells + 1));
  vec2 place = uCorner.xy + vec2(ij) * uCorner.z;
  // Toward the edge the land takes the shape of the next level.
  float away = max(abs(place.x), abs(place.y)) / uCorner.z;
  float blend = max(clamp((away - 50.0) / 12.0, 0.0, 1.0) * uLevel.y, uCorner.w);
  ivec2 odd = uStep * ((ij / uStep) & 1);
  float height = heightAt(ij);
  if (blend > 0.0 && odd != ivec2(0)) {
    ivec2 aside = ivec2(odd.x, -odd.y);
    height = mix(height, 0.5 * (heightAt(ij + aside) + heightAt(ij - aside)), blend);
  }
  gl_Position = uClipFromEye * vec4(place, height - uEyeHeight - dot(place, place) / 12720000.0, 1.0);
}
)";

inline constexpr const char* kShapeFragment = R"(
layout(location = 0) out float oAlong;  // along the view, m
void main() { oAlong = 1.0 / gl_FragCoord.w; }
)";

inline constexpr const char* kLandVertex = R"(
uniform vec3 uForward, uRight, uAbove;  // rays through the picture's middle, and on to its edges
out vec3 vRay;
void main() {
  vec2 ndc = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2)) * 2.0 - 1.0;
  vRay = uForward + ndc.x * uRight + ndc.y * uAbove;
  gl_Position = vec4(ndc, 0.0, 1.0);
}
)";

// Follows Renderer::hostShader(), whose functions it calls. The defines LAND, SEA and CLOSE (land_mesh.hpp), and RAIN,
// put in what may show.
inline constexpr const char* kLandFragment = R"(
in vec3 vRay;
uniform highp sampler2D uAlong;
uniform highp sampler2DArray uLand;
uniform vec4 uCorners[9];  // of the levels, as in the first step
uniform vec3 uFirst;       // the finest that is drawn, the coarsest, a cell of level 0
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

vec4 landOf(int level, vec2 place) {
  vec4 corner = uCorners[level];
  vec2 uv = ((place - corner.xy) / (0.5 * corner.z) + 0.5) / vec2(textureSize(uLand, 0).xy);
  return textureLod(uLand, vec3(uv, float(level)), 0.0);
}

// Of the finest level there, and towards its edge of the next.
vec4 landAt(vec2 place) {
  float away = max(max(abs(place.x), abs(place.y)) / uFirst.z, 1.0);
  float level = clamp(ceil(log2(away / 62.0)), uFirst.x, uFirst.y);
  float next = min(level + 1.0, uFirst.y);
  float blend = clamp((away * exp2(-level) - 50.0) / 12.0, 0.0, 1.0);
  blend = max(blend, uCorners[int(level)].w);
  return mix(landOf(int(level), place), landOf(int(next), place), blend);
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
    if (size < 1.5 * pixel) break;  // those that follow are finer
    vec2 q = p / size;
    vec2 cell = floor(q);
    sum += weight * perlin2SlopeAt(ivec2(cell), q - cell, 0, uint(40 + int(whole) - k));
  }
  return sum;
}

#ifdef LAND
float random2(vec2 cell) { return unitFromHash(hashCell2(int(cell.x), int(cell.y), 9u)); }

// A parcel at q, which counts from the corner of its square mile, and how far its edges are.
vec3 parcel(vec2 q, vec2 size, vec2 mile, out vec2 edge) {
  q.x += size.x * random2(vec2(floor(q.y / size.y), mile.x + 91.0));
  vec2 cell = floor(q / size), within = q - cell * size;
  float a = random2(cell + 17.0 * mile), b = random2(cell.yx + 29.0 * mile + 5.0);
  vec3 meadow = vec3(0.055, 0.088, 0.026), stubble = vec3(0.2, 0.165, 0.075), corn = vec3(0.075, 0.1, 0.03);
  vec3 earth = vec3(0.125, 0.09, 0.06);
  edge = mix(-within, size - within, step(0.5 * size, within));
  return (a < 0.45 ? meadow : a < 0.68 ? corn : a < 0.87 ? stubble : earth) * (0.8 + 0.4 * b);
}

// Fields: rows of parcels, turned a little from one square mile to the next. Where miles meet a brook winds. An edge is as
// soft as the pixel is wide there, which covers `across` (from pixel to pixel, and from row to row).
vec3 fields(vec2 p, float pixel, mat2 across) {
  vec2 winding = p + 130.0 * (sin(p.yx / vec2(430.0, 390.0)) + 0.45 * sin(p.yx / vec2(167.0, 181.0) + 1.3));
  vec2 mile = floor(winding / 1700.0), within = fract(winding / 1700.0);
  float turn = 1.5 * random2(mile);
  mat2 turned = mat2(cos(turn), -sin(turn), sin(turn), cos(turn));
  vec2 q = turned * (p - 1700.0 * mile), edge, other;
  vec2 size = mix(vec2(150.0, 90.0), vec2(420.0, 240.0), vec2(random2(mile + 31.0), random2(mile + 57.0)));
  vec3 colour = parcel(q, size, mile, edge);
  mat2 reach = turned * across;
  vec2 wide = max(abs(reach[0]) + abs(reach[1]), vec2(1e-3)), share = clamp(0.5 - abs(edge) / wide, 0.0, 0.5);
  vec2 beyond = share.x > share.y ? vec2(edge.x + 0.01 * sign(edge.x), 0.0) : vec2(0.0, edge.y + 0.01 * sign(edge.y));
  colour = mix(colour, parcel(q + beyond, size, mile, other), max(share.x, share.y));
  float hedge = 1.0 - smoothstep(3.0, 5.0 + pixel, min(abs(edge.x), abs(edge.y)));
  vec2 toBrook = min(within, 1.0 - within) * 1700.0;
  hedge = max(hedge, 1.0 - smoothstep(6.0, 11.0 + pixel, min(toBrook.x, toBrook.y)));
  colour = mix(colour, vec3(0.03, 0.045, 0.018), 0.8 * hedge * clamp(6.0 / pixel, 0.0, 1.0));
  float coarse = max(pixel, 0.5 * max(wide.x, wide.y));
  return mix(colour, vec3(0.095, 0.1, 0.04), smoothstep(60.0, 300.0, coarse));
}

#endif

#ifdef CLOSE
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

// How much of the sun the aircraft leaves to a point: wing, body and tail as soft plates, which fade with distance.
float aircraftShade(vec3 fromEye, vec3 toSun) {
  vec3 from = uBodyFromWorld * (fromEye - uAircraft), dir = uBodyFromWorld * toSun;
  if (abs(dir.z) < 0.05) return 1.0;
  float away = length(from), soft = 0.15 + 0.009 * away;  // the sun is half a degree wide
  vec3 wing = from + dir * ((-1.0 - from.z) / dir.z), low = from - dir * (from.z / dir.z);
  vec2 w = smoothstep(vec2(-soft), vec2(soft), vec2(0.8, 5.5) - abs(wing.xy - vec2(0.1, 0.0)));
  vec2 b = smoothstep(vec2(-soft), vec2(soft), vec2(3.9, 0.6) - abs(low.xy - vec2(-1.3, 0.0)));
  vec2 t = smoothstep(vec2(-soft), vec2(soft), vec2(0.5, 1.7) - abs(low.xy - vec2(-4.7, 0.0)));
  float ahead = dot(fromEye - uAircraft, toSun) < 0.0 ? smoothstep(500.0, 150.0, away) : 0.0;
  return 1.0 - ahead * max(max(w.x * w.y, b.x * b.y), t.x * t.y);
}
#endif

#ifdef SEA
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

#endif

#ifdef LAND
#if defined(RAIN) && defined(CLOSE)
// Drops that strike wet ground near the eye: a speck, then a ring that widens and fades. Each stands in a cell of the
// ground and comes again elsewhere in it; nothing is kept. Share of the sky's light that they mirror.
float splashes(vec2 p, float pixel, float rate) {
  float sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    float size = 0.19 + 0.06 * float(k);  // m
    vec2 q = p / size + 0.37 * float(k), cell = floor(q);
    uint own = hashCell2(int(cell.x), int(cell.y), 70u + uint(k));
    float clock = uTime / 0.6 + unitFromHash(own), turn = floor(clock), age = 0.6 * (clock - turn);  // s
    uint now = nextHash(own + uint(int(turn)) * 747796405u), then = nextHash(now);
    vec2 at = 0.25 + 0.5 * vec2(unitFromHash(now), unitFromHash(then));
    float r = length(q - cell - at) * size, soft = max(0.004, 0.7 * pixel);
    float ring = (r - 0.004 - 0.14 * age) / soft;
    float shown = exp2(-ring * ring) * max(1.0 - age / 0.3, 0.0) + smoothstep(0.012 + soft, 0.004, r) * max(1.0 - age / 0.07, 0.0);
    sum += unitFromHash(nextHash(then)) < 0.06 * rate ? shown : 0.0;
  }
  return sum * smoothstep(0.05, 0.015, pixel);
}
#endif

vec3 groundColour(vec4 land, vec2 p, mat2 across, vec3 fromEye, float distance_, float pixel, WelkinLight light) {
  vec3 detail = details(p, 14.0 * max(1.0, distance_ / 900.0), pixel);
  float steep = length(land.yz);
  float wild = smoothstep(0.12, 0.5, steep + land.x * 0.0001);
  float even = 1.0;
#ifdef CLOSE
  vec2 at = vec2(dot(p, uRunway.xy), dot(p, vec2(uRunway.y, -uRunway.x)));
  even = smoothstep(40.0, 250.0, max(abs(at.x) - uRunway.z, abs(at.y) - uRunway.w));
#endif
  vec3 normal = normalize(vec3(-land.yz - even * mix(0.035, 0.3, wild) * detail.xy, 1.0));
  // Edges of woods and meadows are as soft as what the pixel covers of their cause.
  float tree = land.w + 0.35 * detail.z + 0.5 * smoothstep(0.05, 0.25, steep), sloped = steep + 0.03 * detail.z;
  float treeSoft = 0.06 + 0.7 * fwidth(tree), slopedSoft = 0.055 + 0.7 * fwidth(sloped);
  vec3 colour = fields(p, pixel, across) * (1.0 + 0.25 * detail.z);
  vec3 wood = vec3(0.024, 0.038, 0.015) * (1.0 + 0.5 * detail.z);
  vec3 grass = vec3(0.07, 0.085, 0.032) * (1.0 + 0.35 * detail.z);
  vec3 heath = vec3(0.105, 0.095, 0.055) * (1.0 + 0.35 * detail.z);
  colour = mix(colour, grass, smoothstep(0.105 - slopedSoft, 0.105 + slopedSoft, sloped) * 0.9);
  float high = land.x + 260.0 * detail.z;
  colour = mix(colour, wood,
               smoothstep(0.16 - treeSoft, 0.16 + treeSoft, tree) * smoothstep(1500.0, 1050.0, high) *
                   smoothstep(0.75, 0.5, steep) * even * smoothstep(3.0, 9.0, land.x));
  colour = mix(colour, heath, smoothstep(1000.0, 1500.0, high));
  vec3 rock = mix(vec3(0.13, 0.12, 0.11), vec3(0.2, 0.185, 0.165), 0.5 + 0.7 * detail.z);
  colour = mix(colour, rock, smoothstep(0.55, 0.85, steep + 0.22 * detail.z));
  colour = mix(colour, vec3(0.78, 0.8, 0.84),
               smoothstep(1650.0, 1900.0, high) * smoothstep(0.95, 0.65, steep + 0.15 * detail.z));
  colour = mix(vec3(0.3, 0.26, 0.19), colour, smoothstep(1.5, 4.0, land.x + 1.5 * detail.z));
#ifdef CLOSE
  colour = mix(vec3(0.075, 0.095, 0.035) * (1.0 + 0.2 * detail.z), colour, even);
  vec2 paved = smoothstep(vec2(0.5 * pixel), vec2(-0.5 * pixel), abs(at) - uRunway.zw);
  float old = 0.9 + 0.25 * detail.z - 0.25 * smoothstep(9.0, 2.0, abs(abs(at.y) - 3.5)) *
                                         smoothstep(250.0, 400.0, abs(at.x)) * smoothstep(700.0, 500.0, abs(at.x));
  vec3 tarmac = mix(vec3(0.19, 0.185, 0.175) * old, vec3(0.55), markings(at, uRunway.zw, pixel));
  colour = mix(colour, tarmac, paved.x * paved.y);
#endif
  vec3 irradiance = light.sun * max(dot(normal, light.toSun), 0.0) + light.sky * (0.5 + 0.5 * normal.z);
#ifdef RAIN
  // Wet soil sends more of the light back into itself (A. Angstrom 1925): about half of its albedo is left.
  WelkinRain rain = welkinRain(fromEye);
  colour *= 1.0 - 0.45 * rain.wetness;
#ifdef CLOSE
  // A film of water on the runway, and what strikes it and the ground.
  float facing = clamp(-fromEye.z / max(distance_, 1e-3), 0.0, 1.0);
  float mirror = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
  float film = rain.wetness * (0.15 + 0.85 * paved.x * paved.y) * (0.6 + 0.4 * clamp(0.5 + detail.z, 0.0, 1.0));
  float struck = splashes(p, pixel, rain.rate * (1.0 - rain.snow)) * rain.wetness;
  return max(colour, vec3(0.0)) * irradiance / kPi + (film * mirror + 0.3 * struck) * light.sky / kPi;
#endif
#endif
  return max(colour, vec3(0.0)) * irradiance / kPi;
}
#endif

void main() {
  vec3 fromEye = vRay * texelFetch(uAlong, ivec2(gl_FragCoord.xy), 0).x;
  vec4 land = landAt(fromEye.xy);
  float distance_ = length(fromEye);
  vec3 toEye = -fromEye / max(distance_, 1e-3);
  // Metres on the ground that a pixel covers: between across and along the view.
  float pixel = distance_ * uPixel / mix(1.0, max(abs(toEye.z), 0.1), 0.5);
  vec2 p = fromEye.xy + uEyePlace;
  WelkinLight light = welkinLight(fromEye);
#ifdef CLOSE
  light.sun *= aircraftShade(fromEye, light.toSun);
#endif
  vec3 radiance = vec3(0.0);
#ifdef LAND
  radiance = groundColour(land, p, mat2(dFdx(p), dFdy(p)), fromEye, distance_, pixel, light);
#endif
#ifdef SEA
  radiance = mix(radiance, seaColour(p, distance_, pixel, light, toEye), smoothstep(0.4, -0.4, land.x));
#endif
  WelkinFront air = welkinAir(fromEye);
  oColour = vec4(radiance * uExposure * air.through + air.light, 1.0);
}
)";

}  // namespace welkin::viewer
