// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the answers of answers.cpp and fiber_answers.cpp share.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "verification/answers.hpp"

namespace tunica::verification {

inline constexpr std::string_view fs_law = "EXP1+EXP2-FS";
inline constexpr std::string_view zs_law = "EXP1+EXP2-ZS";

Answer needs(std::string_view what);
inline Verdict numeric(bool within) {
  return within ? Verdict::agrees : Verdict::disagrees;
}
inline Verdict qualitative(bool holds) {
  return holds ? Verdict::qualitative_agreement : Verdict::disagrees;
}
double number_of(const std::string& text);
std::string range_text(const observables::Range& range, int decimals);

/// Times of the rows of a beat, counted from its start.
std::vector<double> times_in_beat(const ComparedRun& run);
double value_in_beat(const ComparedRun& run, std::string_view column, double time);
/// Time of the run at which the inflow of its last beat peaks.
double systole(const ComparedRun& run);

/// The answer to a claim about fibres or about the wall of one law, by the claim's id; empty when the id is
/// none of these.
using Answerer = std::function<Answer(const Claim&, const ReadingGroup&)>;
Answerer fiber_answerer(const std::string& id);

}  // namespace tunica::verification
