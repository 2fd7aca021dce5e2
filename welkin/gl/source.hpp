#pragma once
// Shader text: #include expansion and version headers.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace welkin::gl {

// Answers the text of a path such as "welkin/noise/worley.glsl", empty when there is none.
using SourceResolver = std::function<std::string_view(std::string_view path)>;

struct SourcePlace {
  std::size_t file;  // index into ExpandedSource::files
  int line;          // from 1
};
struct ExpandedSource {
  std::string text;
  std::vector<std::string> files;
  std::vector<SourcePlace> lines;  // where each line of the text comes from

  // "path:line" of a line of the text, from 1.
  std::string place(std::size_t line) const;
};

// Expands every `#include "path"` once (a second inclusion of a file is empty). Lines are mapped back by `lines` rather
// than by #line, whose file numbers Mesa forgets. Throws Error (failed) for a path without text.
ExpandedSource expandIncludes(const std::string& text, const std::string& name, const SourceResolver& resolver);

}  // namespace welkin::gl
