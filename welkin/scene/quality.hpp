#pragma once
#include "welkin/base/fields.hpp"

namespace welkin {

enum class QualityPreset { low, medium, high, ultra };
template <>
struct ChoiceNames<QualityPreset> {
  static constexpr std::array<std::string_view, 4> names{"low", "medium", "high", "ultra"};
};

// How much work the real-time renderer does. Every shortcut can be turned off by itself.
struct Quality {
  QualityPreset preset = QualityPreset::high;
  int historyScale = 2;
  int interleave = 4;
  float stepScale = 1.0f;
  int lightSteps = 9;
  int ambientSteps = 3;
  bool refine = true;
  bool earlyExit = true;
  bool jitter = true;
  bool reprojection = true;
  bool lightVolume = true;
  int lightFrames = 24;
  bool averageHistory = false;
  bool cheapSearch = true;
  bool stepsByAngle = true;

  bool operator==(const Quality&) const = default;
};
template <>
struct FieldTable<Quality> {
  static auto make() {
    return fieldRows(
        field<&Quality::preset>("preset", "sets every other value of this table; values given besides it win"),
        field<&Quality::historyScale>("history_scale", {1, 2, 3, 4},
                                      "pixels of the picture to one of the cloud history"),
        field<&Quality::interleave>("interleave", {1, 2, 4}, "each frame marches one pixel in a block of this edge"),
        field<&Quality::stepScale>("step_scale", {0.05, 20}, {0.25, 4}, "length of the march's steps, as a multiple"),
        field<&Quality::lightSteps>("light_steps", {1, 16}, {},
                                    "samples toward the sun; with the light volume a quarter of them"),
        field<&Quality::ambientSteps>("ambient_steps", {0, 8}, {},
                                      "samples toward the zenith, where there is no light volume"),
        field<&Quality::refine>("refine", "finds the first hit of a ray by smaller steps"),
        field<&Quality::earlyExit>("early_exit", "ends a march where the cloud has become opaque"),
        field<&Quality::jitter>("jitter", "shifts the samples of every pixel and frame: noise instead of bands"),
        field<&Quality::lightVolume>("light_volume",
                                     "takes the light of what is farther off from a volume round the camera"),
        field<&Quality::lightFrames>("light_frames", {1, 240}, {1, 60},
                                     "frames over which a level of that volume is made anew; 1: all at once"),
        field<&Quality::reprojection>("reprojection", "reuses the pixels of earlier frames"),
        field<&Quality::averageHistory>("average_history",
                                        "softens reprojected pixels by the mean of their neighbours (000 ch. 4.4)"),
        field<&Quality::cheapSearch>("cheap_search", "looks for clouds without their detail; nubis layers"),
        field<&Quality::stepsByAngle>("steps_by_angle", "64 steps at the zenith, 128 at the horizon; nubis layers"));
  }
};

// The values that a preset stands for.
Quality qualityPreset(QualityPreset preset);

}  // namespace welkin
