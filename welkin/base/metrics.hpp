#pragma once
// How far a picture is from a reference, in linear light. What an eye would see of it: flip.hpp.
#include "welkin/base/image.hpp"

namespace welkin {

// Relative mean squared error: the mean over pixels and colours of (test - reference)^2 / (reference^2 + epsilon).
// Rousselle et al. 2011 take epsilon = 0.01 for pictures whose mean is near 1; here it is 0.01 of the square of the
// reference's mean, so that units and exposure do not matter. Alpha is left out. Infinite when the reference is black
// and the test is not. Throws Error (badInput) for different shapes.
double relMse(const Image& reference, const Image& test);

// Mean luminance (Rec.709) of a picture with 1 or 3 colours, in its own unit.
double meanLuminance(const Image& image);

// A map with values in [0, 1] as a picture of sRGB values that grow lighter with the value, black to white: the
// cubehelix of D. A. Green 2011 (start 0.5, -1.5 rotations, hue 1, gamma 1).
Image heatMap(const Image& map);

}  // namespace welkin
