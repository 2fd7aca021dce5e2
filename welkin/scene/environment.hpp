#pragma once
// A sky as a picture of all directions, and what happens to its sun. Renderers draw the pictures of
// environmentCameras(), without the sun's disc; the sun is put in here, exact in its energy at every size.
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "welkin/base/image.hpp"
#include "welkin/scene/law.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin {

// latlong: one equirectangular picture, 2:1. cube: six squares from top to bottom, +X -X +Y -Y +Z -Z in OpenEXR's axes
// for environments: +Y up, +Z the centre's heading, +X to the left of it.
enum class EnvironmentLayout { latlong, cube };
template <>
struct ChoiceNames<EnvironmentLayout> {
  static constexpr std::array<std::string_view, 2> names{"latlong", "cube"};
};

// The cameras whose pictures, one below the other, make the environment seen from `from`. Heading in rad.
std::vector<Camera> environmentCameras(const Camera& from, EnvironmentLayout layout, double centerHeading);

// Pixels of an environment, row by row over all of its pictures.
class EnvironmentPixels {
 public:
  // `width` of each picture; a latlong one is half as high, a face of the cube as high.
  EnvironmentPixels(const std::vector<Camera>& cameras, int width);
  int width() const { return width_; }
  int height() const { return height_ * static_cast<int>(cameras_.size()); }  // of all pictures together
  int pictureHeight() const { return height_; }
  std::size_t count() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height()); }
  // Unit vector (east, north, up) of a point of the picture; pixel centres lie at x + 0.5, y + 0.5.
  glm::dvec3 direction(double x, double y) const;
  double solidAngle(int x, int y) const;  // sr
 private:
  std::vector<law::CameraParams> cameras_;
  int width_, height_;
};

// full: the disc as it is. soft: a wider and dimmer one of the same energy that half floats can hold. clamp: nothing
// brighter than a luminance. none: no disc.
enum class SunStyle { full, soft, clamp, none };

// A far light: what a map has lost. `illuminance`: linear Rec.709, klx on a plane that faces it.
struct DirectionalLight {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  glm::dvec3 illuminance{0.0};
};

// A pixel that the sun's disc touches.
struct SunPixel {
  std::size_t index = 0;
  glm::dvec3 share{0.0};       // of the disc's light, which is 1 over all of its pixels
  float transmittance = 1.0f;  // of clouds and ground before it; the renderer fills it in
};

// The pixels that the sun's disc touches, with its limb darkening (law::sunDisc). Empty for a sun without light.
std::vector<SunPixel> sunPixels(const EnvironmentPixels& pixels, const DirectionalLight& sun);

// What becomes of the sun. `clamp`: the style's luminance, kcd/m^2. `most`: the largest value of a channel that the
// file can hold.
struct SunTreatment {
  SunStyle style = SunStyle::full;
  double clamp = 0.0, most = 0.0;
};

// Puts the sun into a picture without it. `sun`: its light before the clouds; `disc`: its pixels, with what the clouds
// let through. Returns what the picture has lost, if anything: for a plane that all of it falls on, as much light.
std::optional<DirectionalLight> addSun(Image& picture, const EnvironmentPixels& pixels, const DirectionalLight& sun,
                                       const std::vector<SunPixel>& disc, const SunTreatment& treatment);

// Light that falls on a plane facing up, klx: the cosine-weighted integral of the picture's upper half.
glm::dvec3 upwardIrradiance(const Image& picture, const EnvironmentPixels& pixels);

}  // namespace welkin
