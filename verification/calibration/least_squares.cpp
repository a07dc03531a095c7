// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/calibration/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace tunica::verification::calibration {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A number of the search's own: below it a column of derivatives counts as zero. Over the whole of its range
/// such an unknown moves the residuals by less than a millionth of their standard deviation.
constexpr double no_influence = 1e-6;

/// What the misfit |r|^2 / 2 is taken for around a point: its gradient and second derivative.
struct Model {
  VectorXd gradient;
  MatrixXd second;

  double decrease(const VectorXd& s) const { return -gradient.dot(s) - 0.5 * s.dot(second * s); }
};

/// The model's step over the unknowns that no bound holds back, damped by lambda in the scale of J's
/// columns; 0 for the others. nullopt where the model is not convex.
std::optional<VectorXd> step(const Model& model, const MatrixXd& J, const VectorXd& u, double lambda) {
  MatrixXd second = model.second;
  VectorXd right = -model.gradient;
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const double diagonal = J.col(k).squaredNorm();
    const bool held = (u[k] <= 0 && model.gradient[k] > 0) || (u[k] >= 1 && model.gradient[k] < 0);
    if (held || diagonal <= no_influence * no_influence) {
      second.row(k).setZero();
      second.col(k).setZero();
      second(k, k) = 1;
      right[k] = 0;
    } else {
      second(k, k) += lambda * diagonal;
    }
  }
  const Eigen::LDLT<MatrixXd> factor(second);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
  return factor.solve(right);
}

/// By how much the model falls along the scaled descent, cut off at the box: 0 at a minimum only, whereas a
/// Newton step that the box cuts off may lead up.
double descent(const Model& model, const MatrixXd& J, const VectorXd& u) {
  VectorXd s(u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    const double diagonal = J.col(k).squaredNorm();
    const bool moves = diagonal > no_influence * no_influence;
    s[k] = moves ? std::clamp(u[k] - model.gradient[k] / diagonal, 0.0, 1.0) - u[k] : 0;
  }
  const double falls = -model.gradient.dot(s), bends = s.dot(model.second * s);
  if (!(falls > 0)) return 0;
  return model.decrease((bends > falls ? falls / bends : 1) * s);
}

/// What J^T J leaves out of the misfit's second derivative, sum of r_i d2r_i, learnt from the steps.
class Curvature {
 public:
  explicit Curvature(Eigen::Index unknowns) : learnt_(MatrixXd::Zero(unknowns, unknowns)) {}

  Model model(const Residuals& at, bool with_learnt) const {
    Model model{at.jacobian.transpose() * at.values, at.jacobian.transpose() * at.jacobian};
    if (with_learnt) model.second += learnt_;
    return model;
  }
  /// The symmetric secant update of Dennis, Gay and Welsch (1981).
  void learn(const Residuals& before, const Residuals& after, const VectorXd& s) {
    const VectorXd wanted = (after.jacobian - before.jacobian).transpose() * after.values;
    const VectorXd y =
        after.jacobian.transpose() * after.values - before.jacobian.transpose() * before.values;
    const double curved = y.dot(s);
    if (!(curved > 1e-12 * y.norm() * s.norm())) return;
    const double had = std::abs(s.dot(learnt_ * s));
    if (had > 0) learnt_ *= std::min(1.0, std::abs(s.dot(wanted)) / had);
    const VectorXd off = wanted - learnt_ * s;
    learnt_ += (off * y.transpose() + y * off.transpose()) / curved -
               s.dot(off) / (curved * curved) * (y * y.transpose());
  }

 private:
  MatrixXd learnt_;
};

}  // namespace

std::optional<Minimum> least_squares(const Evaluate& evaluate, VectorXd start, const SearchOptions& options) {
  auto first = evaluate(start, true);
  if (!first) return std::nullopt;
  Minimum best{std::move(start), std::move(*first), false, {}};
  const auto inside = [](const VectorXd& u) -> VectorXd { return u.cwiseMax(0).cwiseMin(1); };
  Curvature curvature(best.u.size());
  bool with_learnt = false;
  constexpr double undamped = 1e-10, most_damped = 1e8;
  double lambda = 1e-3, growth = 4;
  for (int tries = 0; tries < options.most_steps; ++tries) {
    const double cost = 0.5 * best.misfit();
    const MatrixXd& J = best.residuals.jacobian;
    if (with_learnt && !step(curvature.model(best.residuals, true), J, best.u, undamped)) with_learnt = false;
    const Model model = curvature.model(best.residuals, with_learnt);
    // Without what was learnt the model is convex at any damping.
    const auto proposed = [&](double damping) {
      return inside(best.u + step(model, J, best.u, damping).value());
    };
    const double left =
        std::max(model.decrease(proposed(undamped) - best.u), descent(model, J, best.u)) / (1 + cost);
    if (left < options.tolerance) {
      best.converged = true;
      return best;
    }
    const VectorXd next = proposed(lambda);
    const VectorXd s = next - best.u;
    const double promised = model.decrease(s);
    const auto there = evaluate(next, false);
    const double gained = there ? cost - 0.5 * there->values.squaredNorm() : -1;
    if (gained > 0 && gained > 1e-4 * promised) {
      // The answer at the new point is known; its derivatives may still fail.
      auto whole = there->jacobian.size() > 0 ? there : evaluate(next, true);
      if (whole) {
        const auto error = [&](bool learnt) {
          return std::abs(curvature.model(best.residuals, learnt).decrease(s) - gained);
        };
        with_learnt = error(true) < error(false);
        curvature.learn(best.residuals, *whole, s);
        best.u = next;
        best.residuals = std::move(*whole);
        if (gained > 0.5 * promised) lambda = std::max(0.1 * lambda, undamped);
        growth = 4;
        continue;
      }
    }
    lambda *= growth;
    growth *= 2;
    // Where no more than noise is left to gain, a second try that gains nothing settles it.
    const bool is_noise = left < options.noise;
    if (lambda > most_damped || (is_noise && growth > 8)) {
      best.converged = is_noise;
      if (!best.converged) best.reason = "no further step lowers the misfit";
      return best;
    }
  }
  best.reason = "the misfit still falls after the most steps that are made";
  return best;
}

Certainty certainty(const MatrixXd& jacobian) {
  const Eigen::Index n = jacobian.cols();
  Certainty result{MatrixXd::Zero(n, n), std::vector<bool>(n, true), std::vector<bool>(n, false)};
  // Columns of one length, so that what counts as unseen does not depend on the unknowns' scales.
  VectorXd scale(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    scale[k] = jacobian.col(k).norm();
    result.without_influence[k] = scale[k] < no_influence;
    if (result.without_influence[k]) scale[k] = 1;
  }
  const MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const VectorXd& values = svd.singularValues();
  constexpr double unseen = 1e-5;
  for (Eigen::Index i = 0; i < n; ++i) {
    const VectorXd direction = svd.matrixV().col(i);
    if (i < values.size() && values[i] > unseen) {
      const VectorXd moved = scale.cwiseInverse().asDiagonal() * direction / values[i];
      result.covariance += moved * moved.transpose();
      continue;
    }
    for (Eigen::Index k = 0; k < n; ++k)
      if (std::abs(direction[k]) > 1e-3) result.determined[k] = false;
  }
  return result;
}

}  // namespace tunica::verification::calibration
