// The coarse picture of rain and snow along the rays of a view (rain_segments.glsl): blocks of all its rays, one for each
// segment of their way.

const int kRainSegments = 24, kRainSamples = 6;  // samples of a segment
const int kRainColumns = 4, kRainRows = 6;       // of blocks in the picture, each a view of one segment
const int kRainPixels = 8;                       // least edge of its texel, in pixels of the target
const float kRainReach = 80000.0f;               // m

// Where segment k begins: they grow with the distance, m.
FN float rainStart(int k) {
  float at = float(k) / float(kRainSegments);
  return kRainReach * at * at;
}
