// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/observables/beat.hpp"
#include "core/observables/result.hpp"

namespace tunica::verification {

/// A run that can be compared: one of the paper's two arteries with a whole beat.
struct ComparedRun {
  const StoredResult* stored = nullptr;
  std::string law;
  observables::Beat beat;

  const observables::Table& table() const { return stored->result.observables; }
};

/// How a run read what the paper leaves open. Isotropic laws have no activation and no exponent.
struct Reading {
  std::string tier;
  std::string geometry;  ///< "cylinder" or "torus"
  std::string tether;
  double activation_squared = observables::none;  ///< a^2 of EXP1+EXP2-FS
  long exponent = 0;                              ///< 0 without fibres
};

/// Runs of one artery and tier with one reading, at most one of each law.
struct ReadingGroup {
  Reading reading;
  std::vector<ComparedRun> runs;  ///< in the paper's order: EXP1, EXP2, ZS, FS

  const ComparedRun* find(std::string_view law) const;
};

/// The paper's four laws, in its order, and their short names.
struct PaperLaw {
  std::string_view name;
  std::string_view label;
};
inline constexpr PaperLaw paper_laws[] = {
    {"EXP1", "EXP1"}, {"EXP2", "EXP2"}, {"EXP1+EXP2-ZS", "ZS"}, {"EXP1+EXP2-FS", "FS"}};
std::string_view short_name(std::string_view law);

Reading read_reading(const StoredResult& run);

/// Sorts runs by artery, tier and reading. What cannot be compared is told in `left_out`, by the run's name.
std::vector<ReadingGroup> group_by_reading(const std::vector<StoredResult>& runs,
                                           const std::vector<std::string>& names,
                                           std::vector<std::string>& left_out);

/// Text of the parts of a reading that matter for laws with fibres, or for isotropic ones alone.
std::string to_text(const Reading& reading, bool with_activation, bool with_exponent);

}  // namespace tunica::verification
