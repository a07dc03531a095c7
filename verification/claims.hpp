// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica::verification {

enum class Verdict {
  agrees,                  ///< a number within the stated tolerance of the paper's
  disagrees,               ///< a number outside it, or a statement that our run contradicts
  qualitative_agreement,   ///< a statement that our run bears out, by the criterion in `about`
  not_answered_by_tier,    ///< the model that ran cannot tell
  not_answered_by_results  ///< it could, but the law was not run or the column was not written
};
std::string_view to_text(Verdict verdict);

/// One claim of the paper beside what runs of the same scene gave, as text for people.
struct ClaimRow {
  std::string id;
  std::string where;     ///< section and figure of the paper
  std::string law;       ///< "all", or the law or laws it is about
  std::string quantity;  ///< what is claimed
  std::string paper;     ///< the paper's value with unit; empty for a statement
  std::string ours;      ///< ours with unit, for each law
  std::string tolerance;
  std::string about;    ///< how the claim is stated, and the criterion for a statement
  std::string reading;  ///< tier and how misprints were read: tether, a^2, exponent of the fibre law
  Verdict verdict = Verdict::not_answered_by_results;
  std::string note;  ///< what else these runs say
};

struct Comparison {
  std::vector<ClaimRow> rows;         ///< claim by claim, for each reading that matters to it; empty
                                      ///< without a usable run
  std::vector<std::string> left_out;  ///< runs not compared and why, one line each
};

/// Sets the paper's claims (notebooks_data/paper_claims.csv) beside runs of its two arteries, over their last
/// beat. Runs are taken together by artery, tier and reading. A run of another scene, or without a whole
/// beat, is left out; `names`, one for each run, are what such a run is called by: its folder and law when
/// empty.
Comparison compare_with_paper(const std::vector<StoredResult>& runs, std::vector<std::string> names = {});

/// How the paper's misprints and omissions were read in a run: "tether normal, a2 = 1.6740, exponent 2".
std::string reading_of(const StoredResult& run);

/// Keys in which a run's scene differs from the paper's straight artery or, for a torus, its bent one, as
/// "key = value (paper: value)". The law and the choices named by reading_of are no difference.
std::vector<std::string> differences_from_paper(const StoredResult& run);

/// The comparison as the table of docs/reproduction.md: GitHub Markdown, deterministic.
std::string to_markdown(const Comparison& comparison);

}  // namespace tunica::verification
