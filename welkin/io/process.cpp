#include "welkin/io/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "welkin/base/error.hpp"
#include "welkin/base/progress.hpp"

namespace welkin {

namespace {

constexpr std::size_t kKeptErrors = 4096;
constexpr int kCannotStart = 127;

[[noreturn]] void cannotStart(const std::string& program, int error) {
  throw Error(ErrorKind::failed, program,
              "cannot be started: " + std::error_code(error, std::generic_category()).message());
}

// One end of a pipe that the program writes to.
class Ear {
 public:
  explicit Ear(const std::string& program) {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) cannotStart(program, errno);
  }
  ~Ear() {
    close(0);
    close(1);
  }
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;
  int listening() const { return ends_[0]; }
  int speaking() const { return ends_[1]; }
  void leaveSpeaking() { close(1); }
  bool open() const { return ends_[0] >= 0; }
  // Appends what there is; closes at the end.
  void hear(std::string& text) {
    char block[4096];
    const ssize_t got = ::read(ends_[0], block, sizeof block);
    if (got > 0) text.append(block, static_cast<std::size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) close(0);
  }

 private:
  void close(std::size_t end) {
    if (ends_[end] >= 0) ::close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

// Only what may be called between fork and exec in a process with threads.
[[noreturn]] void becomeProgram(char* const* arguments, int output, int errors, pid_t parent) {
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (::getppid() != parent) ::_exit(kCannotStart);  // it has gone already
  for (const int number : {SIGINT, SIGPIPE, SIGTERM}) ::signal(number, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, 0);
  ::dup2(output, 1);
  ::dup2(errors, 2);
  ::execv(arguments[0], arguments);
  ::_exit(kCannotStart);
}

// Ended when this goes.
class Running {
 public:
  explicit Running(pid_t id) : id_(id) {}
  ~Running() {
    if (id_ <= 0) return;
    ::kill(-id_, SIGKILL);
    ::kill(id_, SIGKILL);  // where it has not made its group yet
    wait();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  pid_t id_;
};

}  // namespace

std::string findProgram(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path ? path : "/usr/local/bin:/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    std::string file = fmt::format("{}/{}", end == 0 ? "." : rest.substr(0, end), name);
    if (::access(file.c_str(), X_OK) == 0) return file;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "";
}

ProcessEnd runProcess(std::span<const std::string> command, const std::function<void(std::string_view line)>& line,
                      const std::function<bool()>& goOn) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Ear output(command[0]), errors(command[0]);
  const pid_t self = ::getpid(), id = ::fork();
  if (id < 0) cannotStart(command[0], errno);
  if (id == 0) becomeProgram(arguments.data(), output.speaking(), errors.speaking(), self);
  Running program(id);
  output.leaveSpeaking();
  errors.leaveSpeaking();

  ProcessEnd end;
  std::string heard;
  while (output.open() || errors.open()) {
    if (goOn && !goOn()) throw Cancelled();
    std::array<pollfd, 2> ready{pollfd{output.listening(), POLLIN, 0}, pollfd{errors.listening(), POLLIN, 0}};
    if (::poll(ready.data(), ready.size(), 100) <= 0) continue;
    if (ready[0].revents) output.hear(heard);
    if (ready[1].revents) errors.hear(end.errors);
    if (end.errors.size() > kKeptErrors) end.errors.erase(0, end.errors.size() - kKeptErrors);
    for (std::size_t stop = heard.find('\n'); stop != std::string::npos; stop = heard.find('\n')) {
      if (line) line(std::string_view(heard).substr(0, stop));
      heard.erase(0, stop + 1);
    }
  }
  end.code = program.wait();
  return end;
}

}  // namespace welkin
