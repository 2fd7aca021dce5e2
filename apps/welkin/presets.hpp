#pragma once
// The skies that come with Welkin.
#include <string>
#include <vector>

#include "welkin/scene/scene.hpp"

namespace welkin::app {

struct Preset {
  std::string name, genus, sentence, file;
};

// The sky files of a folder, sorted by name; none when there is no such folder. Throws Error (badInput) for a file that
// is no sky.
std::vector<Preset> presetsIn(const std::string& folder);

// The file, or the preset of this name in the folder, or for an empty text the default sky. Throws Error (badInput).
Scene loadSkyNamed(const std::string& sky, const std::string& folder);

}  // namespace welkin::app
