#pragma once
// What benchmarks share: CPU time of the process, medians, an off-screen target.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace welkin::bench {

inline double secondsOf(int whose) {
  rusage usage{};
  getrusage(whose, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// User and system seconds of all threads of this process; of the processes that it has started and that have ended.
inline double cpuSeconds() { return secondsOf(RUSAGE_SELF); }
inline double childSeconds() { return secondsOf(RUSAGE_CHILDREN); }

inline double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace welkin::bench
