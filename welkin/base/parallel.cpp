#include "welkin/base/parallel.hpp"

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace welkin {

#ifdef __SANITIZE_THREAD__

// The thread sanitizer cannot see how TBB's library synchronises, and reports every hand-over as a race. The same
// promise on plain threads, so that what it still reports is a race between bodies.
void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t workers = std::max(2u, std::thread::hardware_concurrency());
  const std::size_t length = std::max({grain, count / (4 * workers), std::size_t(1)});
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t begin; (begin = next.fetch_add(length)) < count;) body(begin, std::min(begin + length, count));
    } catch (...) {
      next = count;
      const std::lock_guard lock(guard);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < workers && i * length < count; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

#else

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain ? grain : 1),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

#endif

}  // namespace welkin
