#pragma once
// Noise taken out of a path-traced picture: non-local means on the tracer's own estimate of its variance.
#include "welkin/base/image.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::trace {

// What becomes of pixels that a few paths, which found the sun, have made far brighter than their neighbours. Spread,
// the light of the picture as a whole stays, and with few paths each is seen as a faint disc of 19 pixels. Dimmed to
// what is around them, they are gone, and their light with them: a few per cent.
enum class Outliers { spread, dimmed };

// The radiance of `layers` (RGB, kcd/m^2), smoothed: each pixel becomes the mean of those around it (within 10 pixels,
// less toward the rim) whose patches (3 x 3) differ from its own no more than their variances explain, in luminance and
// transmittance, and lie at its depth (distances after Rousselle et al. 2012, features after Rousselle et al. 2013).
// Weights come from the noise that they smooth: a picture for the eye, not a reference. Pixels without samples, and
// those without variance within 5 x 5 of them, stay as they are, bit for bit. The result does not depend on the number
// of cores. Throws Error (badInput) for layers of different sizes.
Image denoise(const TraceLayers& layers, Outliers outliers = Outliers::spread);

}  // namespace welkin::trace
