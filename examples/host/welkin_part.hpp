#pragma once
// All that this host has to do with Welkin.
#include <array>

#include "engine.hpp"
#include "welkin/realtime/renderer.hpp"

class Clouds {
 public:
  explicit Clouds(const welkin::Scene& sky);
  // Before the opaque surfaces of a view: their program gets light, shade and air.
  void light(std::size_t view, const host::Engine& engine, const host::Eye& eye, const host::Target& target,
             double time);
  // After them: sky and clouds, and light and clouds for what is transparent.
  void draw(std::size_t view, const host::Engine& engine, const host::Eye& eye, const host::Target& target,
            double time);

 private:
  welkin::realtime::Renderer renderer_;
  std::array<welkin::realtime::View, 2> views_;  // one for each of the host's cameras
};
