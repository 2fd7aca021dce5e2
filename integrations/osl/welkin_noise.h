// The law's noise (welkin/noise/*.glsl) in the core of OSL 1.12, whose only integers are signed: products and sums wrap
// to 32 bits, and shifts to the right are masked, since OSL's bring the sign in. A C++ compiler reads this file too;
// tests/osl holds it against the law.
#ifndef WELKIN_NOISE_H
#define WELKIN_NOISE_H

// x >> n as if x were unsigned, for n from 1 to 31.
int welkin_shift(int x, int n) { return (x >> n) & ((1 << (32 - n)) - 1); }

// PCG's output permutation: hashUint of noise/hash.glsl. The constants are 2891336453 and 0x9E3779B9 less 2^32.
int welkin_hash(int x) {
  int state = x * 747796405 + -1403630843;
  int word = (welkin_shift(state, welkin_shift(state, 28) + 4) ^ state) * 277803737;
  return welkin_shift(word, 22) ^ word;
}
int welkin_hash3(int x, int y, int z, int seed) {
  return welkin_hash(x + welkin_hash(y + welkin_hash(z + seed * -1640531527)));
}
int welkin_hash4(int x, int y, int z, int w, int seed) {
  return welkin_hash(x + welkin_hash(y + welkin_hash(z + welkin_hash(w + seed * -1640531527))));
}

// Cell i of a lattice that repeats after `period` cells, 0 never.
int welkin_wrap(int i, int period) {
  int rest = i;
  if (period != 0) {
    rest = i % period;
    if (rest < 0) rest += period;
  }
  return rest;
}

// -1 or 1 from a bit of a hash.
float welkin_sign(int h, int bit) { return 2.0 * ((h >> bit) & 1) - 1.0; }

// Euclidean distance to the nearest feature point, at most 1: worley3 of noise/worley.glsl.
float welkin_worley(float x, float y, float z, int period, int seed) {
  float wx = floor(x);
  float wy = floor(y);
  float wz = floor(z);
  float nearest = 1.0;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        int h = welkin_hash3(welkin_wrap((int)wx + i, period), welkin_wrap((int)wy + j, period),
                             welkin_wrap((int)wz + k, period), seed);
        float dx = i + ((h & 1023) + 0.5) * 0.0009765625 - (x - wx);
        float dy = j + (((h >> 10) & 1023) + 0.5) * 0.0009765625 - (y - wy);
        float dz = k + (((h >> 20) & 1023) + 0.5) * 0.0009765625 - (z - wz);
        nearest = min(nearest, dx * dx + (dy * dy + dz * dz));
      }
  return sqrt(nearest);
}

float welkin_simplex_corner(float dx, float dy, float dz, float dw, int x, int y, int z, int w, int period, int seed) {
  int sum = x + y + z + w;
  int h = welkin_hash4(welkin_wrap(x * 7 - sum, period * 7), welkin_wrap(y * 7 - sum, period * 7),
                       welkin_wrap(z * 7 - sum, period * 7), welkin_wrap(w * 7 - sum, period * 7), seed);
  int axis = welkin_shift(h, 30);
  float slope = 0.0;
  if (axis != 0) slope += welkin_sign(h, 0) * dx;
  if (axis != 1) slope += welkin_sign(h, 1) * dy;
  if (axis != 2) slope += welkin_sign(h, 2) * dz;
  if (axis != 3) slope += welkin_sign(h, 3) * dw;
  float t = max(0.473684211 - (dx * dx + dy * dy + dz * dz + dw * dw), 0.0);
  return t * t * t * t * slope;
}

// Within -1 to 1: simplex4 of noise/simplex.glsl.
float welkin_simplex(float x, float y, float z, float w, int period, int seed) {
  float skew = (x + y + z + w) * 0.333333333;
  float wx = floor(x + skew);
  float wy = floor(y + skew);
  float wz = floor(z + skew);
  float ww = floor(w + skew);
  float back = (wx + wy + wz + ww) * 0.142857143;
  float dx = x - wx + back;
  float dy = y - wy + back;
  float dz = z - wz + back;
  float dw = w - ww + back;
  float xy = step(dy, dx);
  float xz = step(dz, dx);
  float xw = step(dw, dx);
  float yz = step(dz, dy);
  float yw = step(dw, dy);
  float zw = step(dw, dz);
  float sum = 0.0;
  for (int corner = 0; corner < 5; ++corner) {
    float least = 3.5 - corner;
    float ox = step(least, xy + xz + xw);
    float oy = step(least, 1.0 - xy + yz + yw);
    float oz = step(least, 2.0 - xz - yz + zw);
    float ow = step(least, 3.0 - xw - yw - zw);
    float shift = corner * 0.142857143;
    sum += welkin_simplex_corner(dx - ox + shift, dy - oy + shift, dz - oz + shift, dw - ow + shift, (int)(wx + ox),
                                 (int)(wy + oy), (int)(wz + oz), (int)(ww + ow), period, seed);
  }
  return sum * 80.0;
}

#endif
