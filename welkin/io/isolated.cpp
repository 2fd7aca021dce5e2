#include "welkin/io/isolated.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <new>
#include <system_error>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  std::array<int, 2> ends{-1, -1};  // read, write
  explicit Pipe(const std::string& where) {
    if (::pipe(ends.data()) != 0)
      throw Error(ErrorKind::failed, where, "cannot be read in a process of its own: " + systemReason(errno));
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe() { closeRead(), closeWrite(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void closeRead() { close(ends[0]); }
  void closeWrite() { close(ends[1]); }

 private:
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

void writeAll(int to, const void* bytes, std::size_t count) {
  const char* at = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t put = ::write(to, at, count);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) throw std::runtime_error("nobody reads");
    at += put;
    count -= static_cast<std::size_t>(put);
  }
}

void limit(int resource, rlim_t most) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) return;
  now.rlim_cur = now.rlim_max == RLIM_INFINITY ? most : std::min<rlim_t>(most, now.rlim_max);
  ::setrlimit(resource, &now);
}

// Address space that the process uses now; 0 where the system does not tell.
std::size_t addressSpace() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// The child: never returns.
[[noreturn]] void runChild(const IsolationLimits& limits, std::size_t used,
                           const std::function<void(const Sink&)>& work, int data, int complaint) {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(number, SIG_DFL);
  ::signal(SIGPIPE, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int standard : {0, 1, 2}) ::dup2(nowhere, standard);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds) + 1);
  if (used > 0) limit(RLIMIT_AS, used + limits.bytes);
  const auto complain = [&](ErrorKind kind, const std::string& what) {
    const char letter = kind == ErrorKind::failed ? 'f' : 'b';
    try {
      writeAll(complaint, &letter, 1);
      writeAll(complaint, what.data(), std::min<std::size_t>(what.size(), 1024));
    } catch (...) {
    }
    ::_exit(1);
  };
  try {
    work([&](const void* bytes, std::size_t count) { writeAll(data, bytes, count); });
    ::_exit(0);
  } catch (const Error& e) {
    const std::string what = e.what();
    complain(e.kind(), e.where().empty() ? what : what.substr(e.where().size() + 2));
  } catch (const std::bad_alloc&) {
    complain(ErrorKind::badInput,
             fmt::format("asks for more than {} MiB of memory; it is damaged or too large", limits.bytes >> 20));
  } catch (const std::exception& e) {
    complain(ErrorKind::badInput, std::string("cannot be read: ") + e.what());
  } catch (...) {
  }
  ::_exit(1);
}

// The child as the parent sees it; ended when this goes.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_;
};

}  // namespace

void runIsolated(const std::string& where, const IsolationLimits& limits, const std::function<void(const Sink&)>& work,
                 const std::function<void(const Source&)>& receive) {
  Pipe data(where), complaint(where);
  const std::size_t used = addressSpace();
  const pid_t id = ::fork();
  if (id < 0) throw Error(ErrorKind::failed, where, "cannot be read in a process of its own: " + systemReason(errno));
  if (id == 0) runChild(limits, used, work, data.ends[1], complaint.ends[1]);
  Child child(id);
  data.closeWrite();
  complaint.closeWrite();
  const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(static_cast<long>(1e3 * limits.seconds));

  // The next bytes from a pipe; 0 at its end.
  const auto some = [&](const Pipe& from, void* bytes, std::size_t most) {
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      pollfd ready{from.ends[0], POLLIN, 0};
      const int answer = left > 0 ? ::poll(&ready, 1, static_cast<int>(std::min<long>(left, 1 << 20))) : 0;
      if (answer == 0 && left <= 0)
        throw Error(ErrorKind::badInput, where,
                    fmt::format("takes more than {:g} s to read; it is damaged or too large", limits.seconds));
      if (answer <= 0) continue;
      const ssize_t got = ::read(from.ends[0], bytes, most);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) throw Error(ErrorKind::failed, where, "cannot be read: " + systemReason(errno));
    }
  };
  // Throws what the child has to say about its end, if it was not a good one.
  const auto judge = [&](const char* otherwise) {
    std::string text;
    char block[1025];
    while (const std::size_t got = some(complaint, block, sizeof block)) text.append(block, got);
    const int status = child.wait();
    if (!text.empty()) throw Error(text[0] == 'f' ? ErrorKind::failed : ErrorKind::badInput, where, text.substr(1));
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || otherwise)
      throw Error(ErrorKind::badInput, where, "is damaged: reading it ended in a crash");
  };
  receive([&](void* bytes, std::size_t count) {
    char* at = static_cast<char*>(bytes);
    while (count > 0) {
      const std::size_t got = some(data, at, count);
      if (got == 0) judge("it ended early");
      at += got;
      count -= got;
    }
  });
  data.closeRead();
  judge(nullptr);
}

}  // namespace welkin
