// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/coordinate.hpp"

#include <gsl/gsl_integration.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>

#include "core/gsl.hpp"

namespace tunica::uncertainty {

namespace {

/// Enough for Matérn's functions, whose third derivative jumps, to some 1e-6 of their integrals.
constexpr int nodes = 64;

/// a_n and b_n for a density that is linear on both sides of its mode, by sums that are exact for it.
void stieltjes(double mode, std::vector<double>& a, std::vector<double>& b) {
  std::vector<Coordinate::Node> rule;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> gauss(
      gsl_integration_glfixed_table_alloc(nodes + 1), gsl_integration_glfixed_table_free);
  for (const auto& [low, high] : {std::pair{-1.0, mode}, std::pair{mode, 1.0}}) {
    if (!(low < high)) continue;
    for (std::size_t k = 0; k < nodes + 1; ++k) {
      double z = 0, weight = 0;
      check_gsl(gsl_integration_glfixed_point(low, high, k, &z, &weight, gauss.get()),
                "gsl_integration_glfixed_point");
      const double density = low < mode ? (z + 1) / (mode + 1) : (1 - z) / (1 - mode);
      rule.push_back({z, weight * density});
    }
  }
  std::vector<double> before(rule.size(), 0.0), now(rule.size(), 1.0);
  double norm_before = 1;
  for (std::size_t n = 0; n < a.size(); ++n) {
    double norm = 0, moment = 0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
      norm += rule[i].weight * now[i] * now[i];
      moment += rule[i].weight * rule[i].place * now[i] * now[i];
    }
    a[n] = moment / norm;
    b[n] = norm / norm_before;
    norm_before = norm;
    for (std::size_t i = 0; i < rule.size(); ++i) {
      const double next = (rule[i].place - a[n]) * now[i] - (n > 0 ? b[n] : 0) * before[i];
      before[i] = now[i];
      now[i] = next;
    }
  }
}

}  // namespace

Coordinate::Coordinate(const Marginal& law) : law_(law), a_(nodes, 0.0), b_(nodes, 0.0) {
  find_recurrence();
  find_quadrature();
}

double Coordinate::of(double x) const {
  switch (law_.kind) {
    case Marginal::Kind::log_uniform:
      return 2 * std::log(x / law_.a) / std::log(law_.b / law_.a) - 1;
    case Marginal::Kind::normal:
      return (x - law_.a) / law_.b;
    case Marginal::Kind::lognormal: {
      const double deviation = std::sqrt(std::log1p((law_.b / law_.a) * (law_.b / law_.a)));
      return std::log(x / law_.a) / deviation + 0.5 * deviation;
    }
    default:
      return (2 * x - law_.a - law_.b) / (law_.b - law_.a);
  }
}

void Coordinate::polynomials(double z, int degree, double* values) const {
  values[0] = 1;
  for (std::size_t n = 0; n < static_cast<std::size_t>(degree); ++n)
    values[n + 1] =
        ((z - a_[n]) * values[n] - (n > 0 ? std::sqrt(b_[n]) * values[n - 1] : 0)) / std::sqrt(b_[n + 1]);
}

void Coordinate::find_recurrence() {
  switch (law_.kind) {
    case Marginal::Kind::normal:
    case Marginal::Kind::lognormal:
      for (std::size_t n = 0; n < b_.size(); ++n) b_[n] = static_cast<double>(n);
      break;
    case Marginal::Kind::triangular:
      stieltjes((2 * law_.c - law_.a - law_.b) / (law_.b - law_.a), a_, b_);
      break;
    default:
      for (std::size_t n = 0; n < b_.size(); ++n) {
        const double square = static_cast<double>(n * n);
        b_[n] = square / (4 * square - 1);
      }
  }
}

/// Golub and Welsch (1969): eigenvalues of the recurrence's matrix, and first components of its vectors.
void Coordinate::find_quadrature() {
  Eigen::VectorXd diagonal(nodes), beside(nodes - 1);
  for (int n = 0; n < nodes; ++n) diagonal[n] = a_[static_cast<std::size_t>(n)];
  for (int n = 0; n + 1 < nodes; ++n) beside[n] = std::sqrt(b_[static_cast<std::size_t>(n) + 1]);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  for (int n = 0; n < nodes; ++n) {
    const double first = solver.eigenvectors()(0, n);
    quadrature_.push_back({solver.eigenvalues()[n], first * first});
  }
}

}  // namespace tunica::uncertainty
