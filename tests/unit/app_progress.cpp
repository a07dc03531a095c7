// SPDX-License-Identifier: GPL-3.0-or-later
// What a run that is not watched on a terminal tells of its progress.
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "app/progress.hpp"

namespace tunica {
namespace {

// A beat that takes long is told of while it lasts, by as many lines as were asked for and not more.
TEST(Progress, IsToldWithinABeatOffATerminal) {
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("progress", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const auto start = Clock::now();
  double lasted = 0;
  {
    ProgressDisplay display(false, milliseconds(50));
    for (long step = 1; lasted < 0.8; ++step) {
      display.show({0, 0, 1.6, step, 2 * step});
      std::this_thread::sleep_for(milliseconds(2));
      lasted = std::chrono::duration<double>(Clock::now() - start).count();
    }
  }
  spdlog::set_default_logger(before);
  const std::string text = log.str();
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_NE(text.find("towards the first state, step "), std::string::npos) << text;
  // Half a second is silent.
  EXPECT_GE(lines, 2) << text;
  EXPECT_LE(lines, 1 + static_cast<long>((lasted - 0.5) / 0.05) + 1) << text;
}

}  // namespace
}  // namespace tunica
