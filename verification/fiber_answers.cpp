// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/observables/record.hpp"
#include "core/units.hpp"
#include "verification/answer_parts.hpp"

namespace tunica::verification {

namespace {

using namespace observables;

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

/// "0.146 to 0.690 s (from 84.1 mmHg)": when in the beat, and at which pressure recruitment began.
std::string interval_text(const ComparedRun& run, int point) {
  std::vector<std::string> parts;
  for (const auto& [from, to] :
       recruited_intervals(run.stored->result, point, run.beat.start, run.beat.end())) {
    parts.push_back(fmt::format("{:.3f} to {:.3f} s", from - run.beat.start, to - run.beat.start));
    const double pressure = value_at(run.table(), "pressure", from) / mmhg;
    if (from > run.beat.start && !is_none(pressure))
      parts.back() += fmt::format(" (from {:.1f} mmHg)", pressure);
  }
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

using OfRun = std::function<Answer(const Claim&, const ComparedRun&)>;

/// An answer from the run of the claim's own law.
Answerer of_law(OfRun of_run) {
  return [of_run = std::move(of_run)](const Claim& claim, const ReadingGroup& group) {
    const ComparedRun* run = group.find(claim.law);
    if (!run) return needs(fmt::format("a run of {}", claim.law));
    Answer answer = of_run(claim, *run);
    answer.uses_exponent = true;
    answer.uses_activation = claim.law == fs_law;
    return answer;
  };
}

}  // namespace

Answerer fiber_answerer(const std::string& id) {
  static const Answerer start_angle = of_law([](const Claim& claim, const ComparedRun& run) {
    return within_wall(claim, angles_at(run, run.beat.start), 2);
  });
  static const Answerer systole_angle = of_law([](const Claim& claim, const ComparedRun& run) {
    return within_wall(claim, angles_at(run, systole(run)), 2);
  });
  static const std::map<std::string, Answerer> all{
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
  const auto found = all.find(id);
  return found == all.end() ? Answerer{} : found->second;
}

}  // namespace tunica::verification
