// How far a ray can go before there may be cloud again, from the bounds of the weather (weather_bounds.frag.glsl).

// Inside one layer, from the point q of cloud space; `way` is how q changes with each metre of the ray. 0 where cloud may
// be, else at least a little, m.
float layerClearance(vec3 q, vec3 way, float dither, LayerParams c, ClipParams clip, sampler2DArray bounds) {
  vec3 p = unsheared(q, c);
  float lean = c.shear / c.thickness * way.z;
  vec2 along = way.xy - vec2(c.downwindX, c.downwindY) * lean;
  vec3 place = weatherPlace(clip, p.xy, dither);
  float cells = float(textureSize(bounds, 0).x);
  vec2 at = place.xy * cells;
  vec2 cell = floor(at);
  vec2 within = texelFetch(bounds, ivec3(clamp(ivec2(cell), ivec2(0), ivec2(int(cells) - 1)), int(place.z + 0.5)), 0).xy;
  within += c.base;
  // To the cell's border, and to the altitudes of its clouds.
  vec2 left = mix(at - cell, 1.0 - (at - cell), vec2(greaterThan(along, vec2(0.0))));
  vec2 border = left / max(abs(along) * (levelScale(clip, place.z - clip.firstSlice) * cells), vec2(1e-9));
  float rise = p.z < within.x ? within.x - p.z : within.y - p.z;
  float vertical = rise * way.z > 0.0 ? rise / way.z : 1e9;
  bool inside = p.z >= within.x && p.z <= within.y;
  return inside ? 0.0 : max(min(min(border.x, border.y), vertical), 0.01);
}

// Before a grid's box.
float gridClearance(vec3 q, vec3 way, GridParams g) {
  vec3 v = vec3(dot(g.rowX.xyz, q) + g.rowX.w, dot(g.rowY.xyz, q) + g.rowY.w, dot(g.rowZ.xyz, q) + g.rowZ.w);
  vec3 dv = vec3(dot(g.rowX.xyz, way), dot(g.rowY.xyz, way), dot(g.rowZ.xyz, way));
  dv = mix(dv, vec3(1e-9), vec3(lessThan(abs(dv), vec3(1e-9))));
  vec3 a = -v / dv, b = (g.voxels.xyz - v) / dv;
  vec3 near = min(a, b), far = max(a, b);
  float enter = max(max(near.x, near.y), near.z), leave = min(min(far.x, far.y), far.z);
  if (leave <= 0.0 || enter > leave + 100.0) return 1e9;  // the ray bends a little in cloud space
  return max(enter - 100.0, 0.0);
}

// Before the next copy of a scattered grid, or at least the border of a square. `g` lies along the axes of the world.
float scatterClearance(vec3 q, vec3 way, GridParams g) {
  ScatterParams s = g.scatter;
  float most = 1.0 + s.chance.z;
  vec2 heights = (vec2(0.0, g.voxels.z) - g.rowZ.w) / g.rowZ.z - s.place.z;
  heights = mix(heights, heights * most, vec2(heights.x < 0.0, heights.y > 0.0)) + s.place.z;
  float rise = q.z < heights.x ? heights.x - q.z : heights.y - q.z;
  if (q.z < heights.x || q.z > heights.y) {
    float vertical = rise * way.z > 0.0 ? rise / way.z : 1e9;
    if (vertical > 200.0) return vertical - 100.0;  // the ray bends a little in cloud space
  }
  vec2 p = q.xy - s.place.xy;
  // Before the land that has them.
  float far = s.chance.x + s.place.w, away = length(p);
  if (away > far) {
    float b = dot(p, way.xy), a = max(dot(way.xy, way.xy), 1e-12), c = dot(p, p) - far * far;
    float disc = b * b - a * c;
    if (b >= 0.0 || disc <= 0.0) return 1e9;
    return max((-b - sqrt(disc)) / a, 0.01);
  }
  vec2 cell = floor(p / s.place.w + 0.5), at = p / s.place.w + 0.5 - cell;
  vec2 left = mix(at, 1.0 - at, vec2(greaterThan(way.xy, vec2(0.0)))) * s.place.w;
  vec2 border = left / max(abs(way.xy), vec2(1e-9));
  float leave = max(min(border.x, border.y), 0.01) + 0.01;
  vec4 copy = scatterCopy(cell.x, cell.y, s);
  if (copy.w == 0.0) return leave;
  float size = abs(copy.w);
  mat2 turn = mat2(cos(copy.z), -sin(copy.z), sin(copy.z), cos(copy.z));
  vec2 along = turn * way.xy;
  if (copy.w < 0.0) along = 2.0 * dot(along, s.axis.xy) * s.axis.xy - along;
  return min(size * gridClearance(scatteredPoint(q, s), vec3(along, way.z), g), leave);
}
