#pragma once
// What falls from a scene's clouds, as plain values.
#include "welkin/base/fields.hpp"

namespace welkin {

// Rain and snow below the layers whose weather has precipitation.
struct Precipitation {
  float rate = 0.0f;          // mm/h of water
  float temperature = 15.0f;  // degrees Celsius
  float evaporation = 0.3f;   // mm/h
  int particles = 100000;
  float shutter = 0.01f;  // s
};
template <>
struct FieldTable<Precipitation> {
  static auto make() {
    return fieldRows(
        field<&Precipitation::rate, kMillimetresPerHour>(
            "rate", {0, 200}, {0, 60}, "rain or snow, as water, where the layers' precipitation is 1; 0: none falls"),
        field<&Precipitation::temperature, kCelsius>("temperature", {-60, 50}, {-15, 30},
                                                     "at the ground, 6.5 degrees less each km up; below 0 it snows"),
        field<&Precipitation::evaporation, kMillimetresPerHour>(
            "evaporation", {0, 200}, {0, 10}, "what falls at less than this rate does not reach the ground: virga"),
        field<&Precipitation::particles>("particles", {0, 1000000}, {0, 200000},
                                         "most drops or flakes that are drawn near the eye in real time"),
        field<&Precipitation::shutter, kSeconds>("shutter", {0, 0.5}, {0, 0.05},
                                                 "how long a picture is exposed: drops become streaks"));
  }
};

}  // namespace welkin
