#pragma once
// Shader text: #include expansion and version headers.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace welkin::gl {

// Answers the text of a path such as "welkin/noise/worley.glsl", empty when there is none.
using SourceResolver = std::function<std::string_view(std::string_view path)>;

struct ExpandedSource {
  std::string text;
  std::vector<std::string> files;  // files[i] is what the i in a driver's message "i:line" means
};

// Expands every `#include "path"` once (a second inclusion of a file is empty) and writes #line directives, so that
// messages of the driver point into the right file. Throws Error (failed) for a path without text.
ExpandedSource expandIncludes(const std::string& text, const std::string& name, const SourceResolver& resolver);

}  // namespace welkin::gl
