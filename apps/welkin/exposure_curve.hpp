#pragma once
// Automatic exposure of a film: measured at moments along it, so that every frame's is known without those before it,
// and smoothed in time, so that it neither flickers nor jumps.
#include <functional>
#include <vector>

#include "apps/welkin/shot.hpp"
#include "welkin/base/image.hpp"

namespace welkin::app {

class ExposureCurve {
 public:
  // `picture` draws a small picture of a frame; it is asked only where the film exposes automatically.
  ExposureCurve(const Shot& shot, const std::function<Image(int frame)>& picture);
  // EV100 for a frame at this second, compensation not taken off.
  double ev(const Film& film, double seconds) const;

 private:
  struct Reading {
    double seconds, ev;
  };
  std::vector<Reading> readings_;
};

}  // namespace welkin::app
