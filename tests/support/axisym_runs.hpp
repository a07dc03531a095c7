// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "axisym/axisym_tier.hpp"

namespace tunica::test_support {

/// Runs the 2D tier; a run that gives up fails the test.
inline Result run_axisym(const Scene& scene) {
  Result result = axisym::AxisymTier().prepare(scene)->execute({});
  EXPECT_EQ(result.record.failure, "");
  EXPECT_TRUE(result.record.converged);
  return result;
}

/// The paper's cylinder with `overrides`, without pictures.
inline Scene artery(std::vector<std::string> overrides) {
  overrides.emplace_back("output.field_interval=0");
  return parse_scene("[wall]\n", "artery", ".", overrides);
}

inline const std::vector<double>& values(const observables::Table& table, const std::string& column) {
  const observables::Column* found = table.find(column);
  if (!found) throw std::runtime_error("no column " + column);
  return found->values;
}

}  // namespace tunica::test_support
