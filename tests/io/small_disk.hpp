#pragma once
// A full disk without one: no file of this process may grow beyond a size.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin::test {

// While it lives no file may grow beyond `most` bytes. A write beyond that fails, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t most) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{most, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &old_); }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit old_{};
};

// However early or late the disk is full, `write(path)` ends in an Error that names the file, the file stays as it was,
// and nothing else stays in its folder, which must be the test's own. The last byte matters most: streams hold back
// thousands of bytes until they are closed, where no one may look for an error any more.
inline void expectOldFileOnFullDisk(const std::string& path, const std::function<void(const std::string&)>& write) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  write(path);
  const std::size_t whole = fs::file_size(path);
  ASSERT_GT(whole, 16384u) << "too small to be held back in part only";
  fs::remove_all(folder);
  fs::create_directories(folder);
  writeFileAtomically(path, "old");
  for (const std::size_t most :
       {std::size_t{0}, std::size_t{100}, whole / 2, whole - 8192, whole - 1000, whole - 100, whole - 1}) {
    std::string said = "succeeded";
    {
      const SmallDisk disk(most);
      try {
        write(path);
      } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::failed);
        said = e.what();
      }
    }
    EXPECT_TRUE(said.starts_with(path + ": cannot be written")) << most << " of " << whole << " bytes: " << said;
    EXPECT_TRUE(readFile(path, std::size_t{1} << 30) == "old") << most << " of " << whole << " bytes";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << most << " of " << whole << " bytes";
  }
}

}  // namespace welkin::test
