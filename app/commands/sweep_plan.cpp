// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/commands/sweep_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/run/choose_tier.hpp"
#include "core/scene/parameter.hpp"
#include "verification/sweep/fidelity_points.hpp"
#include "verification/uncertainty/surrogate.hpp"

namespace tunica {

namespace {

std::vector<sweep::Axis> axes_of(const SweepArguments& arguments) {
  std::vector<sweep::Axis> axes;
  for (const std::string& text : arguments.vary) axes.push_back(sweep::parse_axis(text));
  return axes;
}

/// Refuses options that would have no effect, or could not have theirs.
void check_indices(const SweepArguments& arguments) {
  const bool is_listed = !arguments.points.empty();
  if (is_listed && arguments.vary.empty())
    throw InvalidInput(
        "sweep --indices: of the keys of --points say the ranges or distributions, by --vary KEY=LO:HI ...");
  if (!is_listed && (arguments.sample.empty() || arguments.vary.empty()))
    throw InvalidInput("sweep --indices: draw points by --vary KEY=LO:HI ... --sample sobol:N");
  if (!arguments.until) return;
  if (is_listed) throw InvalidInput("sweep --until: a list does not grow; take --sample sobol:N or random:N");
  if (sweep::parse_sample(arguments.sample).first == uncertainty::Sampling::latin_hypercube)
    throw InvalidInput("sweep --until: a Latin hypercube does not grow; take --sample sobol:N or random:N");
  if (!arguments.shard.empty())
    throw InvalidInput(
        "sweep --until: a shard does not know the others; compute all with one, or leave out "
        "--until");
}

void check_fidelities(const SweepArguments& arguments) {
  if (arguments.tier != "auto") throw InvalidInput("sweep --fidelities: names the tiers; leave out --tier");
  if (arguments.until)
    throw InvalidInput(
        "sweep --until: does not know which tier's points to add; say them by --fidelities TIER:N,...");
  if (arguments.no_surrogate)
    throw InvalidInput("sweep --fidelities: is made of surrogates; leave out --no-surrogate");
  if (!arguments.points.empty() && arguments.vary.empty())
    throw InvalidInput(
        "sweep --fidelities: of the keys of --points say the ranges or distributions, by "
        "--vary KEY=LO:HI ...");
  if (arguments.points.empty() && arguments.sample.empty())
    throw InvalidInput(
        "sweep --fidelities: a grid has no part that is spread like it; draw points by --vary KEY=LO:HI ... "
        "--sample sobol:N");
}

/// The points as listed or drawn, for one tier.
std::unique_ptr<sweep::Points> plain_points(const SweepArguments& arguments, bool surrogates,
                                            std::uint64_t times) {
  if (!arguments.points.empty()) {
    if (!arguments.sample.empty())
      throw InvalidInput("sweep: --points lists the points, and --sample draws them; leave one out");
    if (!arguments.vary.empty() && !surrogates)
      throw InvalidInput("sweep: say what varies by --vary KEY=LO:HI:N, or by --points FILE.csv");
    return sweep::list_points(arguments.points, axes_of(arguments));
  }
  if (arguments.vary.empty())
    throw InvalidInput("sweep: say what varies by --vary KEY=LO:HI:N, or by --points FILE.csv");
  if (arguments.sample.empty()) return sweep::grid_points(axes_of(arguments));
  const auto [sampling, count] = sweep::parse_sample(arguments.sample);
  if (arguments.indices && !surrogates)
    return sweep::pick_freeze_points(axes_of(arguments), sampling, times * count, arguments.seed);
  return sweep::sample_points(axes_of(arguments), sampling, times * count, arguments.seed);
}

run::Question question_of(const SweepArguments& arguments, const sweep::Points& points) {
  run::Question question;
  for (const std::string& name : arguments.quantities) {
    question.quantities.push_back(run::parse_quantity(name));
    if (std::count(arguments.quantities.begin(), arguments.quantities.end(), name) > 1)
      throw InvalidInput(fmt::format("--quantity {}: is there twice; leave one out", name));
  }
  if (question.quantities.empty()) question.quantities = run::known_quantities();
  if (!arguments.gradients) return question;
  for (const sweep::Varied& varied : points.keys())
    if (scene::find_parameter(varied.key)->kind == scene::Kind::number) question.keys.push_back(varied.key);
  if (question.keys.empty())
    throw InvalidInput("--gradients: none of the keys that vary holds a number that has derivatives");
  return question;
}

}  // namespace

bool wants_surrogates(const SweepArguments& arguments, const TierList& tiers, const Scene& scene) {
  if (!arguments.fidelities.empty()) {
    check_fidelities(arguments);
    return true;
  }
  if (!arguments.indices) return false;
  check_indices(arguments);
  if (!arguments.points.empty()) {
    if (arguments.no_surrogate)
      throw InvalidInput(
          "sweep --no-surrogate: points of a list make no indices by themselves; take --sample sobol:N");
    return true;
  }
  if (arguments.surrogate || arguments.no_surrogate) return arguments.surrogate;
  return run::choose_tier(tiers, arguments.tier, scene).name() != "lumped";
}

std::unique_ptr<sweep::Points> points_of(const SweepArguments& arguments, bool surrogates,
                                         std::uint64_t times) {
  auto points = plain_points(arguments, surrogates, times);
  if (!surrogates) return points;
  const auto fewest = static_cast<std::uint64_t>(
      uncertainty::fewest_points(static_cast<Eigen::Index>(points->keys().size())));
  if (!arguments.fidelities.empty()) {
    auto fidelities = sweep::parse_fidelities(arguments.fidelities, points->count(), fewest);
    return sweep::fidelity_points(std::move(points), std::move(fidelities));
  }
  if (points->count() < fewest)
    throw InvalidInput(fmt::format("sweep --indices: a surrogate of {} keys needs {} points or more, not {}",
                                   points->keys().size(), fewest, points->count()));
  return points;
}

SweepPlan plan_sweep(const SweepArguments& arguments, const TierList& tiers, const Scene& scene,
                     const sweep::Points& points) {
  SweepPlan plan;
  plan.surrogates = wants_surrogates(arguments, tiers, scene);
  plan.pick_freeze = arguments.indices && !plan.surrogates;
  std::vector<std::string> names{arguments.tier};
  if (!arguments.fidelities.empty()) {
    names.clear();
    for (const auto& fidelity : sweep::fidelities_of(points.describe(), arguments.tier, points.count()))
      names.push_back(fidelity.tier);
  }
  std::ptrdiff_t before = -1;  // place of the tier before in the list, which has the cheapest first
  for (const std::string& name : names) {
    const Tier& tier = run::choose_tier(tiers, name, scene);
    plan.all_compute = plan.all_compute && tier.computes();
    const auto place = std::find_if(tiers.begin(), tiers.end(),
                                    [&](const auto& other) { return other->name() == tier.name(); }) -
                       tiers.begin();
    if (place <= before)
      throw InvalidInput(
          fmt::format("--fidelities {}: {} is not dearer than the tier before it; write tiers from cheap to "
                      "dear, as in lumped,axisym",
                      fmt::join(names, ","), tier.name()));
    before = place;
  }
  plan.tier = fmt::format("{}", fmt::join(names, ","));
  plan.question = question_of(arguments, points);
  return plan;
}

}  // namespace tunica
