// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <vector>

#include "core/threads.hpp"

namespace tunica {
namespace {

bool does_all(int threads) {
  std::vector<std::atomic<int>> done(1000);
  for_each_index(threads, static_cast<int>(done.size()), [&](int k) { ++done[k]; });
  return std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; });
}

TEST(Threads, DoEachPieceOnce) {
  for (const int threads : {1, 2, 7}) EXPECT_TRUE(does_all(threads));
}

// Stacks of new threads find no addresses, as where a batch system limits memory or processes.
TEST(Threads, ThatCannotStartAreDoneWithout) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP();
#endif
  const pid_t child = ::fork();
  if (child == 0) {
    long pages = 0;
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (!file || std::fscanf(file, "%ld", &pages) != 1) ::_exit(2);
    if (std::fclose(file) != 0) ::_exit(2);
    const rlim_t room = static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + 2'000'000;
    const rlimit size{room, room};
    if (::setrlimit(RLIMIT_AS, &size) != 0) ::_exit(2);
    // Stacks of threads that have ended are kept for others: they are used up first.
    std::atomic<bool> is_over = false;
    std::vector<std::jthread> idle;
    bool starts = true;
    try {
      for (int k = 0; k < 1000; ++k) idle.emplace_back([&] { is_over.wait(false); });
    } catch (const std::system_error&) {
      starts = false;
    }
    const bool all = does_all(8);
    is_over = true;
    is_over.notify_all();
    idle.clear();
    ::_exit(starts ? 3 : all ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0)
      << "1: not all was done, 2: no limit can be set, 3: threads start all the same";
}

}  // namespace
}  // namespace tunica
