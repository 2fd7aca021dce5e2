#pragma once
// Sky files: TOML with `format = 1`, described in docs/sky_file.md. The parameters are those of
// welkin/scene/sections.hpp.
//
// A list in a file replaces the default list: a file with [[layer]], [[sheet]], [[grid]], [[classical]] or [[hero]] has
// exactly those that it names, `layer = []` has none, and a file that names none of them has the default layer.
#include <string>
#include <string_view>
#include <vector>

#include "welkin/scene/scene.hpp"

namespace welkin {

// Reads a sky. Pictures and volumes are named relative to the file's folder; the scene holds paths that can be opened.
// Throws Error (badInput) with file, line and column.
Scene loadSky(const std::string& path);

// The same for text in memory; `name` stands in errors, and relative files are looked for in its folder.
Scene parseSky(std::string_view text, const std::string& name);

// Reads a file of [[keyframe]] tables for the scene, whose own it does not count. Throws Error (badInput) as loadSky.
std::vector<Keyframe> loadKeyframes(const std::string& path, const Scene& scene);

// The sky as text that parseSky reads as the same scene: what differs from the defaults, in the order of the sections.
// Throws Error (badInput) for more of anything than a sky may have, and for keyframes of what it has not.
std::string writeSky(const Scene& scene);

// Writes it to a file, whose folder the files that it names are named from. Throws as writeSky, and Error (failed).
void saveSky(const Scene& scene, const std::string& path);

// The version of toml++ that Welkin was built with.
std::string tomlVersion();

}  // namespace welkin
