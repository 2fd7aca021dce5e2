#include "welkin/scene/environment.hpp"

#include <algorithm>
#include <cmath>

#include "welkin/atmosphere/params.hpp"
#include "welkin/base/law_tone.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/scene/camera.hpp"

namespace welkin {

namespace {

// Luminance in the middle of a soft sun, kcd/m^2: half floats end at 65504, and the sky round it comes on top.
constexpr double kSoftPeak = 40000.0;
constexpr double kFineness = 4.0;  // points on the radius of a disc, at least
constexpr int kSubsamples = 16;    // a side, of a pixel that the disc touches, at least

double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// Brightness at `x` radii (below 1) from the middle of the disc, over that of the middle. Limb darkening after
// Hestroffer and Magnan 1998, as in law::sunDisc; or smooth to the edge.
glm::dvec3 sharpProfile(double x) {
  const double inside = 1.0 - x * x;
  return {std::pow(inside, 0.5 * 0.397), std::pow(inside, 0.5 * 0.503), std::pow(inside, 0.5 * 0.652)};
}
glm::dvec3 softProfile(double x) {
  const double inside = 1.0 - x * x;
  return glm::dvec3(inside * inside);
}

// The pixels of a disc of this radius (rad); their shares sum to 1.
std::vector<SunPixel> discPixels(const EnvironmentPixels& pixels, const glm::dvec3& middle, double radius,
                                 glm::dvec3 (*profile)(double)) {
  std::vector<SunPixel> disc;
  const double largest = 2.0 * kPi / pixels.width();  // rad: no pixel is wider
  const double reach = radius + largest;
  const int samples = std::max(kSubsamples, static_cast<int>(std::ceil(kFineness * largest / radius)));
  glm::dvec3 whole(0.0);
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      if (glm::distance(pixels.direction(x + 0.5, y + 0.5), middle) > reach) continue;
      glm::dvec3 sum(0.0);
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
          const glm::dvec3 d = pixels.direction(x + (i + 0.5) / samples, y + (j + 0.5) / samples);
          const double from = glm::distance(d, middle);
          if (from < radius) sum += profile(from / radius);
        }
      if (sum.x <= 0.0) continue;
      disc.push_back(
          {static_cast<std::size_t>(y) * pixels.width() + x, sum * (pixels.solidAngle(x, y) / (samples * samples))});
      whole += disc.back().share;
    }
  for (SunPixel& p : disc) p.share /= whole;
  return disc;
}

// The radius of a soft sun: the mean of its profile is a third of the middle.
double softRadius(const glm::dvec3& illuminance) {
  const double most = std::max({illuminance.x, illuminance.y, illuminance.z});
  return std::max(0.5 * kSunAngularDiameter, std::sqrt(3.0 * most / (kPi * kSoftPeak)));
}

}  // namespace

std::vector<Camera> environmentCameras(const Camera& from, EnvironmentLayout layout, double centerHeading) {
  Camera camera = from;
  camera.roll = 0.0f;
  const auto look = [&](double heading, double pitch) {
    camera.heading = static_cast<float>(std::remainder(centerHeading + heading, 2.0 * kPi));
    camera.pitch = static_cast<float>(pitch);
    return camera;
  };
  if (layout == EnvironmentLayout::latlong) {
    camera.projection = Projection::equirectangular;
    return {look(0.0, 0.0)};
  }
  camera.projection = Projection::perspective;
  camera.fov = static_cast<float>(0.5 * kPi);
  return {look(-0.5 * kPi, 0.0), look(0.5 * kPi, 0.0), look(kPi, 0.5 * kPi),
          look(kPi, -0.5 * kPi), look(0.0, 0.0),       look(kPi, 0.0)};
}

EnvironmentPixels::EnvironmentPixels(const std::vector<Camera>& cameras, int width)
    : width_(width), height_(cameras.size() == 1 ? width / 2 : width) {
  for (const Camera& c : cameras) cameras_.push_back(cameraParams(c, static_cast<double>(width_) / height_));
}

glm::dvec3 EnvironmentPixels::direction(double x, double y) const {
  const int picture = std::clamp(static_cast<int>(y) / height_, 0, static_cast<int>(cameras_.size()) - 1);
  const glm::vec2 ndc(2.0 * x / width_ - 1.0, 1.0 - 2.0 * (y - static_cast<double>(picture) * height_) / height_);
  return glm::normalize(glm::dvec3(law::cameraRay(ndc, cameras_[static_cast<std::size_t>(picture)])));
}

