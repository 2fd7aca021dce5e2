#pragma once
// What a film shows: the sky and its camera at every frame.
#include <string>

#include "welkin/scene/scene.hpp"

namespace welkin::app {

// still: the sky file's camera. turntable: once round. timelapse: the day goes on too. flight: forward.
enum class ShotPath { still, turntable, timelapse, flight };

struct Shot {
  Scene scene;  // with keyframes; the film begins at its time
  ShotPath path = ShotPath::still;
  int frames = 1;
  double framesPerSecond = 25.0;
  double timeScale = 1.0;   // seconds of the sky to one of the film
  double orbit = 0.0;       // m; turntable: circles what stands so far ahead of the camera. 0: turns on the spot
  double airspeed = 150.0;  // m/s; flight

  double secondsAt(int frame) const { return frame / framesPerSecond; }
  // The sky of a frame, without keyframes.
  Scene at(int frame) const;
};

// Takes the camera's keyframes from a file, whose times are seconds of the film; those of the sky for the same
// parameters give way. Throws Error (badInput).
void followFile(Shot& shot, const std::string& path);

// All that the pictures depend on, as text.
std::string identityOf(const Shot& shot);

}  // namespace welkin::app
