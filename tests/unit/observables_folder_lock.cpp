// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <thread>

#include "core/error.hpp"
#include "core/observables/folder_lock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;

std::string refusal(const fs::path& folder) {
  try {
    const FolderLock lock(folder);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FolderLock, IsForOneAndNamesItsHolder) {
  const TemporaryFolder folder;
  std::optional<FolderLock> lock(folder.path());
  const std::string message = refusal(folder.path());
  EXPECT_NE(message.find("process " + std::to_string(::getpid()) + " on "), std::string::npos) << message;
  EXPECT_NE(message.find("--out"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  lock.reset();
  EXPECT_TRUE(fs::is_empty(folder.path())) << "a lock that is gone leaves nothing";
  EXPECT_EQ(refusal(folder.path()), "");
}

TEST(FolderLock, EndsWithAProcessThatIsKilled) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    [[maybe_unused]] const auto written = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_NE(refusal(folder.path()).find("process " + std::to_string(child)), std::string::npos);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(folder.path() / ".lock")) << "nothing is tidied up by a process that is killed";
  EXPECT_EQ(refusal(folder.path()), "");
}

TEST(FolderLock, IsWaitedForWithPatience) {
  const TemporaryFolder folder;
  std::optional<FolderLock> lock(folder.path());
  std::thread holder([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    lock.reset();
  });
  EXPECT_NO_THROW(FolderLock(folder.path(), std::chrono::seconds(20)));
  holder.join();
}

// Processes that take the lock, hold it and let it go, each seeing whether it is alone.
TEST(FolderLock, IsNeverHeldTwice) {
  const TemporaryFolder folder, place;
  const fs::path inside = place.path() / "inside";
  constexpr int processes = 4;
  std::vector<pid_t> children;
  for (int k = 0; k < processes; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      int taken = 0;
      for (int tried = 0; tried < 100000 && taken < 200; ++tried) try {
          const FolderLock lock(folder.path());
          if (!fs::create_directory(inside)) ::_exit(1);
          fs::remove(inside);
          ++taken;
        } catch (const InvalidInput&) {
        } catch (...) {
          ::_exit(2);
        }
      ::_exit(taken > 0 ? 0 : 3);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
}

}  // namespace
}  // namespace tunica
