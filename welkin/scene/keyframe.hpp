#pragma once
// A moment at which parameters of a sky have given values.
#include <string>
#include <vector>

#include "welkin/base/fields.hpp"

namespace welkin {

// How a value goes on from its keyframe to its next one. smooth: it starts and ends at rest, and passes keyframes in
// between without stopping, never beyond the values on either side. step: it stays until then. What is no number, and
// whole numbers, always step.
enum class Interpolation { linear, smooth, step };
template <>
struct ChoiceNames<Interpolation> {
  static constexpr std::array<std::string_view, 3> names{"linear", "smooth", "step"};
};

struct KeyValue {
  std::string path;  // "layer.0.weather.coverage"
  FieldValue value;  // as the field's get() returns it
  bool operator==(const KeyValue&) const = default;
};

struct Keyframe {
  double time = 0.0;  // s, on the clock of Scene::time
  Interpolation interpolation = Interpolation::linear;
  std::vector<KeyValue> values;
  bool operator==(const Keyframe&) const = default;
};

}  // namespace welkin
