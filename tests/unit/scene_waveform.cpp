// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/waveform_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica::scene {
namespace {

class Waveform : public testing::Test {
 protected:
  std::filesystem::path store(const char* text) const {
    auto file = folder_.path() / "wave.csv";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(Waveform, IsConvertedToCgs) {
  const WaveformFile wave = read_waveform(
      store("\xef\xbb\xbf# measured\r\n flow[ml/min] , time[ms]\r\n60, 0\r\n\r\n120,250\r\n# half\r\n"
            "180,500\r\n+6e1,1000"));
  EXPECT_FALSE(wave.is_pressure);
  EXPECT_EQ(wave.time, (std::vector<double>{0, 0.25, 0.5, 1}));
  ASSERT_EQ(wave.value.size(), 4U);
  EXPECT_DOUBLE_EQ(wave.value[0], 1);
  EXPECT_DOUBLE_EQ(wave.value[1], 2);
  EXPECT_DOUBLE_EQ(wave.value[2], 3);
  EXPECT_EQ(wave.value[3], wave.value[0]);
  EXPECT_EQ(wave.period, 1);
}

// As spreadsheets write it: every cell between quotes, capital letters and a blank in the header, and line
// ends of another system.
TEST_F(Waveform, IsReadAsSpreadsheetsWriteIt) {
  const WaveformFile plain = read_waveform(store("time[s],flow[ml/s]\n0,5\n0.25,8\n0.5,5\n0.75,2\n1,5\n"));
  for (const char* text :
       {"\"time[s]\",\"flow[ml/s]\"\n\"0.00\",\"5\"\n\"0.25\",\"8\"\n\"0.50\",\"5\"\n\"0.75\",\"2\"\n"
        "\"1.00\",\"5\"\n",
        "Time [s], FLOW[mL/s]\r0,5\r0.25,8\r0.5,5\r0.75,2\r1,5",
        "\xef\xbb\xbf\"Time[s]\" , \" Flow [ml/s] \"\r\n0,5\r\n0.25,\" 8 \"\r\n0.5,5\r\n0.75,2\r\n1,5\r\n"}) {
    const WaveformFile other = read_waveform(store(text));
    EXPECT_EQ(other.time, plain.time) << text;
    EXPECT_EQ(other.value, plain.value) << text;
    EXPECT_FALSE(other.is_pressure);
  }
}

// A published inflow: an ejection by its points, and a diastole without flow by its two ends.
TEST_F(Waveform, MayBeConstantOverAnyTime) {
  std::string text = "time[s],flow[ml/s]\n";
  for (int k = 0; k <= 15; ++k)
    text += fmt::format("{:.2f},{:.6f}\n", 0.02 * k, k == 15 ? 0 : 400 * std::sin(M_PI * k / 15));
  const WaveformFile wave = read_waveform(store((text + "1.00,0\n").c_str()));
  EXPECT_EQ(wave.time.size(), 17U);
  EXPECT_EQ(wave.period, 1);
  // Between other values it is a gap.
  EXPECT_THROW(read_waveform(store((text + "0.98,5\n1.00,0\n").c_str())), InvalidInput);
}

TEST_F(Waveform, OfPressureClosesExactly) {
  const WaveformFile wave =
      read_waveform(store("time[s],pressure[mmHg]\n0,80\n0.2,120\n0.4,100\n0.8,80.039\n"));
  EXPECT_TRUE(wave.is_pressure);
  EXPECT_DOUBLE_EQ(wave.value[1], 120 * 1333.22387);
  EXPECT_EQ(wave.value.back(), wave.value.front());
}

TEST_F(Waveform, BringsItsPeriodIntoTheScene) {
  store("time[s],flow[cm3/s]\n0,1\n0.1,2\n0.2,3\n0.4,1\n");
  const Scene scene = parse_scene(
      "[geometry]\nradius = 0.2\n[outlet]\nresistance = 6e4\n[inlet]\nwaveform = \"wave.csv\"\nperiod = "
      "0.9\nflow = 2\n",
      "test", folder_.path());
  EXPECT_EQ(scene.number("inlet.period"), 0.4);
  EXPECT_DOUBLE_EQ(scene.numbers("output.profile_times").back(), 0.3);
  EXPECT_FALSE(scene.has("inlet.flow"));
  EXPECT_EQ(scene.remarks().size(), 2U);
}

}  // namespace
}  // namespace tunica::scene
