// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "verification/claims.hpp"
#include "verification/readings.hpp"

namespace tunica::verification {

/// A line of notebooks_data/paper_claims.csv.
struct Claim {
  std::string id, where, geometry, law, quantity, value, unit, tolerance, note;
};

/// What runs of one reading say to a claim.
struct Answer {
  std::string ours;
  Verdict verdict = Verdict::not_answered_by_results;
  std::string note;
  bool uses_activation = false;  ///< the answer depends on the activation threshold a^2
  bool uses_exponent = false;    ///< the answer depends on the exponent of the fibre law
};

/// Whether a claim is about an artery of the paper, "cylinder" or "torus".
bool is_about(const Claim& claim, std::string_view geometry);

Answer answer(const Claim& claim, const ReadingGroup& group);

/// "75 mmHg"; the value alone for pure numbers.
std::string with_unit(const std::string& value, const std::string& unit);

}  // namespace tunica::verification
