// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/studies/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/run/choose_tier.hpp"

namespace tunica::verification {

long MeasuredRun::count(const char* key) const {
  if (const auto own = stored.record.find(key); own != stored.record.end()) return own->get<long>();
  const auto& resolution = stored.record.at("resolution");
  return resolution.contains(key) ? resolution.at(key).get<long>() : 0;
}

Study::Study(const std::string& name, StudyOptions options, const TierList& tiers)
    : options_(std::move(options)),
      tiers_(tiers),
      cases_(name.empty() ? CaseFile()
                          : CaseFile(options_.source / "verification" / "studies" / (name + ".toml"))) {}

run::Door Study::door(const StudyCase& of, run::DoorOptions options) const {
  const auto scene = options_.source / "scenes" / (of.scene + ".toml");
  return {tiers_, run::SceneSource(scene, of.overrides), std::move(options)};
}

MeasuredRun Study::measured(const StudyCase& of) const {
  run::DoorOptions options;
  options.program = options_.program;
  options.processes = true;
  options.cache = options_.kept;
  run::Outcome outcome = door(of, options).compute({of.tier});
  const std::string name = fmt::format("{} {} {}", of.scene, of.tier, fmt::join(of.overrides, " "));
  if (outcome.ending != run::Ending::done)
    throw std::runtime_error(fmt::format("{}: {}: {}", name, run::name_of(outcome.ending), outcome.reason));
  MeasuredRun measured{std::move(*outcome.stored), outcome.cost};
  fmt::print(stderr, "{}: {} unknowns, {} steps, {:.1f} s of processor time\n", name,
             measured.count("unknowns"), measured.count("steps"), measured.cost.cpu_seconds);
  return measured;
}

run::Outcome Study::computed(const StudyCase& of, const RunControl& control) const {
  return door(of, {}).compute({of.tier}, {}, control);
}

StoredResult Study::stored(const StudyCase& of, const std::string& folder) const {
  run::Keep keep;
  keep.folder = kept(folder);
  keep.earlier = Earlier::replace;
  run::Outcome outcome = door(of, {}).compute({of.tier}, keep);
  if (outcome.ending != run::Ending::done)
    throw std::runtime_error(fmt::format("{}: {}", folder, outcome.reason));
  return std::move(*outcome.stored);
}

double error_of(const std::string& column, const MeasuredRun& run, const MeasuredRun& reference) {
  const auto values = [](const MeasuredRun& of, const std::string& name) -> const std::vector<double>& {
    const observables::Column* found = of.stored.result.observables.find(name);
    if (!found) throw std::runtime_error("observables without " + name);
    return found->values;
  };
  if (values(run, "time") != values(reference, "time"))
    throw std::runtime_error("runs with rows at different times cannot be compared");
  const auto& ours = values(run, column);
  const auto& theirs = values(reference, column);
  const auto [least, greatest] = std::minmax_element(theirs.begin(), theirs.end());
  double largest = 0;
  for (std::size_t k = 0; k < theirs.size(); ++k) largest = std::max(largest, std::abs(ours[k] - theirs[k]));
  if (observables::is_none(*least) || !(*greatest > *least)) return observables::none;
  return largest / (*greatest - *least);
}

double event_difference(const MeasuredRun& run, const MeasuredRun& reference) {
  const auto* ours = run.stored.result.events.find("time");
  const auto* theirs = reference.stored.result.events.find("time");
  if (!ours || !theirs || theirs->values.empty()) return observables::none;
  if (ours->values.size() != theirs->values.size()) return INFINITY;
  double greatest = 0;
  for (std::size_t k = 0; k < ours->values.size(); ++k)
    greatest = std::max(greatest, std::abs(ours->values[k] - theirs->values[k]));
  return greatest;
}

}  // namespace tunica::verification
