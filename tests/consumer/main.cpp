#include <cstdio>

#include <welkin/base/error.hpp>
#include <welkin/io/sky_file.hpp>
#include <welkin/realtime/shader_sources.hpp>
#include <welkin/scene/sections.hpp>

int main() {
  welkin::Scene scene = welkin::parseSky("format = 1\n[sun]\nelevation = 12\n", "inline");
  welkin::setField(scene, "layer.weather.coverage=0.25");
  if (welkin::realtime::shaderSource("welkin/base/law.glsl").empty()) return 1;
  try {
    welkin::parseSky("format = 2", "inline");
    return 1;
  } catch (const welkin::Error& e) {
    std::printf("%s\n%s", e.what(), welkin::writeSky(scene).c_str());
  }
}
