// Integer hashes: the only source of randomness of the law. Exact in all readings.

// PCG output permutation on 32 bits (M. O'Neill 2014; M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering",
// JCGT 2020).
FN Uint hashUint(IN(Uint) x) {
  Uint state = x * 747796405u + 2891336453u;
  Uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// A lattice point is hashed coordinate by coordinate, x last: hashChain(x, hashChain(y, hashChain(z, hashSeed(seed))))
// is hashCell3(x, y, z, seed), so that a row of points shares the work for y and z.
FN uint hashSeed(IN(uint) seed) { return seed * 0x9E3779B9u; }
FN Uint hashChain(IN(Int) coordinate, IN(Uint) h) { return hashUint(toUint(coordinate) + h); }

// Hash of a lattice point and a seed.
FN Uint hashCell2(IN(Int) x, IN(Int) y, IN(uint) seed) {
  return hashUint(toUint(x) + hashUint(toUint(y) + seed * 0x9E3779B9u));
}
FN Uint hashCell3(IN(Int) x, IN(Int) y, IN(Int) z, IN(uint) seed) {
  return hashUint(toUint(x) + hashUint(toUint(y) + hashUint(toUint(z) + seed * 0x9E3779B9u)));
}
FN Uint hashCell4(IN(Int) x, IN(Int) y, IN(Int) z, IN(Int) w, IN(uint) seed) {
  return hashUint(toUint(x) + hashUint(toUint(y) + hashUint(toUint(z) + hashUint(toUint(w) + seed * 0x9E3779B9u))));
}

// [0, 1) with 24 bits, and the next hash of a chain for further independent numbers.
FN Real unitFromHash(IN(Uint) h) { return toReal(h >> 8u) * 5.9604644775390625e-8f; }
FN Uint nextHash(IN(Uint) h) { return hashUint(h + 0x85EBCA6Bu); }
