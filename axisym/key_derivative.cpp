// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/key_derivative.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/scene/parameter.hpp"

namespace tunica::axisym {

namespace {

constexpr double relative_step = 1e-6;
/// Of a key that is 0, in its unit: terms are linear in such keys, as in pressures and resistances.
constexpr double step_from_zero = 1e-2;

std::unique_ptr<Setup> like(const Assembler& of, std::unique_ptr<Setup> setup) {
  setup->problem.discretisation.lagged_mesh = of.problem().discretisation.lagged_mesh;
  return setup;
}

}  // namespace

KeyDerivative::Beside::Beside(const Scene& scene, const Resolution& resolution, const Assembler& of,
                              const std::string& key, double at)
    : value(at),
      setup(like(of, conditions_of(scene.with_number(key, at), resolution))),
      assembler(setup->problem),
      observer(assembler) {
  if (assembler.layout().unknowns() != of.layout().unknowns() ||
      assembler.layout().size() != of.layout().size())
    throw std::logic_error("KeyDerivative: the vessel beside has other unknowns");
}

KeyDerivative::KeyDerivative(const Scene& scene, const Resolution& resolution, const Assembler& of,
                             const std::string& key)
    : value_(scene.number(key)) {
  const auto& bounds = scene::find_parameter(key)->bounds;
  const double half = value_ == 0 ? step_from_zero : relative_step * std::abs(value_);
  const auto beside = [&](double value) {
    return std::make_unique<Beside>(scene, resolution, of, key, bounds.contains(value) ? value : value_);
  };
  lower_ = beside(value_ - half);
  upper_ = beside(value_ + half);
  step_ = upper_->value - lower_->value;
  const Problem &a = lower_->setup->problem, &b = upper_->setup->problem;
  moves_nodes_ = a.mesh.points != b.mesh.points;
  parts_.blood = moves_nodes_ || key.starts_with("blood.");
  parts_.wall = moves_nodes_ || key.starts_with("wall.");
}

template <class Evaluate>
void KeyDerivative::quotient(std::span<double> out, const Evaluate& evaluate) const {
  evaluate(*upper_, out);
  std::vector<double> lower(out.size());
  evaluate(*lower_, std::span<double>(lower));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = (out[k] - lower[k]) / step_;
}

void KeyDerivative::residual(const Stage& stage, std::span<const double> y, std::span<double> rows) const {
  quotient(rows, [&](const Beside& vessel, std::span<double> to) {
    if (!vessel.assembler.residual_of(parts_, stage, y, to))
      throw SolverFailure("a state has no derivatives by the keys: beside it cells are inside out");
  });
}

void KeyDerivative::placed(const Stage& stage, std::span<const double> y, std::span<double> out) const {
  quotient(out, [&](const Beside& vessel, std::span<double> to) {
    std::copy(y.begin(), y.end(), to.begin());
    vessel.assembler.complete(stage, to);
  });
}

void KeyDerivative::follow(double time, std::span<const double> y, std::span<double> out) const {
  if (!moves_nodes_) {
    std::fill(out.begin(), out.end(), 0.0);
    return;
  }
  quotient(out, [&](const Beside& vessel, std::span<double> to) {
    std::copy(y.begin(), y.end(), to.begin());
    vessel.assembler.follow(time, to);
  });
}

std::span<const double> KeyDerivative::moved(const Beside& to, std::span<const double> y,
                                             std::span<const double> s) const {
  const double by = to.value - value_;
  work_.resize(y.size());
  for (std::size_t e = 0; e < y.size(); ++e) work_[e] = y[e] + by * s[e];
  return work_;
}

observables::Sample KeyDerivative::sample(double time, std::span<const double> y,
                                          std::span<const double> s) const {
  const auto upper = upper_->observer.sample(time, moved(*upper_, y, s));
  return observables::difference_quotient(upper, lower_->observer.sample(time, moved(*lower_, y, s)), step_);
}

std::vector<double> KeyDerivative::event_values(std::span<const double> y, std::span<const double> s) const {
  std::vector<double> values(upper_->observer.events());
  quotient(values, [&](const Beside& vessel, std::span<double> to) {
    vessel.observer.event_values(moved(vessel, y, s), to.data());
  });
  return values;
}

namespace {

class KeyedAssembler final : public coupled::KeyedEquations {
 public:
  KeyedAssembler(const Scene& scene, const Resolution& resolution, const Assembler& assembler)
      : assembler_(assembler) {
    for (const auto& key : scene.texts("sensitivity.parameters"))
      keys_.push_back(std::make_unique<KeyDerivative>(scene, resolution, assembler, key));
  }
  const coupled::Equations& equations() const override { return assembler_; }
  int keys() const override { return static_cast<int>(keys_.size()); }
  const coupled::KeyDerivative& key(int index) const override { return *keys_[index]; }
  void change(const Stage& stage, std::span<const double> y, std::span<const Direction> along,
              std::span<std::vector<double>> rows) const override {
    assembler_.change(stage, y, along, rows);
  }

 private:
  const Assembler& assembler_;
  std::vector<std::unique_ptr<KeyDerivative>> keys_;
};

}  // namespace

std::unique_ptr<coupled::KeyedEquations> keyed_equations(const Scene& scene, const Resolution& resolution,
                                                         const Assembler& assembler) {
  return std::make_unique<KeyedAssembler>(scene, resolution, assembler);
}

}  // namespace tunica::axisym
