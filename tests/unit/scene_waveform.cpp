// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

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

TEST_F(Waveform, OfPressureClosesExactly) {
  const WaveformFile wave =
      read_waveform(store("time[s],pressure[mmHg]\n0,80\n0.2,120\n0.4,100\n0.8,80.039\n"));
  EXPECT_TRUE(wave.is_pressure);
  EXPECT_DOUBLE_EQ(wave.value[1], 120 * 1333.22387);
  EXPECT_EQ(wave.value.back(), wave.value.front());
}

TEST_F(Waveform, BringsItsPeriodIntoTheScene) {
  store("time[s],flow[cm3/s]\n0,1\n0.1,2\n0.2,3\n0.4,1\n");
  const Scene scene =
      parse_scene("[inlet]\nwaveform = \"wave.csv\"\nperiod = 0.9\nflow = 2\n", "test", folder_.path());
  EXPECT_EQ(scene.number("inlet.period"), 0.4);
  EXPECT_DOUBLE_EQ(scene.numbers("output.profile_times").back(), 0.3);
  EXPECT_FALSE(scene.has("inlet.flow"));
  EXPECT_EQ(scene.remarks().size(), 2U);
}

}  // namespace
}  // namespace tunica::scene
