#include "welkin/gl/source.hpp"

#include <algorithm>

#include "welkin/base/error.hpp"

namespace welkin::gl {

namespace {

void expand(std::string_view text, const std::string& name, const SourceResolver& resolver, ExpandedSource& out) {
  const std::size_t file = out.files.size();
  out.files.push_back(name);
  int line = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view current = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    ++line;
    constexpr std::string_view kInclude = "#include \"";
    if (!current.starts_with(kInclude)) {
      out.text += current;
      out.text += '\n';
      out.lines.push_back({file, line});
      continue;
    }
    const std::string path(current.substr(kInclude.size(), current.rfind('"') - kInclude.size()));
    if (std::find(out.files.begin(), out.files.end(), path) == out.files.end()) {
      const std::string_view included = resolver(path);
      if (included.empty())
        throw Error(ErrorKind::failed, name + ":" + std::to_string(line), "no shader source is called '" + path + "'");
      expand(included, path, resolver, out);
    }
  }
}

}  // namespace

std::string ExpandedSource::place(std::size_t line) const {
  if (line < 1 || line > lines.size()) return files.empty() ? "" : files.front();
  const SourcePlace& from = lines[line - 1];
  return files[from.file] + ":" + std::to_string(from.line);
}

ExpandedSource expandIncludes(const std::string& text, const std::string& name, const SourceResolver& resolver) {
  ExpandedSource out;
  expand(text, name, resolver, out);
  return out;
}

}  // namespace welkin::gl
