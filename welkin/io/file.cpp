#include "welkin/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "welkin/base/error.hpp"

namespace welkin {

namespace {

// An open file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  int close() {
    const int result = fd_ < 0 ? 0 : ::close(fd_);
    fd_ = -1;
    return result;
  }

 private:
  int fd_;
};

[[noreturn]] void cannotWrite(const std::string& path, int error) {
  const char* advice = error == ENOSPC                     ? "; free some space and try again"
                       : error == ENOENT                   ? "; make the folder first"
                       : error == EACCES || error == EROFS ? "; choose a folder that you may write to"
                                                           : "";
  throw Error(ErrorKind::failed, path, fmt::format("cannot be written: {}{}", systemReason(error), advice));
}

}  // namespace

std::string systemReason(int error) { return std::error_code(error, std::generic_category()).message(); }

std::string readFile(const std::string& path, std::size_t most) {
  const auto refuse = [&](const std::string& why) -> void {
    throw Error(ErrorKind::badInput, path, "cannot be read: " + why);
  };
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) refuse(systemReason(errno));
  std::string bytes;
  char block[1 << 16];
  for (;;) {
    const ssize_t got = ::read(file.get(), block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(systemReason(errno));
    if (got == 0) return bytes;
    bytes.append(block, static_cast<std::size_t>(got));
    if (bytes.size() > most) refuse(fmt::format("it is longer than {} bytes", most));
  }
}

void writeBytes(const std::string& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) cannotWrite(path, errno);
  while (!bytes.empty()) {
    const ssize_t put = ::write(file.get(), bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) cannotWrite(path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  if (file.close() != 0) cannotWrite(path, errno);
}

void writeFileAtomically(const std::string& path, const std::function<void(const std::string& temporary)>& write) {
  static std::atomic<unsigned> count{0};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) cannotWrite(path, EISDIR);
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return write(path);  // a device or pipe: there is nothing to replace
  const std::filesystem::path target =
      std::filesystem::is_symlink(path, ignored) ? std::filesystem::canonical(path) : std::filesystem::path(path);
  const std::string temporary =
      (target.parent_path() / fmt::format(".{}.{}.{}.part", target.filename().string(), ::getpid(), count++)).string();
  // Made here so that a folder that cannot be written to is told apart from whatever `write` runs into.
  const int made = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) cannotWrite(path, errno);
  ::close(made);
  try {
    write(temporary);
    // A full disk may show only when the data reach it.
    Descriptor written(::open(temporary.c_str(), O_RDONLY | O_CLOEXEC));
    if (written.get() < 0 || ::fsync(written.get()) != 0) cannotWrite(path, errno);
    if (::rename(temporary.c_str(), target.c_str()) != 0) cannotWrite(path, errno);
  } catch (const Error& e) {
    ::unlink(temporary.c_str());
    if (e.where() != temporary) throw;
    throw Error(e.kind(), path, std::string(e.what()).substr(temporary.size() + 2));
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void requireWritable(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) cannotWrite(path, EISDIR);
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!std::filesystem::is_directory(folder, ignored)) cannotWrite(path, ENOENT);
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK, AT_EACCESS) != 0) cannotWrite(path, errno);
}

void writeFileAtomically(const std::string& path, std::string_view bytes) {
  writeFileAtomically(path, [&](const std::string& temporary) { writeBytes(temporary, bytes); });
}

void writeStreamAtomically(const std::string& path, const char* format,
                           const std::function<void(std::ostream& stream)>& write) {
  writeFileAtomically(path, [&](const std::string& temporary) {
    const auto refuse = [&](const char* why) {
      throw Error(ErrorKind::failed, path, fmt::format("cannot be written as {}: {}", format, why));
    };
    constexpr const char* kFull = "no space is left, or the file is too large";
    std::ofstream stream(temporary, std::ios::binary);
    try {
      write(stream);
      stream.close();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      refuse(stream ? e.what() : kFull);
    }
    if (!stream) refuse(kFull);
  });
}

}  // namespace welkin
