// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "verification/sweep/axis.hpp"
#include "verification/uncertainty/design.hpp"

namespace tunica::sweep {

/// A key that differs between points, and its unit (Axis::unit).
struct Varied {
  std::string key, unit;
};

/// The points of a sweep, reached by their number, in constant memory but for lists.
class Points {
 public:
  virtual ~Points() = default;
  virtual const std::vector<Varied>& keys() const = 0;
  virtual std::uint64_t count() const = 0;
  /// Values of the keys at a point, as overrides write them. Not for several threads at once.
  virtual std::vector<std::string> values(std::uint64_t point) = 0;
  /// What the points are made of, enough to tell whether two sweeps have the same.
  virtual nlohmann::ordered_json describe() const = 0;
  /// The tier that computes a point, where points differ in it; empty: the sweep's. For any thread.
  virtual std::string tier(std::uint64_t) const { return {}; }
};

/// Every combination of the axes' values, the last axis fastest. Throws InvalidInput when a key is there
/// twice, an axis has no values (it is meant for a sample), or there are more than 2^53 points.
std::unique_ptr<Points> grid_points(std::vector<Axis> axes);

/// A sample of ranges and distributions. Throws InvalidInput for axes of a grid, and as Design does.
std::unique_ptr<Points> sample_points(std::vector<Axis> axes, uncertainty::Sampling sampling,
                                      std::uint64_t count, std::uint64_t seed);

/// A sample for Sobol' indices: `groups` of d + 2 points each for d axes, one after the other. Of two
/// independent points A and B the group has A, B, and for each axis A with that axis from B.
std::unique_ptr<Points> pick_freeze_points(std::vector<Axis> axes, uncertainty::Sampling sampling,
                                           std::uint64_t groups, std::uint64_t seed);

/// Reads "sobol:N", "lhs:N" or "random:N".
std::pair<uncertainty::Sampling, std::uint64_t> parse_sample(const std::string& text);

/// The rows of a CSV file: a header of keys, "key" or "key[unit]", then values; where a cell is empty the
/// point has what the scene says. `laws` are distributions of the keys, for surrogates that are made of the
/// points: of each key or of none. Throws InvalidInput naming file, line and column, a key without its
/// distribution, or a value that is missing or outside of it.
std::unique_ptr<Points> list_points(const std::filesystem::path& file, std::vector<Axis> laws = {});

/// "key=value" for each key that has a value.
std::vector<std::string> overrides(const Points& points, const std::vector<std::string>& values);

}  // namespace tunica::sweep
