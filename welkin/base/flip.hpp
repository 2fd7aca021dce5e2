#pragma once
// FLIP: what a person sees when two pictures alternate on a screen.
#include "welkin/base/image.hpp"

namespace welkin {

// Pixels per degree of sight in the paper's setting: 0.7 m from a screen 0.7 m and 3840 pixels wide.
inline constexpr double kFlipPixelsPerDegree = 67.0;

// The map of differences in [0, 1], one channel, of two pictures of sRGB values in [0, 1] (grey or RGB; alpha is left
// out, values outside are clamped). Symmetric. Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating
// Images", with the authors' erratum (116, not 100, in the normalisation of the achromatic channel). Throws Error
// (badInput) for different shapes and for fewer than 1 or more than 1000 pixels per degree.
Image flipMap(const Image& a, const Image& b, double pixelsPerDegree = kFlipPixelsPerDegree);

// The mean of a map: the one number that its authors advise.
double meanOf(const Image& map);

}  // namespace welkin