double EnvironmentPixels::solidAngle(int x, int y) const {
  if (cameras_.size() == 1) {
    const double step = kPi / height_, top = 0.5 * kPi - y * step;
    return 2.0 * kPi / width_ * (std::sin(top) - std::sin(top - step));
  }
  const double s = 2.0 * (x + 0.5) / width_ - 1.0, t = 2.0 * (y % height_ + 0.5) / height_ - 1.0;
  return 4.0 / (static_cast<double>(width_) * height_) * std::pow(1.0 + s * s + t * t, -1.5);
}

std::vector<SunPixel> sunPixels(const EnvironmentPixels& pixels, const DirectionalLight& sun) {
  if (luminance(sun.illuminance) <= 0.0) return {};
  return discPixels(pixels, sun.direction, 0.5 * kSunAngularDiameter, sharpProfile);
}

std::optional<DirectionalLight> addSun(Image& picture, const EnvironmentPixels& pixels, const DirectionalLight& sun,
                                       const std::vector<SunPixel>& disc, const SunTreatment& treatment) {
  const auto column = [&](std::size_t i) { return static_cast<int>(i % static_cast<std::size_t>(pixels.width())); };
  const auto row = [&](std::size_t i) { return static_cast<int>(i / static_cast<std::size_t>(pixels.width())); };
  const auto solidAngle = [&](std::size_t i) { return pixels.solidAngle(column(i), row(i)); };
  const auto add = [&](std::size_t i, const glm::dvec3& light) {
    for (int k = 0; k < 3; ++k) picture.pixels[i * 3 + k] += static_cast<float>(light[k] / solidAngle(i));
  };
  // What is taken away, as the sum of illuminance times direction, for each colour.
  glm::dvec3 lost[3] = {glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
  const auto lose = [&](const glm::dvec3& light, const glm::dvec3& direction) {
    for (int k = 0; k < 3; ++k) lost[k] += light[k] * direction;
  };

  glm::dvec3 through(0.0);
  for (const SunPixel& p : disc) {
    const glm::dvec3 light = sun.illuminance * p.share * static_cast<double>(p.transmittance);
    through += light;
    if (treatment.style == SunStyle::full || treatment.style == SunStyle::clamp) add(p.index, light);
  }
  if (treatment.style == SunStyle::none) lose(through, sun.direction);
  if (treatment.style == SunStyle::soft && luminance(through) > 0.0)
    for (const SunPixel& p : discPixels(pixels, sun.direction, softRadius(through), softProfile))
      add(p.index, through * p.share);

  for (std::size_t i = 0; i < pixels.count(); ++i) {
    float* c = picture.pixels.data() + i * 3;
    const glm::dvec3 before(c[0], c[1], c[2]);
    double keep = std::min(treatment.most / std::max({before.x, before.y, before.z, 1e-30}), 1.0);
    if (treatment.style == SunStyle::clamp) keep = std::min(keep, treatment.clamp / std::max(luminance(before), 1e-30));
    if (keep >= 1.0) continue;
    for (int k = 0; k < 3; ++k) c[k] = static_cast<float>(std::min(before[k] * keep, treatment.most));
    lose(before * ((1.0 - keep) * solidAngle(i)), pixels.direction(column(i) + 0.5, row(i) + 0.5));
  }
  const glm::dvec3 mean = 0.2126 * lost[0] + 0.7152 * lost[1] + 0.0722 * lost[2];
  if (glm::length(mean) <= 0.0) return std::nullopt;
  DirectionalLight light{glm::normalize(mean), {}};
  for (int k = 0; k < 3; ++k) light.illuminance[k] = std::max(glm::dot(lost[k], light.direction), 0.0);
  return light;
}

glm::dvec3 upwardIrradiance(const Image& picture, const EnvironmentPixels& pixels) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      const double cosine = pixels.direction(x + 0.5, y + 0.5).z;
      if (cosine <= 0.0) continue;
      const float* c = picture.at(x, y);
      sum += glm::dvec3(c[0], c[1], c[2]) * (cosine * pixels.solidAngle(x, y));
    }
  return sum;
}

}  // namespace welkin
