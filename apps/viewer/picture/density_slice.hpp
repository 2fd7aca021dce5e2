#pragma once
// A cut through the clouds of a sky, asked of the density field itself in the background.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// upright: through the camera, along its heading, from the ground to `top`. level: round the camera at `altitude`,
// north up.
struct SlicePlane {
  bool upright = true;
  double edge = 20000.0;     // m, from left to right, the camera in the middle
  double altitude = 2000.0;  // m
  double top = 8000.0;       // m
  bool operator==(const SlicePlane&) const = default;
};

struct SlicePicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // rows from the top; white at `most`
  float most = 0.0f;               // 1/m, the greatest extinction of the cut and of the layers' dense cloud
  std::string trouble;             // why there is none
};

class DensitySlice {
 public:
  static constexpr int kWidth = 320, kUprightHeight = 160;

  DensitySlice();
  ~DensitySlice();
  DensitySlice(const DensitySlice&) = delete;
  DensitySlice& operator=(const DensitySlice&) = delete;

  // Asks for a cut; one that has not begun yet makes way for it.
  void ask(const Scene& scene, const realtime::CustomTextures& textures, const SlicePlane& plane);
  // Whether a new one has come, which picture() is from now on.
  bool collect();
  const SlicePicture& picture() const;
  // Nothing has been asked for that is not there.
  bool complete() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace welkin::viewer
