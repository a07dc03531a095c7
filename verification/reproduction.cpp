// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_reproduction FILE FOLDER...: writes docs/reproduction.md from the results in the folders.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "verification/claims.hpp"

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

std::string document(const std::vector<StoredResult>& runs) {
  const Comparison comparison = compare_with_paper(runs);
  return fmt::format(
      "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n"
      "<!-- Written by tools/reproduce; do not edit. -->\n"
      "# The paper's claims beside ours\n\n"
      "Every claim of Tricerri et al. on the straight artery, and what the 0D tier gives for the same scene "
      "over the\n"
      "last of two beats from rest. `tools/reproduce` computes the four laws under the three readings of the "
      "tether\n"
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
      "A number agrees when it lies within the tolerance beside the paper's; with several laws, all have to. "
      "Where the\n"
      "paper does not say at which depth it looks, ours is the range from P1 (inner) to P4 (outer "
      "surface).\n\n"
      "{}\n"
      "## Claim by claim\n\n"
      "{}",
      tally(comparison, {"normal", "current", "reference"}), to_markdown(comparison));
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    fmt::print(stderr, "usage: tunica_reproduction FILE FOLDER...\n");
    return 2;
  }
  try {
    std::vector<StoredResult> runs;
    for (int index = 2; index < count; ++index) runs.push_back(read_result(arguments[index]));
    write_whole(arguments[1], document(runs));
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_reproduction: {}\n", error.what());
    return 2;
  }
  return 0;
}
