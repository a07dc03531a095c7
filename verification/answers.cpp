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

namespace tunica::verification {

namespace {

using namespace observables;

constexpr double mmhg = 1333.22387;  // dyn/cm2
constexpr std::string_view fs_law = "EXP1+EXP2-FS";
constexpr std::string_view zs_law = "EXP1+EXP2-ZS";

Answer needs(std::string_view what) {
  Answer answer;
  answer.note = fmt::format("needs {}", what);
  return answer;
}

Verdict numeric(bool within) {
  return within ? Verdict::agrees : Verdict::disagrees;
}
Verdict qualitative(bool holds) {
  return holds ? Verdict::qualitative_agreement : Verdict::disagrees;
}

/// "EXP1 75.0", held together by a no-break space.
std::string labelled(std::string_view law, double value, int decimals) {
  return fmt::format("{}\u00a0{:.{}f}", short_name(law), value, decimals);
}

double number_of(const std::string& text) {
  return std::stod(text);
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

Answer ratio_of_isotropic(const Claim& claim, const ReadingGroup& group) {
  const ComparedRun* exp1 = group.find("EXP1");
  const ComparedRun* exp2 = group.find("EXP2");
  if (!exp1 || !exp2) return needs("runs of EXP1 and EXP2");
  Range range;
  double sum = 0;
  long count = 0;
  for (const double time : times_in_beat(*exp1)) {
    const double ratio = value_in_beat(*exp2, "radial_displacement.P1", time) /
                         value_in_beat(*exp1, "radial_displacement.P1", time);
    if (!std::isfinite(ratio)) continue;
    range.include(ratio);
    sum += ratio;
    ++count;
  }
  if (count == 0) return needs("columns that the runs lack");
  const double mean = sum / static_cast<double>(count);
  Answer answer;
  answer.ours = fmt::format("{:.3f} ({:.3f} to {:.3f} through the beat)", mean, range.lowest, range.highest);
  answer.verdict = numeric(std::abs(mean - number_of(claim.value)) <= number_of(claim.tolerance));
  answer.note =
      range.lowest > 1 ? "EXP2 moves more than EXP1 at all times" : "EXP2 moves less than EXP1 at some times";
  return answer;
}

Answer of_fibers(Answer answer, std::string_view law) {
  answer.uses_exponent = true;
  answer.uses_activation = law == fs_law;
  return answer;
}

std::string range_text(const Range& range, int decimals) {
  return fmt::format("{:.{}f} to {:.{}f}", range.lowest, decimals, range.highest, decimals);
}

double systole(const ComparedRun& run) {
  return peak_time(run.table(), "inflow", run.beat);
}

/// Over P1..P4, since the paper does not say where in the wall it looks.
Range angles_at(const ComparedRun& run, double time) {
  Range angles;
  for (int point = 1; point <= wall_points; ++point)
    angles.include(value_at(run.table(), fmt::format("fiber_angle.P{}", point), time));
  return angles;
}

Answer within_wall(const Claim& claim, const Range& range, int decimals) {
  if (is_none(range.lowest)) return needs("columns that the run lacks");
  const double paper = number_of(claim.value);
  const double tolerance = number_of(claim.tolerance);
  Answer answer;
  answer.ours = with_unit(range_text(range, decimals), claim.unit);
  answer.verdict = numeric(paper >= range.lowest - tolerance && paper <= range.highest + tolerance);
  return answer;
}

Answer angle_change(const Claim& claim, const ComparedRun& run) {
  Range changes;
  for (int point = 1; point <= wall_points; ++point) {
    const std::string column = fmt::format("fiber_angle.P{}", point);
    const double start = value_at(run.table(), column, run.beat.start);
    changes.include((start - value_at(run.table(), column, systole(run))) / start);
  }
  return within_wall(claim, changes, 3);
}

Answer reference_angle(const Claim& claim, const ComparedRun& run) {
  const double angle = scene_number(run.stored->record, "wall.fiber_angle");
  if (is_none(angle)) return needs("a scene with wall.fiber_angle");
  Answer answer;
  answer.ours = with_unit(fmt::format("{:.2f}", angle), claim.unit);
  answer.verdict = numeric(std::abs(angle - number_of(claim.value)) <= number_of(claim.tolerance));
  answer.note = "given in the scene";
  return answer;
}

std::string interval_text(const ComparedRun& run, int point) {
  std::vector<std::string> parts;
  for (const auto& [from, to] :
       recruited_intervals(run.stored->result, point, run.beat.start, run.beat.end()))
    parts.push_back(fmt::format("{:.3f} to {:.3f} s", from - run.beat.start, to - run.beat.start));
  return parts.empty() ? "never" : fmt::format("{}", fmt::join(parts, " and "));
}

/// Share of the beat in which fibres are recruited at some points, and whether all pass a criterion.
Answer recruited_part(const ComparedRun& run, std::initializer_list<int> points,
                      const std::function<bool(int, double)>& holds) {
  std::vector<std::string> shares;
  std::vector<std::string> notes;
  bool all = true;
  for (const int point : points) {
    const double share = recruited_share(run.stored->result, point, run.beat);
    if (is_none(share)) return needs("columns that the run lacks");
    shares.push_back(fmt::format("P{} {:.1f} % of the beat", point, 100 * share));
    notes.push_back(fmt::format("P{}: {}", point, interval_text(run, point)));
    all = all && holds(point, share);
  }
  Answer answer;
  answer.ours = fmt::format("{}", fmt::join(shares, ", "));
  answer.verdict = qualitative(all);
  answer.note = fmt::format("{}", fmt::join(notes, "; "));
  return answer;
}

Answer recruited_around_peak(const ComparedRun& run) {
  const double peak = peak_time(run.table(), "pressure", run.beat);
  return recruited_part(run, {wall_points}, [&](int point, double share) {
    const auto intervals = recruited_intervals(run.stored->result, point, run.beat.start, run.beat.end());
    return share <= 0.25 && intervals.size() == 1 && intervals[0].first <= peak &&
           peak <= intervals[0].second;
  });
}

Answer falls_outwards(const ComparedRun& run) {
  bool falls = true;
  Range ratio;
  for (const double time : times_in_beat(run)) {
    double inner = value_in_beat(run, "radial_displacement.P1", time);
    ratio.include(value_in_beat(run, fmt::format("radial_displacement.P{}", wall_points), time) / inner);
    for (int point = 2; point <= wall_points; ++point) {
      const double outer = value_in_beat(run, fmt::format("radial_displacement.P{}", point), time);
      falls = falls && outer < inner;
      inner = outer;
    }
  }
  if (is_none(ratio.lowest)) return needs("columns that the run lacks");
  Answer answer;
  answer.ours = fmt::format("outer over inner displacement {}", range_text(ratio, 3));
  answer.verdict = qualitative(falls);
  return answer;
}

Answer stretch_largest_inside(const ComparedRun& run) {
  const double time = peak_time(run.table(), "radial_displacement.P1", run.beat);
  std::vector<double> stretches;
  std::vector<std::string> parts;
  for (int point = 1; point <= wall_points; ++point) {
    stretches.push_back(value_at(run.table(), fmt::format("fiber_stretch.P{}", point), time));
    parts.push_back(fmt::format("P{} {:.3f}", point, stretches.back()));
  }
  if (is_none(stretches.front())) return needs("columns that the run lacks");
  Answer answer;
  answer.ours = fmt::format("{}", fmt::join(parts, ", "));
  answer.verdict = qualitative(std::max_element(stretches.begin(), stretches.end()) == stretches.begin());
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

using OfGroup = std::function<Answer(const Claim&, const ReadingGroup&)>;
using OfRun = std::function<Answer(const Claim&, const ComparedRun&)>;

/// An answer from the run of the claim's own law.
OfGroup of_law(OfRun of_run) {
  return [of_run = std::move(of_run)](const Claim& claim, const ReadingGroup& group) {
    const ComparedRun* run = group.find(claim.law);
    if (!run) return needs(fmt::format("a run of {}", claim.law));
    return of_fibers(of_run(claim, *run), claim.law);
  };
}

const std::map<std::string_view, OfGroup>& answers() {
  const OfGroup start_angle = of_law([](const Claim& claim, const ComparedRun& run) {
    return within_wall(claim, angles_at(run, run.beat.start), 2);
  });
  const OfGroup systole_angle = of_law([](const Claim& claim, const ComparedRun& run) {
    return within_wall(claim, angles_at(run, systole(run)), 2);
  });
  static const std::map<std::string_view, OfGroup> all{
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
      {"vm_fs_lowest",
       [](const Claim&, const ReadingGroup& group) { return of_fibers(von_mises_lowest(group), fs_law); }},
      {"displacement_decreases",
       of_law([](const Claim&, const ComparedRun& run) { return falls_outwards(run); })},
      {"fiber_stretch_inner",
       of_law([](const Claim&, const ComparedRun& run) { return stretch_largest_inside(run); })},
      {"fs_angle_ref", of_law(reference_angle)},
      {"zs_angle_ref", of_law(reference_angle)},
      {"fs_angle_hb", start_angle},
      {"zs_angle_hb", start_angle},
      {"fs_angle_sys", systole_angle},
      {"zs_angle_sys", systole_angle},
      {"fs_angle_change", of_law(angle_change)},
      {"zs_angle_change", of_law(angle_change)},
      {"fs_P1", of_law([](const Claim&, const ComparedRun& run) {
         return recruited_part(run, {1}, [](int, double share) { return share >= 0.85; });
       })},
      {"fs_P23", of_law([](const Claim&, const ComparedRun& run) {
         return recruited_part(run, {2, 3}, [](int, double share) { return share >= 0.15 && share <= 0.85; });
       })},
      {"fs_P4", of_law([](const Claim&, const ComparedRun& run) { return recruited_around_peak(run); })},
      {"zs_always", of_law([](const Claim&, const ComparedRun& run) {
         return recruited_part(run, {1, 2, 3, 4}, [](int, double share) { return share > 1 - 1e-9; });
       })},
  };
  return all;
}

}  // namespace

std::string with_unit(const std::string& value, const std::string& unit) {
  return value.empty() || unit.empty() || unit == "1" ? value : value + " " + unit;
}

Answer answer(const Claim& claim, const ReadingGroup& group) {
  Answer result;
  if (const auto known = answers().find(claim.id); known != answers().end())
    return known->second(claim, group);
  result.verdict = Verdict::not_answered_by_tier;
  if (claim.geometry == "torus") result.note = "needs the 3D tier";
  if (claim.id == "dofs_cylinder")
    if (const auto unknowns = group.runs.front().stored->record.find("unknowns");
        unknowns != group.runs.front().stored->record.end())
      result.ours = unknowns->dump();
  return result;
}

}  // namespace tunica::verification
