// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/run/quantity.hpp"
#include "core/scene/parameter.hpp"

namespace tunica::run {

namespace {

using observables::Beat;
using observables::Column;
using observables::is_none;
using observables::none;
using observables::Table;

/// A value and its derivatives by the keys that were asked for.
struct Moving {
  double value = none;
  std::vector<double> derivatives;
};

/// Parabola through three rows of a column, about the middle one.
struct Parabola {
  double time, value, slope, curvature;

  Parabola(const std::vector<double>& times, const std::vector<double>& values, std::size_t row)
      : time(times[row]), value(values[row]) {
    const double left = times[row] - times[row - 1], right = times[row + 1] - times[row];
    const double rise_left = (values[row] - values[row - 1]) / left;
    const double rise_right = (values[row + 1] - values[row]) / right;
    curvature = 2 * (rise_right - rise_left) / (left + right);
    slope = (rise_left * right + rise_right * left) / (left + right);
  }
  double at(double t) const { return value + (slope + 0.5 * curvature * (t - time)) * (t - time); }
  double slope_at(double t) const { return slope + curvature * (t - time); }
};

/// H = atan(u)/pi + 1/2 of recruitment, by u, which is proportional to I4bar - a^2: between rows that is as
/// smooth as the stretch, where H all but jumps.
double excess_of(double recruitment) {
  return std::tan(std::numbers::pi * (recruitment - 0.5));
}
double recruitment_of(double excess) {
  return std::atan(excess) / std::numbers::pi + 0.5;
}
/// Mean of H while u runs evenly from one value to another: the integral of atan is u atan u - ln(1 + u^2)/2.
double mean_recruitment(double from, double to) {
  if (std::abs(to - from) <= 1e-6 * (1 + std::abs(from))) return recruitment_of(0.5 * (from + to));
  const auto integral = [](double u) { return u * std::atan(u) - 0.5 * std::log1p(u * u); };
  return (integral(to) - integral(from)) / (to - from) / std::numbers::pi + 0.5;
}

bool is_recruitment(const Column& column) {
  return column.name.starts_with("recruitment.");
}

class Answering {
 public:
  Answering(const Result& result, const Beat& beat, const std::vector<std::string>& keys)
      : result_(result), beat_(beat), keys_(keys), time_(result.observables.find("time")->values) {}

  Moving answer(const Quantity& quantity) const {
    if (quantity.observable == "beat")
      return constant(observables::unrepeated(result_.observables, beat_, 0.01).empty() ? 1 : 0);
    if (quantity.observable == "von_mises") return over_points(quantity.statistic);
    const Column* column = result_.observables.find(quantity.observable);
    if (!column || is_none(column->values[beat_.first])) return unknown();
    switch (quantity.statistic) {
      case Statistic::max:
        return extreme(*column, 1).value;
      case Statistic::min:
        return extreme(*column, -1).value;
      case Statistic::time_of_max:
        return extreme(*column, 1).time;
      case Statistic::time_of_min:
        return extreme(*column, -1).time;
      case Statistic::change:
        return difference(extreme(*column, 1).value, extreme(*column, -1).value);
      case Statistic::mean:
        return mean_of(*column);
      case Statistic::drift:
        return of_columns(*column,
                          [&](const std::vector<double>& y) { return y[beat_.last] - y[beat_.first]; });
      default:
        return recruited(quantity);
    }
  }

 private:
  struct Extreme {
    Moving value, time;
  };

  Moving unknown() const { return {none, std::vector<double>(keys_.size(), none)}; }
  Moving constant(double value) const { return {value, std::vector<double>(keys_.size(), 0.0)}; }

  static Moving difference(Moving left, const Moving& right) {
    left.value -= right.value;
    for (std::size_t k = 0; k < left.derivatives.size(); ++k) left.derivatives[k] -= right.derivatives[k];
    return left;
  }

  /// Derivative of a column by a key over the rows of the run; null where the run has none.
  const std::vector<double>* sensitivity(const Table& table, const Column& column,
                                         const std::string& key) const {
    const auto head = observables::sensitivity_column(column.name, column.unit, key, "");
    const Column* found = table.find(head.name);
    return found ? &found->values : nullptr;
  }

  /// A linear function of a column's rows, which its derivatives share.
  template <class Linear>
  Moving of_columns(const Column& column, const Linear& linear) const {
    Moving result{linear(column.values), {}};
    for (const std::string& key : keys_) {
      const auto* moved = sensitivity(result_.sensitivities, column, key);
      result.derivatives.push_back(moved ? linear(*moved) : none);
    }
    return result;
  }

  Moving mean_of(const Column& column) const {
    Moving found = of_columns(column, [&](const std::vector<double>& y) { return mean(y); });
    if (is_recruitment(column) && beat_.first < beat_.last) {
      double sum = 0;
      for (std::size_t row = beat_.first; row < beat_.last; ++row)
        sum += mean_recruitment(excess_of(column.values[row]), excess_of(column.values[row + 1])) *
               (time_[row + 1] - time_[row]);
      found.value = sum / (time_[beat_.last] - time_[beat_.first]);
    }
    return found;
  }

  double mean(const std::vector<double>& y) const {
    if (beat_.first == beat_.last) return y[beat_.last];
    double sum = 0;
    for (std::size_t row = beat_.first; row < beat_.last; ++row)
      sum += 0.5 * (y[row] + y[row + 1]) * (time_[row + 1] - time_[row]);
    return sum / (time_[beat_.last] - time_[beat_.first]);
  }

