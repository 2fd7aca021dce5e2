// Bytes of all textures and targets at 1920x1080, default sky, for each quality that a budget
// is set for.
#include <fmt/format.h>

#include <string>

#include "welkin/realtime/offscreen.hpp"

int main() {
  welkin::realtime::Offscreen screen(1920, 1080);
  std::string json;
  for (const auto preset : {welkin::QualityPreset::low, welkin::QualityPreset::medium, welkin::QualityPreset::high}) {
    welkin::Scene scene;
    scene.quality = welkin::qualityPreset(preset);
    screen.renderer().setScene(scene);
    screen.draw(scene, 0.0);
    const std::string_view name = welkin::ChoiceNames<welkin::QualityPreset>::names[static_cast<std::size_t>(preset)];
    fmt::print("\nquality {}\n{:<26}{:<10}{:>18}{:>12}\n", name, "texture", "format", "size", "bytes");
    std::size_t total = 0;
    std::string rows;
    for (const auto& row : screen.renderer().memory(screen.view())) {
      const std::string size = row.depth > 0 ? fmt::format("{}x{}x{}", row.width, row.height, row.depth)
                                             : fmt::format("{}x{}", row.width, row.height);
      fmt::print("{:<26}{:<10}{:>18}{:>12}\n", row.name, row.format, size, row.bytes);
      rows += fmt::format("{}{{\"name\": \"{}\", \"format\": \"{}\", \"size\": \"{}\", \"bytes\": {}}}",
                          rows.empty() ? "" : ", ", row.name, row.format, size, row.bytes);
      total += row.bytes;
    }
    fmt::print("{:<26}{:>40}\n", "total", total);
    json +=
        fmt::format("{}\"{}_total_bytes\": {}, \"{}_table\": [{}]", json.empty() ? "" : ", ", name, total, name, rows);
  }
  fmt::print("{{{}}}\n", json);
}
