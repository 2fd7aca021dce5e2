// embed_shaders ROOT OUT FILE...: writes OUT, a C++ file holding the text of every FILE (paths relative to ROOT).
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: embed_shaders ROOT OUT FILE...\n";
    return 2;
  }
  std::ostringstream out;
  out << "#include \"welkin/realtime/shader_sources.hpp\"\n\nnamespace welkin::realtime {\n\n"
         "std::string_view shaderSource(std::string_view path) {\n";
  for (int i = 3; i < argc; ++i) {
    std::ifstream in(std::string(argv[1]) + "/" + argv[i]);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) {
      std::cerr << "embed_shaders: cannot read " << argv[i] << "\n";
      return 1;
    }
    out << "  if (path == \"" << argv[i] << "\")\n    return R\"WELKIN_GLSL(" << text.str() << ")WELKIN_GLSL\";\n";
  }
  out << "  return {};\n}\n\n}  // namespace welkin::realtime\n";
  std::ofstream file(argv[2]);
  file << out.str();
  return file.flush() ? 0 : 1;
}
