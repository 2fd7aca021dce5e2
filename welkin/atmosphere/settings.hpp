#pragma once
#include <string>

#include "welkin/base/fields.hpp"

namespace welkin {

struct Sun {
  float elevation = 0.7f;  // rad
  float azimuth = 3.9f;    // rad, compass
};
template <>
struct FieldTable<Sun> {
  static auto make() {
    return fieldRows(
        field<&Sun::elevation, kDegrees>("elevation", {-90, 90}, {-10, 90}, "angle above the horizon"),
        field<&Sun::azimuth, kDegrees>("azimuth", {0, 360}, {}, "compass heading toward the sun"));
  }
};

enum class SkyModel { physical, preetham, gradient };
template <>
struct ChoiceNames<SkyModel> {
  static constexpr std::array<std::string_view, 3> names{"physical", "preetham", "gradient"};
};

struct Atmosphere {
  SkyModel model = SkyModel::physical;
};
template <>
struct FieldTable<Atmosphere> {
  static auto make() { return fieldRows(field<&Atmosphere::model>("model", "the sky model")); }
};

}  // namespace welkin
