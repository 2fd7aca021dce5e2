// Weather bounds: between which altitudes above the layer's base the clouds of a cell can be, a cell being a block of
// texels of one clip level. What no lookup inside the cell can leave: neighbours are counted in as far as filtering and
// the warp of outlines reach.
uniform highp sampler2DArray uWeather;
uniform highp sampler2DArray uExtra;
uniform ivec4 uCells;   // texels of a cell, texels by which lookups leave it, slice, texels of the level
uniform vec4 uLayer;    // thickness, how far cloud may stand out of its column below and above, all in m; 1 for nubis

layout(location = 0) out vec4 oBounds;

const float kLeastHeight = 20.0;  // m: profile.glsl has no lower columns

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * uCells.x;
  ivec2 low = max(first - uCells.y, ivec2(0)), high = min(first + uCells.x - 1 + uCells.y, ivec2(uCells.w - 1));
  vec2 bounds = vec2(1e9, -1e9);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      vec2 column = texelFetch(uWeather, ivec3(x, y, uCells.z), 0).xy;
      vec2 extra = texelFetch(uExtra, ivec3(x, y, uCells.z), 0).xy;
      vec2 own = vec2(1e9, -1e9);
      if (uLayer.w > 0.5) {
        if (column.x > 0.0) own = vec2(extra.y, extra.y + uLayer.x);
      } else {
        if (column.x > kLeastHeight) own = vec2(column.y, column.y + column.x);
        // An anvil is ice, which begins half-way up.
        if (extra.x > 0.0) own = vec2(min(own.x, column.y + 0.45 * uLayer.x), max(own.y, column.y + 0.9 * uLayer.x));
      }
      bounds = vec2(min(bounds.x, own.x), max(bounds.y, own.y));
    }
  // Half floats lose a thousandth.
  oBounds = vec4(bounds.y > bounds.x ? vec2(bounds.x - uLayer.y - 0.001 * abs(bounds.x),
                                            bounds.y + uLayer.z + 0.001 * abs(bounds.y))
                                     : vec2(60000.0, -60000.0),
                 0.0, 1.0);
}
