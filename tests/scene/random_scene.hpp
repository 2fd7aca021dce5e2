#pragma once
// Scenes with random values in every field of every section; the same seed gives the same scene.
#include <cmath>
#include <random>

#include "welkin/scene/sections.hpp"

namespace welkin::test {

inline double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

// A value that checkField accepts.
inline FieldValue randomValue(const Field& f, std::mt19937& random) {
  switch (f.kind) {
    case FieldKind::real:
      return random() % 8 == 0 ? f.hard.high : between(random, f.hard.low, f.hard.high);
    case FieldKind::integer:
      if (!f.allowed.empty()) return f.allowed[random() % f.allowed.size()];
      return static_cast<std::int64_t>(std::floor(between(random, f.hard.low, f.hard.high)));
    case FieldKind::boolean:
      return random() % 2 == 0;
    case FieldKind::choice:
      return std::string(f.choices[random() % f.choices.size()]);
    case FieldKind::file:
      return std::string();
    case FieldKind::text: {
      if (f.name == std::string_view("date")) return "19" + std::to_string(10 + random() % 90) + "-02-28";
      if (f.name == std::string_view("time")) return std::to_string(10 + random() % 14) + ":30";
      static constexpr const char* kPieces[] = {"cloud", " \"x\"", "\\", "\n", "\t", "#", "ü", "☁", "'", "]"};
      std::string text;
      for (std::size_t i = random() % 6; i > 0; --i) text += kPieces[random() % std::size(kPieces)];
      return text;
    }
    case FieldKind::vector: {
      std::array<double, 3> v{};
      for (double& c : v) c = between(random, f.hard.low, f.hard.high);
      return v;
    }
  }
  return {};
}

// About `share` of all fields leave their defaults.
inline Scene randomScene(unsigned seed, double share = 0.5) {
  std::mt19937 random(seed);
  Scene scene;
  scene.layers.resize(random() % (kMaxLayers + 1));
  scene.sheets.resize(random() % (kMaxSheets + 1));
  for (const Section& section : sectionsOf(scene))
    for (const Field& f : section.fields)
      if (between(random, 0, 1) < share) assign(scene, section, f, randomValue(f, random));
  scene.grids.resize(random() % (kMaxGrids + 1));
  scene.heroes.resize(random() % 3);
  for (const Section& section : sectionsOf(scene))
    for (const Field& f : section.fields)
      if (section.path.starts_with("grid.") || section.path.starts_with("hero."))
        assign(scene, section, f, randomValue(f, random));
  return scene;
}

}  // namespace welkin::test
