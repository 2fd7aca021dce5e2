#pragma once
// Runs the built command and keeps what it says.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace welkin::test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// `arguments` as a shell reads them; `environment` such as "A=b" comes before the command.
inline Outcome run(const std::string& arguments, const std::string& environment = "") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("welkin_run_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string out = (folder / "out").string(), err = (folder / "err").string();
  const std::string line =
      environment + " '" + WELKIN_BINARY_DIR + "/bin/welkin' " + arguments + " >" + out + " 2>" + err;
  const int status = std::system(line.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
  std::filesystem::remove_all(folder);
  return outcome;
}

}  // namespace welkin::test
