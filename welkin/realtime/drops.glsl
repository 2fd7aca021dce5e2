// What the shader of drops and flakes knows (shaders/drop_places.frag.glsl); positions are relative to the eye,
// east-north-up.

const float kRainFade = 0.7f;  // share of a level's reach, where its particles begin to give way to what is beyond

struct DropParams {
  vec4 clip0, clip1, clip3;  // rows of the target's clip transform; of a panorama, its right, above and forward
  vec4 edges, reaches;       // of the levels' cells and of the levels, m
  vec4 sun;                  // xyz: toward the sun, w: from kcd/m^2 to the target's units
  vec4 up;                   // xyz: away from the planet's centre, w: altitude of the eye, m
  float rate, mapScale;      // mm/h for which there are all drops; 1 / edge of the map, 1/m
  float turns, shutter;      // of flutter, a share of a whole number; s
};

// Drops or flakes of one size in one level.
struct DropClass {
  vec4 start;     // corner of the cell with the eye in edges of cells, w: diameter, m
  vec4 velocity;  // against the eye, m/s
  int cellX, cellY, cellZ, flake;
};
