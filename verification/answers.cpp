// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "core/observables/record.hpp"
#include "core/units.hpp"
#include "verification/answer_parts.hpp"

namespace tunica::verification {

namespace {

using namespace observables;

/// "EXP1 75.0", held together by a no-break space.
std::string labelled(std::string_view law, double value, int decimals) {
  return fmt::format("{}\u00a0{:.{}f}", short_name(law), value, decimals);
}

/// One number for each law that was run, held against the paper's: all laws have to agree.
Answer per_law(const Claim& claim, const ReadingGroup& group, int decimals,
               const std::function<double(const ComparedRun&)>& quantity) {
  std::vector<std::string> parts;
  bool within = true;
  for (const ComparedRun& run : group.runs) {
    const double value = quantity(run);
    if (is_none(value)) return needs("columns that the runs lack");
    parts.push_back(labelled(run.law, value, decimals));
    within = within && std::abs(value - number_of(claim.value)) <= number_of(claim.tolerance);
  }
  Answer answer;
  answer.ours = with_unit(fmt::format("{}", fmt::join(parts, ", ")), claim.unit);
  answer.verdict = numeric(within);
  answer.uses_activation = group.find(fs_law);
  answer.uses_exponent = answer.uses_activation || group.find(zs_law);
  return answer;
}

double radius_of(const ComparedRun& run) {
  return scene_number(run.stored->record, "geometry.radius");
}

Answer change_of_radius(const Claim& claim, const ReadingGroup& group) {
  const auto displacement = [](const ComparedRun& run) {
    return range(run.table(), "radial_displacement.P1", run.beat);
  };
  Answer answer = per_law(claim, group, 3,
                          [&](const ComparedRun& run) { return displacement(run).width() / radius_of(run); });
  std::vector<std::string> largest;
  for (const ComparedRun& run : group.runs)
    largest.push_back(labelled(run.law, displacement(run).highest / radius_of(run), 3));
  answer.note = fmt::format("largest displacement over R0: {}", fmt::join(largest, ", "));
  return answer;
}

Answer transmural_range(const Claim& claim, const ReadingGroup& group) {
  const std::size_t separator = claim.value.find(" to ");
  const double lowest = number_of(claim.value);
  const double highest = number_of(claim.value.substr(separator + 4));
  const double tolerance = number_of(claim.tolerance);
  std::vector<std::string> parts;
  bool within = true;
  for (const ComparedRun& run : group.runs) {
    const Range found = range(run.table(), "transmural_pressure", run.beat);
    if (is_none(found.lowest)) return needs("columns that the runs lack");
    parts.push_back(fmt::format("{}\u00a0{:.1f}\u00a0to\u00a0{:.1f}", short_name(run.law),
                                found.lowest / mmhg, found.highest / mmhg));
    within = within && std::abs(found.lowest / mmhg - lowest) <= tolerance &&
             std::abs(found.highest / mmhg - highest) <= tolerance;
  }
  Answer answer;
  answer.ours = with_unit(fmt::format("{}", fmt::join(parts, ", ")), claim.unit);
  answer.verdict = numeric(within);
  answer.uses_activation = group.find(fs_law);
  answer.uses_exponent = answer.uses_activation || group.find(zs_law);
  return answer;
}

Answer same_pressure(const Claim& claim, const ReadingGroup& group) {
  if (group.runs.size() < 2) return needs("runs of at least two laws");
  double largest = 0;
  double at = 0;
  for (const double time : times_in_beat(group.runs.front())) {
    Range over_laws;
    for (const ComparedRun& run : group.runs) over_laws.include(value_in_beat(run, "pressure", time) / mmhg);
    if (over_laws.width() <= largest) continue;
    largest = over_laws.width();
    at = time;
  }
  std::vector<std::string_view> names;
  for (const ComparedRun& run : group.runs) names.push_back(short_name(run.law));
  Answer answer;
  answer.ours =
      fmt::format("at most {:.2f} mmHg apart, at {:.3f} s ({})", largest, at, fmt::join(names, ", "));
  answer.verdict = qualitative(largest <= number_of(claim.tolerance));
  answer.uses_activation = group.find(fs_law);
  answer.uses_exponent = answer.uses_activation || group.find(zs_law);
  return answer;
}

/// Inner displacement of one run over that of another through the beat.
struct Ratio {
  Range range;
  double mean = none;
};
Ratio ratio_of_displacement(const ComparedRun& over, const ComparedRun& under) {
  Ratio ratio;
  double sum = 0;
  long count = 0;
  for (const double time : times_in_beat(under)) {
    const double value = value_in_beat(over, "radial_displacement.P1", time) /
                         value_in_beat(under, "radial_displacement.P1", time);
    if (!std::isfinite(value)) continue;
    ratio.range.include(value);
    sum += value;
    ++count;
  }
  if (count > 0) ratio.mean = sum / static_cast<double>(count);
  return ratio;
}

std::string to_text(const Ratio& ratio) {
  return fmt::format("{:.3f} ({:.3f} to {:.3f} through the beat)", ratio.mean, ratio.range.lowest,
                     ratio.range.highest);
}

Answer ratio_of_isotropic(const Claim& claim, const ReadingGroup& group) {
  const ComparedRun* exp1 = group.find("EXP1");
  const ComparedRun* exp2 = group.find("EXP2");
  if (!exp1 || !exp2) return needs("runs of EXP1 and EXP2");
  const Ratio ratio = ratio_of_displacement(*exp2, *exp1);
  if (is_none(ratio.mean)) return needs("columns that the runs lack");
  Answer answer;
  answer.ours = to_text(ratio);
  answer.verdict = numeric(std::abs(ratio.mean - number_of(claim.value)) <= number_of(claim.tolerance));
  answer.note = ratio.range.lowest > 1 ? "EXP2 moves more than EXP1 at all times"
                                       : "EXP2 moves less than EXP1 at some times";
  return answer;
}

/// How far FS lies below the lowest of the other laws, relative to it, at P1..P4 and the paper's two times.
Answer von_mises_lowest(const ReadingGroup& group) {
  const ComparedRun* fs = group.find(fs_law);
  if (!fs || group.runs.size() < std::size(paper_laws)) return needs("runs of the four laws");
  bool lowest = true;
  bool most_outside = true;
  std::vector<std::string> parts;
  for (const double time : {0.212, 0.600}) {
    std::vector<double> below;
    for (int point = 1; point <= wall_points; ++point) {
      const std::string column = fmt::format("von_mises.P{}", point);
      Range others;
      for (const ComparedRun& run : group.runs)
        if (run.law != fs_law) others.include(value_in_beat(run, column, time));
      below.push_back(1 - value_in_beat(*fs, column, time) / others.lowest);
      if (is_none(below.back())) return needs("columns that the runs lack");
      lowest = lowest && below.back() > 0;
    }
    most_outside = most_outside && std::max_element(below.begin(), below.end()) == below.end() - 1;
    parts.push_back(fmt::format("at {:.3f} s {:+.0f} % (P1) to {:+.0f} % (P4)", time, -100 * below.front(),
                                -100 * below.back()));
  }
  Answer answer;
  answer.uses_activation = true;
  answer.uses_exponent = true;
  answer.ours = fmt::format("FS against the lowest other law: {}", fmt::join(parts, ", "));
  answer.verdict = qualitative(lowest && most_outside);
  if (!lowest) answer.note = "FS is not the lowest everywhere";
  if (lowest && !most_outside) answer.note = "FS is the lowest, but the difference is not largest outside";
  return answer;
}

Answer volume_change(const Claim& claim, const ReadingGroup& group) {
  std::vector<std::string> parts;
  bool within = true;
  for (const ComparedRun& run : group.runs) {
    const Column* column = run.stored->result.profiles.find("volume_change");
    Range change;
    if (column)
      for (const double value : column->values) change.include(std::abs(value));
    if (is_none(change.highest)) return needs("profiles with the volume change");
    parts.push_back(labelled(run.law, change.highest, 4));
    within = within && change.highest <= number_of(claim.value) * (1 + 1e-9);
  }
  Answer answer;
  answer.ours = fmt::format("{}", fmt::join(parts, ", "));
  answer.verdict = numeric(within);
  answer.uses_activation = group.find(fs_law);
  answer.uses_exponent = answer.uses_activation || group.find(zs_law);
  return answer;
}

/// How differently the sides of the bend, at 90 and 270 degrees, move: largest difference of their inner
/// displacements over the largest of these. Nothing but round-off where half of the bend stands for both
/// sides.
Answer torus_sides(const Claim& claim, const ReadingGroup& group) {
  const ComparedRun* run = group.find(claim.law);
  if (!run) return needs(fmt::format("a run of {}", claim.law));
  constexpr double alike = 0.01;
  double difference = 0, largest = 0;
  for (const double time : times_in_beat(*run)) {
    const double one = value_in_beat(*run, "radial_displacement.P1.90deg", time);
    const double other = value_in_beat(*run, "radial_displacement.P1.270deg", time);
    if (is_none(one) || is_none(other)) return needs("columns that the run lacks");
    difference = std::max(difference, std::abs(one - other));
    largest = std::max({largest, std::abs(one), std::abs(other)});
  }
  Answer answer;
  answer.ours = fmt::format("sides differ by {:.2f} % of the displacement", 100 * difference / largest);
  answer.verdict = qualitative(difference <= alike * largest);
  const std::string symmetry = scene_text(run->stored->record, "mesh.symmetry");
  if (symmetry != "full")
    answer.note = "half of the bend is meshed: mesh.symmetry=full lets the sides differ";
  return answer;
}

Answer torus_zs_smaller(const ReadingGroup& group) {
  const ComparedRun* exp2 = group.find("EXP2");
  const ComparedRun* zs = group.find(zs_law);
  if (!exp2 || !zs) return needs(fmt::format("runs of EXP2 and {}", zs_law));
  const Ratio ratio = ratio_of_displacement(*zs, *exp2);
  if (is_none(ratio.mean)) return needs("columns that the runs lack");
  Answer answer;
  answer.ours = "ZS over EXP2, outside of the bend: " + to_text(ratio);
  answer.verdict = qualitative(ratio.mean < 1);
  answer.uses_exponent = true;
  return answer;
}

const std::map<std::string_view, Answerer>& answers() {
  static const std::map<std::string_view, Answerer> all{
      {"p_min",
       [](const Claim& claim, const ReadingGroup& group) {
         return per_law(claim, group, 1, [](const ComparedRun& run) {
           return range(run.table(), "pressure", run.beat).lowest / mmhg;
         });
       }},
      {"p_max",
       [](const Claim& claim, const ReadingGroup& group) {
         return per_law(claim, group, 1, [](const ComparedRun& run) {
           return range(run.table(), "pressure", run.beat).highest / mmhg;
         });
       }},
      {"t_systole",
       [](const Claim& claim, const ReadingGroup& group) {
         return per_law(claim, group, 4,
                        [](const ComparedRun& run) { return systole(run) - run.beat.start; });
       }},
      {"p_same_for_laws", same_pressure},
      {"du_over_R0", change_of_radius},
      {"exp2_over_exp1", ratio_of_isotropic},
      {"transmural_range", transmural_range},
      {"j_margin", volume_change},
      {"torus_exp2_sym", torus_sides},
      {"torus_zs_smaller", [](const Claim&, const ReadingGroup& group) { return torus_zs_smaller(group); }},
      {"vm_fs_lowest", [](const Claim&, const ReadingGroup& group) { return von_mises_lowest(group); }},
  };
  return all;
}

}  // namespace

Answer needs(std::string_view what) {
  Answer answer;
  answer.note = fmt::format("needs {}", what);
  return answer;
}

double number_of(const std::string& text) {
  return std::stod(text);
}

std::string range_text(const Range& range, int decimals) {
  return fmt::format("{:.{}f} to {:.{}f}", range.lowest, decimals, range.highest, decimals);
}

/// Times of the rows of a beat, counted from its start.
std::vector<double> times_in_beat(const ComparedRun& run) {
  std::vector<double> times;
  const auto& all = run.table().find("time")->values;
  for (std::size_t row = run.beat.first; row <= run.beat.last; ++row)
    times.push_back(all[row] - run.beat.start);
  return times;
}

double value_in_beat(const ComparedRun& run, std::string_view column, double time) {
  return value_at(run.table(), column, std::min(run.beat.start + time, run.beat.end()));
}

double systole(const ComparedRun& run) {
  return peak_time(run.table(), "inflow", run.beat);
}

std::string with_unit(const std::string& value, const std::string& unit) {
  return value.empty() || unit.empty() || unit == "1" ? value : value + " " + unit;
}

bool is_about(const Claim& claim, std::string_view geometry) {
  return claim.geometry.find(geometry) != std::string::npos;
}

Answer answer(const Claim& claim, const ReadingGroup& group) {
  Answer result;
  if (!is_about(claim, group.reading.geometry)) {
    // Only the 3D tier knows bends.
    if (group.reading.tier == "full3d") return needs("a run of the torus");
    result.verdict = Verdict::not_answered_by_tier;
    result.note = "needs the 3D tier";
    return result;
  }
  if (const auto known = answers().find(claim.id); known != answers().end())
    return known->second(claim, group);
  if (const Answerer answerer = fiber_answerer(claim.id)) return answerer(claim, group);
  result.verdict = Verdict::not_answered_by_tier;
  if (claim.id.starts_with("dofs_"))
    if (const auto unknowns = group.runs.front().stored->record.find("unknowns");
        unknowns != group.runs.front().stored->record.end())
      result.ours = unknowns->dump();
  if (claim.id == "torus_zs_asym") return needs("displacement fields: docs/verification/torus-cases.md");
  if (claim.id == "torus_fs_not_run") {
    if (!group.find(fs_law)) return needs(fmt::format("a run of {}", fs_law));
    result.ours = "computed here";
  }
  return result;
}

}  // namespace tunica::verification
