// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "lumped/integrator.hpp"

namespace tunica::lumped {

/// Variable-order, variable-step BDF of CVODES with staggered forward sensitivities and root finding.
class Multistep final : public Integrator {
 public:
  /// `tolerance` is relative and local, that is, per step; sensitivities take part in the control of the
  /// step.
  Multistep(System system, std::vector<Sensitivity> sensitivities, double tolerance);
  ~Multistep() override;

  void start(double time, double end_time, const std::vector<double>& state,
             const std::vector<std::vector<double>>& sensitivities) override;
  std::vector<Crossing> advance(double time) override;
  double time() const override;
  const double* state() const override;
  const double* sensitivity(int k) const override;
  IntegratorStatistics statistics() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tunica::lumped
