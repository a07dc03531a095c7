// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/calibration/calibrate.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>

#include "core/error.hpp"
#include "core/threads.hpp"
#include "verification/calibration/least_squares.hpp"
#include "verification/sweep/axis.hpp"
#include "verification/uncertainty/design.hpp"

namespace tunica::verification::calibration {

namespace {

using Eigen::VectorXd;
using observables::is_none;
using observables::none;

/// Residuals of a task's targets, by runs through the door. Several threads may ask at once.
class Model {
 public:
  Model(const run::Door& door, const Task& task, const Watch& watch)
      : door_(door), task_(task), watch_(watch) {
    for (const Target& target : task.targets) quantities_.push_back(target.quantity);
    for (const FreeKey& free : task.free)
      (has_derivative(free.key) ? exact_ : different_).push_back(free.key);
  }

  const std::vector<std::string>& by_differences() const { return different_; }
  long runs() const { return runs_; }

  std::optional<Residuals> operator()(const VectorXd& u, bool with_jacobian, std::string& reason) {
    // With derivatives of the tier's own a second run at the same point would cost more than they do.
    const bool has_all = different_.empty();
    const auto answer = ask(u, has_all || with_jacobian ? exact_ : std::vector<std::string>{}, reason);
    if (!answer) return std::nullopt;
    const auto n = static_cast<Eigen::Index>(task_.free.size());
    Residuals residuals{residuals_of(*answer), {}};
    report(residuals.values.squaredNorm());
    if (!has_all && !with_jacobian) return residuals;
    residuals.jacobian.resize(residuals.values.size(), n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const FreeKey& free = task_.free[k];
      const auto place = std::find(exact_.begin(), exact_.end(), free.key);
      bool is_known = place != exact_.end();
      for (Eigen::Index i = 0; is_known && i < residuals.values.size(); ++i) {
        const double derivative = answer->gradients[i][place - exact_.begin()];
        residuals.jacobian(i, k) = derivative * free.slope(u[k]) / task_.targets[i].standard_deviation;
        is_known = std::isfinite(derivative);
      }
      if (!is_known && !difference(u, k, residuals, reason)) return std::nullopt;
    }
    return residuals;
  }

 private:
  bool has_derivative(const std::string& key) const {
    try {
      door_.prepare(run::Case{task_.tier, {run::sensitivity_override({key})}}, {});
      return true;
    } catch (const InvalidInput&) {
      return false;
    }
  }

  std::optional<run::Answer> ask(const VectorXd& u, const std::vector<std::string>& keys,
                                 std::string& reason) {
    run::Case what{task_.tier, {}};
    for (std::size_t k = 0; k < task_.free.size(); ++k)
      what.overrides.push_back(
          fmt::format("{}={}", task_.free[k].key, sweep::value_text(task_.free[k].value(u[k]))));
    RunControl control;
    control.interrupted = watch_.interrupted;
    auto outcome = door_.ask(what, {quantities_, keys}, control);
    ++runs_;
    if (outcome.ending == run::Ending::interrupted || watch_.interrupted()) throw Interrupted{};
    if (outcome.ending != run::Ending::done) {
      reason = outcome.reason;
      return std::nullopt;
    }
    for (std::size_t i = 0; i < quantities_.size(); ++i)
      if (is_none(outcome.answer.values[i])) {
        reason = fmt::format("{} has no value there", quantities_[i].name());
        return std::nullopt;
      }
    return std::move(outcome.answer);
  }

  VectorXd residuals_of(const run::Answer& answer) const {
    VectorXd r(static_cast<Eigen::Index>(task_.targets.size()));
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r[i] = (answer.values[i] - task_.targets[i].value) / task_.targets[i].standard_deviation;
    return r;
  }

