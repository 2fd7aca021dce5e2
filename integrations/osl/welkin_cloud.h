// The shape `classic` of hero clouds (welkin/density/hero.glsl, hero_shape.cpp; thesis 003, eq. 3.2 to 3.4) in the core
// of OSL 1.12. Read by C++ too; see welkin_noise.h.
#ifndef WELKIN_CLOUD_H
#define WELKIN_CLOUD_H
#include "welkin_noise.h"

// Cells after which the texture repeats, cells in the cloud's size at an overall scale of 1, and the seconds in which
// its noise becomes another.
#define WELKIN_PERIOD 96
#define WELKIN_CELLS 10.0
#define WELKIN_CHURN 60.0

// Inverted cellular noise, rounded: 1 at feature points.
float welkin_cells(float x, float y, float z, int period, int seed) {
  return 1.0 - smoothstep(0.0, 1.0, welkin_worley(x, y, z, period, seed));
}

// The distortion texture, 0 to 1, at a place in cells; `across` is x over half the cloud's width, `age` the time in
// periods of churn.
float welkin_distortion(float x, float y, float z, float across, float age, float worley, float clump, float wave,
                        float influence, float scale, int detail, float whisp, int seed) {
  float cells = welkin_cells(x, y, z, WELKIN_PERIOD, seed);
  float fine = welkin_cells(x * 2.0, y * 2.0, z * 2.0, 2 * WELKIN_PERIOD, seed + 1);
  cells = (cells + clump * fine) / (1.0 + clump);
  float qx = x * scale;
  float qy = y * scale;
  float qz = z * scale;
  float bent = 1.0 + 0.5 * welkin_simplex(qx, qy, qz, age, WELKIN_PERIOD, seed + 2);
  float waves = 0.5 + 0.5 * sin(18.0 * across * bent);
  cells = mix(cells, waves, wave);
  float fbm = 0.0;
  float weight = 0.5;
  int period = WELKIN_PERIOD;
  for (int i = 0; i < detail; ++i) {
    fbm += weight * welkin_simplex(qx, qy, qz, age, period, seed + 3 + i);
    qx *= 2.0;
    qy *= 2.0;
    qz *= 2.0;
    period *= 2;
    weight *= whisp;
  }
  float texture_ = 0.5 * mix(1.0, 2.0 * cells, worley) * mix(1.0, 2.0 * clamp(0.5 + fbm, 0.0, 1.0), influence);
  return clamp(texture_, 0.0, 1.0);
}

// Part of the gradation curve between two of its six points: a cubic through their values a and b with the secants
// before, between and after them, whose slopes do not overshoot (Fritsch and Butland 1984).
float welkin_slope(float left, float right) {
  float slope = 0.0;
  if (left * right > 0.0) slope = 2.0 * left * right / (left + right);
  return slope;
}
float welkin_cubic(float a, float b, float slope_a, float slope_b, float t) {
  float u = 1.0 - t;
  return a * (1.0 + 2.0 * t) * u * u + slope_a * t * u * u + b * t * t * (3.0 - 2.0 * t) - slope_b * t * t * u;
}

// S(Tz): the square of the radius at a height (0 to 1 in the box), for radii at 0, .2, .4, .6, .8 and 1 of it; beyond
// its ends it falls off.
float welkin_gradient(float height, float scale, float r0, float r1, float r2, float r3, float r4, float r5) {
  float h = 0.5 + scale * (height - 0.5);
  float within = clamp(h, 0.0, 1.0);
  float s0 = r0 * r0;
  float s1 = r1 * r1;
  float s2 = r2 * r2;
  float s3 = r3 * r3;
  float s4 = r4 * r4;
  float s5 = r5 * r5;
  float m1 = welkin_slope(s1 - s0, s2 - s1);
  float m2 = welkin_slope(s2 - s1, s3 - s2);
  float m3 = welkin_slope(s3 - s2, s4 - s3);
  float m4 = welkin_slope(s4 - s3, s5 - s4);
  float at = within * 5.0;
  float k = min(floor(at), 4.0);
  float t = at - k;
  float s = welkin_cubic(s0, s1, s1 - s0, m1, t);
  if (k > 0.5) s = welkin_cubic(s1, s2, m1, m2, t);
  if (k > 1.5) s = welkin_cubic(s2, s3, m2, m3, t);
  if (k > 2.5) s = welkin_cubic(s3, s4, m3, m4, t);
  if (k > 3.5) s = welkin_cubic(s4, s5, m4, s5 - s4, t);
  return max(s, 0.0) - 4.0 * fabs(h - within);
}

// 003 eq. 3.4 with O = 1.5 - noise, for coordinates of 0 to 1 in the box.
float welkin_density(float x, float y, float gradient, float noise_, float scale, float density, float distortion) {
  float tx = scale * (2.0 * x - 1.0);
  float ty = scale * (2.0 * y - 1.0);
  return density * max(gradient - tx * tx - ty * ty + distortion * (noise_ - 0.5), 0.0);
}

#endif
