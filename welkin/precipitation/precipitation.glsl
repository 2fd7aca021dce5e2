// What falls from clouds: sizes, speeds, what it takes from light, how it moves. Diameters are in mm and those of the
// water in a particle; rates are in mm/h of water; other lengths in m, speeds in m/s, extinction in 1/m.
//
// Rain: sizes after Marshall and Palmer (1948), N(D) = 8000 exp(-4.1 R^-.21 D) per m^3 and mm; speeds after Atlas,
// Srivastava and Sekhon (1973), a fit to the measurements of Gunn and Kinzer (1949). Snow: sizes after Gunn and Marshall
// (1958), N(D) = 3800 R^-.87 exp(-2.55 R^-.48 D); speeds of unrimed aggregates after Locatelli and Hobbs (1974).
// Sizes of light are geometric: half of what such large particles take from a beam is diffraction, which goes on within
// a tenth of a degree, and no picture tells it from light that has met nothing.

const float kSnowSwelling = 2.714f;     // diameter of a flake over that of its water: 50 kg/m^3, 20 times lighter
const float kLargestDrop = 5.8f;        // mm; larger ones break up
const float kSurfaceWind = 0.5f;        // wind at the ground over that at the clouds: a power of 1/7 from 1 km to 10 m
const float kRainAsymmetry = 0.77f;     // mean cosine: water spheres, 0.885 with diffraction
const float kSnowAsymmetry = 0.56f;     // rough ice, 0.78 with diffraction

// N(0) in 1/(m^3 mm), and the slope in 1/mm; `rate` > 0.
FN Real rainIntercept(IN(Real) rate) { return Real(8000.0f) + 0.0f * rate; }
FN Real rainSlope(IN(Real) rate) { return 4.1f * pow(rate, Real(-0.21f)); }
FN Real snowIntercept(IN(Real) rate) { return 3800.0f * pow(rate, Real(-0.87f)); }
FN Real snowSlope(IN(Real) rate) { return 2.55f * pow(rate, Real(-0.48f)); }

// How many particles larger than `least` there are in a m^3 of such an exponential distribution.
FN Real countAbove(IN(Real) intercept, IN(Real) slope, IN(Real) least) { return intercept / slope * exp(-slope * least); }
// Their share of the cross-section of all.
FN Real sectionAbove(IN(Real) slope, IN(Real) least) {
  Real x = slope * least;
  return (0.5f * x * x + x + 1.0f) * exp(-x);
}
// The size below which a share `u` of those above `least` lies.
FN Real sizeAt(IN(Real) u, IN(Real) slope, IN(Real) least) {
  return min(least - log(max(1.0f - u, 1e-6f)) / slope, kLargestDrop);
}

// Extinction: the integral of N(D) pi/4 D^2, 1.823e-4 R^.63 in rain and 2.652e-3 R^.57 in snow.
FN Real rainExtinction(IN(Real) rate) { return 1.823e-4f * pow(rate, Real(0.63f)); }
FN Real snowExtinction(IN(Real) rate) { return 2.652e-3f * pow(rate, Real(0.57f)); }
// `snow`: the share of it that is snow; 0 where nothing falls.
FN Real fallingExtinction(IN(Real) rate, IN(Real) snow) {
  return select(rate > 1e-4f, mix(rainExtinction(max(rate, 1e-4f)), snowExtinction(max(rate, 1e-4f)), snow), Real(0.0f));
}

// Terminal speeds. Below 0.2 mm, which nobody sees, that of 0.2 mm.
FN Real rainSpeed(IN(Real) diameter) {
  return 9.65f - 10.3f * exp(-0.6f * clamp(diameter, 0.2f, kLargestDrop));
}
FN Real snowSpeed(IN(Real) diameter) { return 0.8f * pow(max(kSnowSwelling * diameter, 0.1f), Real(0.16f)); }

// The share of what falls that is snow, from 100 m above the level of 0 degrees to 250 m below, where flakes have melted.
FN Real snowShare(IN(Real) altitude, IN(Real) freezing) {
  return smoothstep(freezing - 250.0f, freezing + 100.0f, altitude);
}

// What is left of a rate after a share `fallen` of the way to the ground; `lost` is the root of the rate of which
// nothing reaches it. Evaporation goes nearly as the root of the rate (Kessler 1969: R^.58): heavy rain loses the
// smaller share, and light rain ends as virga.
FN Real leftOf(IN(Real) rate, IN(Real) fallen, IN(Real) lost) {
  Real root = max(sqrt(rate) - lost * saturate(fallen), 0.0f);
  return root * root;
}

// The wind is less near the ground, linearly from `top` down: what falls stays behind the cloud that moves on above. An
// integral of that shortfall over altitude, from 0 to z, as a share of the whole, in m: it is to be divided by the speed
// of fall.
FN Real shortfall(IN(Real) z, IN(float) inverseTop) { return z * (1.0f - 0.5f * z * inverseTop); }

// Where a particle of a cell is, in m from the eye. In the air that carries it down with it, particles stand still:
// `cell` counts cells of that air from the one that holds the eye, `start` is that cell's corner from the eye and
// `within` the particle's place in its own, both in edges of cells.
FN Vec3 particlePlace(IN(Vec3) cell, IN(Vec3) start, IN(Vec3) within, IN(float) edge) {
  return (cell + start + within) * edge;
}

// Flakes circle as they fall (Stringham et al. 1969: swings of some diameters): an offset in m. `turn` counts their turns,
// `phase` tells them apart; both in turns.
FN Vec3 flutter(IN(Real) turn, IN(Real) phase, IN(Real) radius) {
  Real angle = 6.2831853f * fract(turn + phase);
  return Vec3(radius * cos(angle), radius * sin(angle), 0.2f * radius * sin(2.0f * angle));
}
// Their apparent area as they tumble, against that of the flat side; its mean is about 0.68.
FN Real tumbled(IN(Real) turn, IN(Real) phase) {
  return 0.35f + 0.65f * abs(sin(6.2831853f * fract(1.7f * turn + phase)) * 0.8f);
}

// Opacity in the middle of a particle's picture: an ellipse of these half axes, fainter outward as 1 - r^2, that covers
// `area` in the mean over the shutter's time. Areas and axes in pixels.
FN Real streakOpacity(IN(Real) area, IN(Real) along, IN(Real) across) {
  return min(area / (1.5707963f * along * across), 0.95f);
}
