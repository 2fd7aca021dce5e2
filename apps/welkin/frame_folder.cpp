#include "apps/welkin/frame_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/video.hpp"

namespace welkin::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestIdentity = 1 << 22;

std::string identityFile(const std::string& folder) { return folder + "/film.txt"; }

}  // namespace

FrameFolder::FrameFolder(std::string path, FolderKind kind, const std::string& identity, int frames)
    : path_(std::move(path)), kind_(kind), present_(static_cast<std::size_t>(frames)) {
  std::error_code error;
  fs::create_directory(path_, error);
  if (error) throw Error(ErrorKind::failed, path_, "cannot be made: " + error.message());
  lock();
  removeParts();
  for (int i = 0; i < frames; ++i) present_[static_cast<std::size_t>(i)] = fs::exists(file(i), error);
  const std::string known = identityFile(path_);
  if (fs::exists(known, error) ? readFile(known, kLongestIdentity) != identity : missing() < frames)
    throw Error(ErrorKind::badInput, path_,
                "holds frames of another film: of another sky, size, length or setting; delete it, or name another "
                "folder with --frames");
  writeFileAtomically(known, identity);
}

FrameFolder::~FrameFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void FrameFolder::lock() {
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(ErrorKind::failed, path_, "is in use: another welkin draws frames into it; wait until it has ended");
}

std::string FrameFolder::file(int frame) const { return path_ + "/" + frameName(frame); }

int FrameFolder::missing() const { return static_cast<int>(std::count(present_.begin(), present_.end(), false)); }

// What killed runs have left half-written; nobody else is at work here.
void FrameFolder::removeParts() const {
  std::error_code ignored;
  std::vector<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(path_, ignored))
    if (entry.path().extension() == ".part") parts.push_back(entry.path());
  for (const fs::path& part : parts) fs::remove(part, ignored);
}

void FrameFolder::finish() {
  if (kind_ == FolderKind::asked) return;
  std::error_code ignored;
  for (int i = 0; i < frames(); ++i) fs::remove(file(i), ignored);
  fs::remove(identityFile(path_), ignored);
  fs::remove(path_, ignored);  // does nothing when the user keeps something there
}

}  // namespace welkin::app
