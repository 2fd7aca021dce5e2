#pragma once
#include <string>
#include <string_view>

namespace welkin::realtime {

// The text of a .glsl file of the house, by its path from the root ("welkin/light/phase.glsl"); empty when unknown.
std::string_view shaderSource(std::string_view path);

inline std::string shaderText(std::string_view path) { return std::string(shaderSource(path)); }

}  // namespace welkin::realtime
