#pragma once
// Runs the built command and keeps what it says.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
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

// Whether the command was built with a window.
inline bool hasViewer() {
  static const bool has = run("view --headless").err.find("built without a window") == std::string::npos;
  return has;
}

// For `environment`: files may grow to so many half kilobytes, then the disk is full.
inline std::string fullDisk(int blocks) { return "ulimit -f " + std::to_string(blocks) + "; trap '' XFSZ;"; }

// What lies in a folder, sorted, each with a space after it.
inline std::string listing(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  std::string text;
  for (const std::string& name : names) text += name + " ";
  return text;
}

}  // namespace welkin::test
