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
