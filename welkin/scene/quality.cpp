#include "welkin/scene/quality.hpp"

namespace welkin {

Quality qualityPreset(QualityPreset preset) {
  Quality q;
  q.preset = preset;
  switch (preset) {
    case QualityPreset::low:
      q.interleave = 4;
      q.stepScale = 2.0f;
      q.lightSteps = 5;
      q.ambientSteps = 2;
      break;
    case QualityPreset::medium:
      q.interleave = 4;
      q.stepScale = 1.4f;
      q.lightSteps = 7;
      break;
    case QualityPreset::high:
      break;
    case QualityPreset::ultra:
      q.historyScale = 1;
      q.interleave = 1;
      q.stepScale = 0.7f;
      q.lightSteps = 12;
      q.lightFrames = 1;
      q.ambientSteps = 4;
      break;
  }
  return q;
}

}  // namespace welkin