  /// The largest (sign 1) or smallest (-1) value in the beat.
  Extreme extreme(const Column& column, double sign) const {
    const auto& y = column.values;
    std::size_t top = beat_.first;
    for (std::size_t row = beat_.first; row <= beat_.last; ++row)
      if (sign * y[row] > sign * y[top]) top = row;
    const bool is_static = beat_.first == beat_.last;
    // Rows at the ends of the beat have a neighbour on one side only.
    const bool inside = top > beat_.first && top < beat_.last;
    const bool by_excess = inside && is_recruitment(column);
    const Parabola of_value = by_excess ? of_excess(y, top)
                              : inside  ? Parabola(time_, y, top)
                                        : flat(time_[top], y[top]);
    const bool has_vertex = inside && sign * of_value.curvature < 0;
    const double shift = has_vertex ? -of_value.slope / of_value.curvature : 0;
    const double at = time_[top] + shift;
    const double value = by_excess ? recruitment_of(of_value.at(at)) : of_value.at(at);
    Extreme found{{value, {}}, {is_static ? none : at - beat_.start, {}}};
    for (const std::string& key : keys_) {
      const auto* moved = sensitivity(result_.sensitivities, column, key);
      if (!moved) {
        found.value.derivatives.push_back(none);
        found.time.derivatives.push_back(none);
        continue;
      }
      const Parabola of_moved = inside ? Parabola(time_, *moved, top) : flat(time_[top], (*moved)[top]);
      found.value.derivatives.push_back(of_moved.at(at));
      found.time.derivatives.push_back(is_static    ? none
                                       : by_excess  ? none
                                       : has_vertex ? -of_moved.slope_at(at) / of_value.curvature
                                                    : 0.0);
    }
    return found;
  }

  Parabola of_excess(const std::vector<double>& y, std::size_t row) const {
    return {{time_[row - 1], time_[row], time_[row + 1]},
            {excess_of(y[row - 1]), excess_of(y[row]), excess_of(y[row + 1])},
            1};
  }

  static Parabola flat(double time, double value) {
    return {{time - 1, time, time + 1}, {value, value, value}, 1};
  }

  /// The greatest of the maxima at P1..P4, and where it is.
  Moving over_points(Statistic statistic) const {
    Moving greatest = unknown();
    double place = none;
    for (int point = 1; point <= observables::wall_points; ++point) {
      const Column* column = result_.observables.find(fmt::format("von_mises.P{}", point));
      if (!column || is_none(column->values[beat_.first])) continue;
      Moving here = extreme(*column, 1).value;
      if (here.value <= greatest.value) continue;
      greatest = std::move(here);
      place = point;
    }
    return statistic == Statistic::max_place ? Moving{place, std::vector<double>(keys_.size(), 0.0)}
                                             : greatest;
  }

  Moving recruited(const Quantity& quantity) const {
    const int point = quantity.observable.back() - '0';
    if (quantity.statistic == Statistic::share) {
      Moving share{observables::recruited_share(result_, point, beat_), {}};
      for (const std::string& key : keys_) share.derivatives.push_back(share_derivative(point, key));
      return share;
    }
    if (beat_.first == beat_.last) return unknown();
    const auto intervals = observables::recruited_intervals(result_, point, beat_.start, beat_.end());
    if (intervals.empty()) return unknown();
    const double at = quantity.statistic == Statistic::on ? intervals[0].first : intervals[0].second;
    Moving moment{at - beat_.start, {}};
    for (const std::string& key : keys_) moment.derivatives.push_back(event_derivative(point, at, key));
    return moment;
  }

  double share_derivative(int point, const std::string& key) const {
    const Table& table = result_.recruited_time;
    const Column* points = table.find("point");
    const Column* families = table.find("family");
    const auto* moved =
        points && families ? sensitivity(table, {"recruited_time", "s", {}, {}}, key) : nullptr;
    if (!moved) return none;
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (points->labels[row] == fmt::format("P{}", point) && families->values[row] == 1)
        return (*moved)[row] / beat_.period;
    return none;
  }

  /// Of the event at a time; an interval that the beat's ends cut stays where it is.
  double event_derivative(int point, double at, const std::string& key) const {
    const Table& table = result_.event_sensitivities;
    const Column* times = table.find("time");
    const auto* moved = times ? sensitivity(table, {"time", "s", {}, {}}, key) : nullptr;
    if (!moved) return none;
    const Column& points = *table.find("point");
    const Column& families = *table.find("family");
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (times->values[row] == at && families.values[row] == 1 &&
          points.labels[row] == fmt::format("P{}", point))
        return (*moved)[row];
    return 0;
  }

  const Result& result_;
  const Beat& beat_;
  const std::vector<std::string>& keys_;
  const std::vector<double>& time_;
};

}  // namespace

Answer answer_of(const Result& result, const Beat& beat, const Question& question) {
  if (result.observables.rows() == 0 || beat.first > beat.last)
    throw InvalidInput("a result without rows in its last beat has no quantities");
  const Answering answering(result, beat, question.keys);
  Answer answer;
  for (const Quantity& quantity : question.quantities) {
    Moving found = answering.answer(quantity);
    answer.values.push_back(found.value);
    answer.gradients.push_back(std::move(found.derivatives));
  }
  return answer;
}

Answer answer_of(const StoredResult& stored, const Question& question) {
  return answer_of(stored.result, observables::last_beat(stored), question);
}

}  // namespace tunica::run
