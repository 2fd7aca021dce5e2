#pragma once
// The flight that `cost` and `motion` fly: over the default sky with its wind, 25 frames a second, four legs of three
// seconds with cuts between them. Places are chosen for that sky: leg "deck" goes through a small cumulus, 15 frames
// below it, 31 inside, 29 above.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>
#include <string>

#include "bench/harness.hpp"
#include "welkin/realtime/offscreen.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::bench {

inline constexpr int kLegFrames = 75;
inline constexpr double kFramesPerSecond = 25.0;
inline constexpr int kWarmUp = 8;  // frames after a cut that have little history to lean on

struct Leg {
  const char* name;
  glm::dvec3 from;                 // m
  double heading, turn;            // degrees, degrees/s
  double speed, acceleration;      // m/s, m/s^2, along the heading
  double climb, lift;              // m/s, m/s^2, upward
  double pitch, nod;               // degrees, degrees/s, of the camera
  double sun = 40.0, sinks = 0.0;  // degrees, degrees/s
  double sunAzimuth = 110.0;       // degrees
};
inline constexpr std::array kLegs{
    Leg{"take-off", {-700.0, 0.0, 2.0}, 0.0, 0.0, 60.0, 10.0, 0.0, 14.0, 5.0, 2.5},
    Leg{"deck", {-2000.0, 4600.0, 1150.0}, 45.0, 0.0, 153.0, 0.0, 129.0, 0.0, 12.0, -4.0},
    Leg{"above", {-3600.0, 600.0, 2700.0}, 20.0, 6.0, 200.0, 0.0, -10.0, 0.0, -9.0, 0.0},
    // Half a degree a second is a time-lapse of 120 times: it shows how dear a sun is that does not stand still.
    Leg{"sunset", {2000.0, 3000.0, 1900.0}, 285.0, -3.0, 120.0, 0.0, -5.0, 0.0, 0.0, 0.0, 3.0, 0.5, 285.0},
};

// A frame of the flight: a scene with its camera, sun and time.
struct Moment {
  const Leg* leg = nullptr;
  int sinceCut = 0;       // frames
  bool newScene = false;  // more than camera and time differs from the frame before
  Scene scene{};
};

struct FlightOptions {
  int width = 1280, height = 720;
  int frames = kLegFrames * static_cast<int>(kLegs.size());
  QualityPreset quality = QualityPreset::high;
  int lightFrames = 0;  // 0: as the preset has it
  std::string pictures{};

  void addTo(CLI::App& app) {
    std::map<std::string, QualityPreset> presets;
    for (std::size_t i = 0; i < ChoiceNames<QualityPreset>::names.size(); ++i)
      presets[std::string(ChoiceNames<QualityPreset>::names[i])] = static_cast<QualityPreset>(i);
    app.add_option("--width", width)->check(CLI::Range(16, 8192));
    app.add_option("--height", height)->check(CLI::Range(16, 8192));
    app.add_option("--frames", frames, "of the flight; fewer than 300 fly the middle of each leg")
        ->check(CLI::Range(4, frames));
    app.add_option("--quality", quality)->transform(CLI::CheckedTransformer(presets));
    app.add_option("--light-frames", lightFrames, "in place of the preset's")->check(CLI::Range(1, 240));
    app.add_option("--pictures", pictures, "folder for some of the frames");
  }
  int legFrames() const { return frames / static_cast<int>(kLegs.size()); }
  int legOf(int frame) const { return std::min(frame / legFrames(), static_cast<int>(kLegs.size()) - 1); }
  int begin(int leg) const { return leg * legFrames(); }
  int end(int leg) const { return leg + 1 < static_cast<int>(kLegs.size()) ? begin(leg + 1) : frames; }

  Moment at(int frame) const {
    const int number = legOf(frame);
    const Leg& leg = kLegs[static_cast<std::size_t>(number)];
    Moment m{.leg = &leg, .sinceCut = frame - begin(number)};
    m.newScene = m.sinceCut == 0 || leg.sinks != 0.0;
    const double t = (m.sinceCut + (kLegFrames - legFrames()) / 2) / kFramesPerSecond;
    Scene& s = m.scene;
    s.quality = qualityPreset(quality);
    if (lightFrames > 0) s.quality.lightFrames = lightFrames;
    s.time = static_cast<float>(number * kLegFrames / kFramesPerSecond + t);
    const double heading = glm::radians(leg.heading + leg.turn * t);
    // The chord of a turn points along the mean of its headings.
    const double course = glm::radians(leg.heading + 0.5 * leg.turn * t);
    const double way = leg.speed * t + 0.5 * leg.acceleration * t * t;
    s.camera.position =
        leg.from + glm::dvec3(way * std::sin(course), way * std::cos(course), leg.climb * t + 0.5 * leg.lift * t * t);
    s.camera.heading = static_cast<float>(heading);
    s.camera.pitch = static_cast<float>(glm::radians(leg.pitch + leg.nod * t));
    s.sun.elevation = static_cast<float>(glm::radians(leg.sun - leg.sinks * t));
    s.sun.azimuth = static_cast<float>(glm::radians(leg.sunAzimuth));
    return m;
  }
};

// Draws the frame that comes after the one drawn last.
inline void draw(realtime::Offscreen& screen, const Moment& moment) {
  if (moment.sinceCut == 0) screen.view().reset();
  if (moment.newScene) screen.renderer().setScene(moment.scene);
  screen.draw(moment.scene, moment.scene.time);
}

// The same; returns the CPU seconds of all threads until it is finished.
inline double drawTimed(realtime::Offscreen& screen, const Moment& moment) {
  const double begin = cpuSeconds();
  draw(screen, moment);
  screen.finish();
  return cpuSeconds() - begin;
}

}  // namespace welkin::bench
