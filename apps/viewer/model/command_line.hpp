#pragma once
#include <string>

#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// The command that renders `scene`: what `opened` is called, and a --set for every parameter that differs from it.
// `opened` is what "welkin render NAME" would draw.
std::string commandLine(const Scene& scene, const Scene& opened, const std::string& name);

// A word for a POSIX shell.
std::string shellQuoted(const std::string& word);

}  // namespace welkin::viewer
