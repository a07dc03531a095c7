// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "axisym/observer.hpp"
#include "axisym/setup.hpp"
#include "core/coupled/sensitivity.hpp"

namespace tunica::axisym {

/// How a vessel depends on a key of its scene, by differences between the vessels of values beside it (on
/// both sides where both are allowed) with a relative step of 1e-6: 1e-12 of the third derivative, and the
/// 1e-10 that rounding leaves of the terms of an equation. Nodes move with the geometry, cells stay the same.
class KeyDerivative final : public coupled::KeyDerivative {
 public:
  /// `of` has the equations, of the scene, that are differentiated.
  KeyDerivative(const Scene& scene, const Resolution& resolution, const Assembler& of,
                const std::string& key);

  void residual(const Stage& stage, std::span<const double> y, std::span<double> rows) const override;
  void placed(const Stage& stage, std::span<const double> y, std::span<double> out) const override;
  void follow(double time, std::span<const double> y, std::span<double> out) const override;
  observables::Sample sample(double time, std::span<const double> y,
                             std::span<const double> s) const override;
  std::vector<double> event_values(std::span<const double> y, std::span<const double> s) const override;

 private:
  /// The vessel at a value beside the scene's.
  struct Beside {
    Beside(const Scene& scene, const Resolution& resolution, const Assembler& of, const std::string& key,
           double value);
    double value;
    std::unique_ptr<Setup> setup;
    Assembler assembler;
    Observer observer;
  };
  /// out = (upper - lower) / step of what `evaluate(vessel, to)` makes of each vessel.
  template <class Evaluate>
  void quotient(std::span<double> out, const Evaluate& evaluate) const;
  /// The state at the value of one of the two.
  std::span<const double> moved(const Beside& to, std::span<const double> y, std::span<const double> s) const;

  double value_;
  std::unique_ptr<Beside> lower_, upper_;
  double step_;
  bool moves_nodes_;
  Assembler::Parts parts_;
  mutable std::vector<double> work_;
};

/// The equations of an assembler with their derivatives by the keys that its scene asks for.
std::unique_ptr<coupled::KeyedEquations> keyed_equations(const Scene& scene, const Resolution& resolution,
                                                         const Assembler& assembler);

}  // namespace tunica::axisym
