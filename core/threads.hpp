// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace tunica {

/// While one is there, available_threads() of the thread that made it is no more than its limit: work that is
/// one of many pieces side by side leaves the other cores to them.
class ThreadLimit {
 public:
  explicit ThreadLimit(int limit) : before_(current()) { current() = limit; }
  ~ThreadLimit() { current() = before_; }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// Of this thread; 0 for none.
  static int& current() {
    thread_local int limit = 0;
    return limit;
  }

 private:
  int before_;
};

/// Cores that this thread may use: under taskset, or in a container, fewer than the machine has.
inline int available_threads() {
  if (ThreadLimit::current() > 0) return ThreadLimit::current();
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

/// Calls body(k) for k = 0 to count - 1, in any order, side by side. The threads are made for the call and
/// are gone after it, so that none takes time while it has nothing to do; that costs some 20 microseconds
/// each, for work of a millisecond or more. The body must not throw.
template <class Body>
void for_each_index(int threads, int count, const Body& body) {
  constexpr int chunk = 4;
  threads = std::min(threads, (count + chunk - 1) / chunk);
  if (threads <= 1) {
    for (int k = 0; k < count; ++k) body(k);
    return;
  }
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int first = next.fetch_add(chunk); first < count; first = next.fetch_add(chunk))
      for (int k = first; k < std::min(first + chunk, count); ++k) body(k);
  };
  std::vector<std::jthread> others;
  try {
    for (int t = 1; t < threads; ++t) others.emplace_back(work);
  } catch (const std::system_error&) {
    // The system starts no more: those that there are do all the work.
  }
  work();
}

}  // namespace tunica