  /// Column k by a difference over 1 % of the key (of its range, where that includes 0) to both sides, as far
  /// as bounds and answers allow.
  bool difference(const VectorXd& u, Eigen::Index k, Residuals& at, std::string& reason) {
    constexpr double share = 0.01;
    const FreeKey& free = task_.free[k];
    const double h = free.is_log() ? share / std::max(std::log(free.high / free.low), share) : share;
    VectorXd ends[2] = {at.values, at.values};
    double places[2] = {u[k], u[k]};
    for (const int side : {0, 1}) {
      VectorXd moved = u;
      moved[k] = std::clamp(u[k] + (side == 0 ? -h : h), 0.0, 1.0);
      if (moved[k] == u[k]) continue;
      if (const auto answer = ask(moved, {}, reason)) {
        ends[side] = residuals_of(*answer);
        places[side] = moved[k];
      }
    }
    if (places[0] == places[1]) return false;
    at.jacobian.col(k) = (ends[1] - ends[0]) / (places[1] - places[0]);
    return true;
  }

  void report(double misfit) {
    const std::lock_guard lock(mutex_);
    least_ = std::min(least_, misfit);
    watch_.report(runs_, least_);
  }

  const run::Door& door_;
  const Task& task_;
  const Watch& watch_;
  std::vector<run::Quantity> quantities_;
  std::vector<std::string> exact_, different_;
  std::atomic<long> runs_ = 0;
  std::mutex mutex_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// The scene's own values first, then places of a Latin hypercube.
std::vector<VectorXd> starts_of(const Task& task, const Scene& scene) {
  const auto n = static_cast<Eigen::Index>(task.free.size());
  VectorXd own(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const FreeKey& free = task.free[k];
    own[k] = scene.has(free.key) ? free.place(scene.number(free.key)) : 0.5;
  }
  std::vector<VectorXd> all{own};
  if (task.starts < 2) return all;
  uncertainty::Design design(uncertainty::Sampling::latin_hypercube,
                             static_cast<std::uint64_t>(task.starts - 1), static_cast<int>(n), task.seed);
  for (std::uint64_t i = 0; i < design.count(); ++i) {
    all.emplace_back(n);
    design.point(i, all.back().data());
  }
  return all;
}

std::vector<double> values_at(const Task& task, const VectorXd& u) {
  std::vector<double> values;
  for (std::size_t k = 0; k < task.free.size(); ++k) values.push_back(task.free[k].value(u[k]));
  return values;
}

/// What the best answer says of the free keys, of the targets and of how well they agree.
void describe_best(const Task& task, const Minimum& best, Calibration& found) {
  const auto n = static_cast<Eigen::Index>(task.free.size());
  const Certainty certain = certainty(best.residuals.jacobian);
  found.free.resize(task.free.size());
  found.correlation.assign(task.free.size(), std::vector<double>(task.free.size(), none));
  for (Eigen::Index k = 0; k < n; ++k) {
    FreeResult& one = found.free[k];
    one.value = task.free[k].value(best.u[k]);
    one.has_influence = !certain.without_influence[k];
    one.is_determined = certain.determined[k];
    one.at_bound = best.u[k] <= 0 || best.u[k] >= 1;
    if (one.is_determined)
      one.standard_deviation = std::sqrt(certain.covariance(k, k)) * task.free[k].slope(best.u[k]);
    for (Eigen::Index j = 0; j < n; ++j)
      if (certain.determined[k] && certain.determined[j])
        found.correlation[k][j] =
            certain.covariance(k, j) / std::sqrt(certain.covariance(k, k) * certain.covariance(j, j));
  }
  for (std::size_t i = 0; i < task.targets.size(); ++i)
    found.reached.push_back(task.targets[i].value +
                            best.residuals.values[i] * task.targets[i].standard_deviation);
  found.misfit = best.misfit();
  const auto fitted = std::count_if(found.free.begin(), found.free.end(),
                                    [](const FreeResult& one) { return one.is_determined && !one.at_bound; });
  found.degrees = std::max(1.0, static_cast<double>(task.targets.size()) - static_cast<double>(fitted));
  found.chance = gsl_cdf_chisq_Q(found.misfit, found.degrees);
  found.converged = best.converged;
  found.reason = best.reason;
  for (Start& start : found.starts) {
    start.agrees = start.converged;
    for (Eigen::Index k = 0; start.agrees && k < n; ++k) {
      // A tenth of what the targets leave open, or a thousandth of the range.
      const double open = certain.determined[k] ? 0.1 * std::sqrt(certain.covariance(k, k)) : 1;
      start.agrees = std::abs(task.free[k].place(start.to[k]) - best.u[k]) <= std::max(open, 1e-3);
    }
  }
}

}  // namespace

void check(const Task& task) {
  if (task.targets.size() < task.free.size())
    throw InvalidInput(
        fmt::format("calibrate: {} free keys need as many targets, and there {} {}; add a --target or "
                    "fix a key with --set",
                    task.free.size(), task.targets.size() == 1 ? "is" : "are", task.targets.size()));
  for (std::size_t i = 0; i < task.free.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (task.free[i].key == task.free[j].key)
        throw InvalidInput(fmt::format("--free {}: is there twice; leave one out", task.free[i].key));
  for (std::size_t i = 0; i < task.targets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (task.targets[i].quantity.name() == task.targets[j].quantity.name())
        throw InvalidInput(
            fmt::format("--target {}: is there twice; leave one out", task.targets[i].quantity.name()));
}

int Calibration::agreeing() const {
  return static_cast<int>(
      std::count_if(starts.begin(), starts.end(), [](const Start& one) { return one.agrees; }));
}

Calibration calibrate(const run::Door& door, const Task& task, const Watch& watch) {
  check(task);
  Model model(door, task, watch);
  SearchOptions options;
  if (!model.by_differences().empty()) {
    options.tolerance = 1e-4;
    options.noise = 1e-2;
  }
  const std::vector<VectorXd> from = starts_of(task, door.source().scene());
  Calibration found;
  found.by_differences = model.by_differences();
  found.starts.resize(from.size());
  std::vector<std::optional<Minimum>> minima(from.size());
  const auto search = [&](std::size_t i) {
    Start& start = found.starts[i];
    start.from = values_at(task, from[i]);
    // What a search had found when it was interrupted is worth keeping.
    std::optional<Minimum> so_far;
    const auto evaluate = [&](const VectorXd& u, bool with_jacobian) {
      auto residuals = model(u, with_jacobian, start.reason);
      const bool is_better = residuals && residuals->jacobian.size() > 0 &&
                             (!so_far || residuals->values.squaredNorm() < so_far->misfit());
      if (is_better) so_far = Minimum{u, *residuals, false, "interrupted"};
      return residuals;
    };
    try {
      minima[i] = least_squares(evaluate, from[i], options);
    } catch (const Interrupted&) {
      minima[i] = std::move(so_far);
      start.reason = "interrupted";
    }
    if (!minima[i]) return;
    start.to = values_at(task, minima[i]->u);
    start.misfit = minima[i]->misfit();
    start.converged = minima[i]->converged;
    start.reason = minima[i]->reason;
  };
  tbb::task_arena arena(task.jobs);
  const bool side_by_side = task.jobs > 1 && from.size() > 1;
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t i) {
      // Cores are shared by searches, not within their runs.
      std::optional<ThreadLimit> limit;
      if (side_by_side) limit.emplace(1);
      search(i);
    });
  });
  found.runs = model.runs();
  found.interrupted = watch.interrupted();
  const Minimum* best = nullptr;
  for (const auto& minimum : minima)
    if (minimum && (!best || minimum->misfit() < best->misfit())) best = &*minimum;
  if (best)
    describe_best(task, *best, found);
  else
    found.reason = found.starts.front().reason;
  return found;
}

}  // namespace tunica::verification::calibration
