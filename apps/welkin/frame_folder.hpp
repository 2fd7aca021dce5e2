#pragma once
// The frames of a film that are finished, as pictures in a folder: what a run that was killed leaves to the next.
#include <string>
#include <vector>

namespace welkin::app {

// own: made beside the film, and removed when it is complete. asked: named by the user, and kept.
enum class FolderKind { own, asked };

class FrameFolder {
 public:
  // Opens the folder, or makes it. `identity`: all that the frames depend on; it is written there. Throws Error
  // (badInput) when it holds frames of another film, and (failed) when another program is at work in it.
  FrameFolder(std::string path, FolderKind kind, const std::string& identity, int frames);
  ~FrameFolder();
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string file(int frame) const;
  bool has(int frame) const { return present_[static_cast<std::size_t>(frame)]; }
  int frames() const { return static_cast<int>(present_.size()); }
  int missing() const;
  void saved(int frame) { present_[static_cast<std::size_t>(frame)] = true; }
  // The film is complete: takes away what is not to be kept.
  void finish();

 private:
  void lock();
  void removeParts() const;

  std::string path_;
  FolderKind kind_;
  int lock_ = -1;
  std::vector<bool> present_;
};

}  // namespace welkin::app
