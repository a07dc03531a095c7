// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "core/observables/stops.hpp"

namespace tunica::observables {
namespace {

Scene scene_with(const std::string& output, const std::string& time = "beats = 2") {
  return parse_scene("[output]\n" + output + "\n[time]\n" + time + "\n", "some", ".");
}

template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

constexpr double period = 0.8;

TEST(Stops, OfOneStateAreOne) {
  const Scene scene = scene_with("field_interval = 1e-3", "mode = \"static\"");
  EXPECT_EQ(stops(scene, period).size(), 1U);
}

// 1601 rows of 26 numbers and 33 pictures of a million numbers, the former with 20 characters for each.
TEST(Stops, AreHeldAgainstMemory) {
  const Scene scene = scene_with("interval = 1e-3\nfield_interval = 0.05\nprofile_times = [0.6]");
  const auto all = stops(scene, period);
  ASSERT_EQ(std::count_if(all.begin(), all.end(), [](const Stop& stop) { return stop.is_row; }), 1601);
  ASSERT_EQ(std::count_if(all.begin(), all.end(), [](const Stop& stop) { return stop.is_field; }), 33);
  constexpr double copies = 5, needed = 1601 * 26 * (8 * copies + 20) + 33 * 1e6 * 4 * copies;
  const auto with = [&](std::size_t columns, std::size_t numbers, double available) {
    return refusal([&] { check_output_memory(scene, all, columns, numbers, copies, available); });
  };
  EXPECT_EQ(with(26, 1000000, 1.001 * needed), "");
  const std::string pictures = with(26, 1000000, 0.999 * needed);
  EXPECT_NE(pictures.find("output.field_interval = 0.05 s makes 33 pictures"), std::string::npos) << pictures;
  EXPECT_NE(with(26000, 10, 1e6).find("output.interval = 0.001 s makes 1601 rows"), std::string::npos);
  EXPECT_EQ(refusal([&] { check_output_memory(scene, all, 26, 1000000000, copies, std::nullopt); }), "");
}

}  // namespace
}  // namespace tunica::observables
