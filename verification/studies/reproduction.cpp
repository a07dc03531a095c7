// SPDX-License-Identifier: GPL-3.0-or-later
// docs/reproduction.md: the paper's straight artery under the four wall laws and the three readings of the
// tether, and what other readings of the fibre law change. Results are kept as TETHER/LAW and
// fibers/NUMBER.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/observables/result.hpp"
#include "verification/claims.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

/// How many claims got which verdict, a line for each reading of the tether.
std::string tally(const Comparison& comparison, const std::vector<std::string>& tethers) {
  constexpr Verdict columns[] = {Verdict::agrees, Verdict::qualitative_agreement, Verdict::disagrees};
  std::string text = "| Tether |";
  std::string rule = "|---|";
  for (const Verdict verdict : columns) {
    text += fmt::format(" {} |", to_text(verdict));
    rule += "---:|";
  }
  text += "\n" + rule + "\n";
  for (const std::string& tether : tethers) {
    text += fmt::format("| `{}` |", tether);
    for (const Verdict verdict : columns)
      text += fmt::format(
          " {} |", std::count_if(comparison.rows.begin(), comparison.rows.end(), [&](const ClaimRow& row) {
            return row.verdict == verdict && row.reading.find("tether\u00a0" + tether) != std::string::npos;
          }));
    text += "\n";
  }
  text += fmt::format(
      "\nThe 0D tier does not answer {} claims: what it assumes, and what is about the torus.\n",
      std::count_if(comparison.rows.begin(), comparison.rows.end(),
                    [](const ClaimRow& row) { return row.verdict == Verdict::not_answered_by_tier; }));
  return text;
}

/// The rows on which the reading of the fibre law bears, of readings that `known` has not.
Comparison what_changes(const Comparison& all, const Comparison& known) {
  constexpr std::string_view ids[] = {"du_over_R0",  "fs_angle_hb",  "fs_angle_sys",    "fs_angle_change",
                                      "zs_angle_hb", "zs_angle_sys", "zs_angle_change", "fs_P1",
                                      "fs_P23",      "fs_P4",        "zs_always",       "vm_fs_lowest"};
  Comparison changes;
  for (const ClaimRow& row : all.rows) {
    const bool is_about_fibers = std::find(std::begin(ids), std::end(ids), row.id) != std::end(ids);
    const bool is_known = std::any_of(known.rows.begin(), known.rows.end(), [&](const ClaimRow& other) {
      return other.id == row.id && other.reading == row.reading;
    });
    if (is_about_fibers && !is_known && row.verdict != Verdict::not_answered_by_results)
      changes.rows.push_back(row);
  }
  changes.left_out = all.left_out;
  return changes;
}

std::string document(const std::vector<StoredResult>& runs, std::vector<StoredResult> other_runs) {
  const Comparison comparison = compare_with_paper(runs);
  // The von Mises stress of one law is held against that of all.
  for (const StoredResult& run : runs)
    if (reading_of(run).find("tether\u00a0current") == std::string::npos &&
        reading_of(run).find("a²") == std::string::npos)
      other_runs.push_back(run);
  return fmt::format(
      "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n"
      "<!-- Written by tools/study reproduction; do not edit. -->\n"
      "# The paper's claims beside ours\n\n"
      "Every claim of Tricerri et al. on the straight artery, and what the 0D tier gives for the same scene "
      "over the\n"
      "last of two beats from rest. `tools/study reproduction` computes the four laws under the three "
      "readings of the tether\n"
      "and writes this page; nothing is tuned to bring a number closer.\n\n"
      "The paper leaves some things open, and the readings are named beside each row:\n\n"
      "- **Tether.** `normal`: the surrounding tissue presses along the current normal, per current area "
      "(our default,\n"
      "  `scenes/cylinder.toml`). `reference`: as the paper prints it, per unloaded area along the "
      "displacement\n"
      "  (`scenes/cylinder_as_printed.toml`). `current`: per current area along the displacement. In a "
      "section that\n"
      "  stays round, `normal` and `current` are the same load.\n"
      "- **a²**, the squared fibre stretch at which collagen is recruited: λ_A² cos²β + sin²β, as λ_A is "
      "measured at\n"
      "  constant length.\n"
      "- **Exponent** of the fibre energy: 2. The paper's text prints 1, its names, fits and conclusions "
      "need 2.\n\n"
      "What other a² and the printed exponent change is [below](#other-readings-of-the-fibre-law).\n\n"
      "A number agrees when it lies within the tolerance beside the paper's; with several laws, all have to. "
      "Where the\n"
      "paper does not say at which depth it looks, ours is the range from P1 (inner) to P4 (outer "
      "surface).\n\n"
      "{}\n"
      "Where a remark names the pressure from which fibres are recruited: with the tether as printed these "
      "are 84, 96.5,\n"
      "111.5 and 128.7 mmHg at P1 to P4 for exactly incompressible tissue, and 83.1, 95.4, 110.1 and 126.8 "
      "mmHg at the\n"
      "paper's κ = 9e6 dyn/cm².\n\n"
      "## Claim by claim\n\n"
      "{}\n"
      "## Other readings of the fibre law\n\n"
      "The rows above that change when the fibre law is read otherwise, one thing at a time: a² = 1.520 or "
      "1.270 (other\n"
      "ways to take λ_A, `wall.activation_squared`), or the exponent 1 as printed (`wall.exponent = 1`), "
      "each under the\n"
      "tethers `normal` (`current` is the same) and `reference`. With exponent 1 tissue\n"
      "[lingers at the threshold](theory/core.md#the-thick-ring), and the intervals are those in which H > "
      "1/2; the run of\n"
      "EXP1+EXP2-ZS starts on the limit cycle, since from rest, where it has residual stress, the solver "
      "gives up when all\n"
      "fibres are recruited at once.\n\n"
      "{}",
      tally(comparison, {"normal", "current", "reference"}), to_markdown(comparison),
      to_markdown(what_changes(compare_with_paper(other_runs), comparison)));
}

}  // namespace

void tunica::verification::reproduction(const Study& study) {
  std::vector<StoredResult> runs, other_runs;
  for (const StudyCase& of : study.cases("laws"))
    runs.push_back(study.stored(of, of.series + "/" + of.value("law")));
  for (const StudyCase& of : study.cases("fibers"))
    other_runs.push_back(study.stored(of, fmt::format("fibers/{}", other_runs.size() + 1)));
  write_whole(study.out("docs/reproduction.md"), document(runs, std::move(other_runs)));
}
