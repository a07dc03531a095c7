// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace tunica::scene {

/// One period of a measured flow or pressure at the inlet.
struct WaveformFile {
  bool is_pressure = false;   ///< dyn/cm2 if true, else cm3/s
  std::vector<double> time;   ///< s, from 0 to the period
  std::vector<double> value;  ///< at each time; the last is the first again
  double period = 0;          ///< s
};

/// Reads a CSV file with the columns `time[unit]` and `flow[unit]` or `pressure[unit]`, in either
/// order and case, any unit of the dimension, cells in double quotes or without; lines that start with # are
/// comments. Time starts at 0 and ends after one period, where the value is the first one again.
/// Throws InvalidInput (one line: file, line, value, remedy) for anything else: other columns, fewer
/// than four points, empty or non-finite cells, times that do not increase, gaps (an interval above ten
/// times the median between values that differ by more than 1e-3 of the range), or a last value that differs
/// from the first by more than that.
WaveformFile read_waveform(const std::filesystem::path& file);

}  // namespace tunica::scene
