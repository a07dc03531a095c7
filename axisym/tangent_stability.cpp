// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/tangent_stability.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tunica::axisym {

namespace {

/// L D L^T without pivoting; exact in its count of signs as long as no pivot nearly vanishes.
class Inertia {
 public:
  explicit Inertia(const SparseMatrix& pattern) { factors_.analyzePattern(pattern); }

  int negative(const SparseMatrix& matrix) {
    factors_.factorize(matrix);
    if (factors_.info() != Eigen::Success)
      throw SolverFailure("the stability of the state could not be told: a pivot of its stiffness vanishes");
    return static_cast<int>((factors_.vectorD().array() < 0).count());
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }

 private:
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

/// Twice the mean distance between sign changes of the radial displacement along the inner surface.
double wave_length(const Assembler& assembler, const Eigen::VectorXd& motion) {
  const Mesh& mesh = assembler.problem().mesh;
  const Layout& layout = assembler.layout();
  std::vector<std::pair<double, double>> line;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != Boundary::interface) continue;
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) {
      const int unknown = layout.unknown(layout.displacement(node, 0));
      if (unknown >= 0) line.emplace_back(mesh.points[node][1], motion[unknown]);
    }
  }
  std::sort(line.begin(), line.end());
  line.erase(std::unique(line.begin(), line.end()), line.end());
  // What has died away between ripples must not count with its noise.
  double greatest = 0;
  for (const auto& [z, u] : line) greatest = std::max(greatest, std::abs(u));
  std::erase_if(line, [&](const auto& point) { return std::abs(point.second) < 0.02 * greatest; });
  double first = 0, last = 0;
  int changes = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k].second * line[k - 1].second > 0) continue;
    const double z = 0.5 * (line[k].first + line[k - 1].first);
    if (changes++ == 0) first = z;
    last = z;
  }
  return changes > 1 ? 2 * (last - first) / (changes - 1) : 0.0;
}

}  // namespace

TangentStability tangent_stability(const Assembler& assembler, double time, std::span<const double> y) {
  if (assembler.problem().mesh.has(Part::blood))
    throw std::logic_error("tangent_stability: for a wall alone");
  const auto symmetric = [](const SparseMatrix& a) -> SparseMatrix {
    return 0.5 * (a + SparseMatrix(a.transpose()));
  };
  SparseMatrix tangent = assembler.pattern();
  assembler.tangent({time, 0, {}}, y, tangent);
  const SparseMatrix stiffness = symmetric(tangent);
  // The inertia of the wall enters a tangent as c^2 M.
  constexpr double coefficient = 1e6;
  SparseMatrix dynamic = assembler.pattern();
  assembler.tangent({time, coefficient, {}}, y, dynamic);
  const SparseMatrix mass = symmetric((dynamic - tangent) / (coefficient * coefficient));

  Inertia inertia(stiffness);
  TangentStability result;
  result.negative = inertia.negative(stiffness);
  const auto below = [&](double lambda) { return inertia.negative(stiffness - lambda * mass); };
  // Bracket of the least eigenvalue: from 0 outwards in powers of ten.
  double low = 0, high = 0;
  if (result.negative > 0) {
    for (low = -1; below(low) > 0; low *= 10) high = low;
  } else {
    for (high = 1; below(high) == 0; high *= 10) low = high;
  }
  while (std::abs(high - low) > 0.01 * std::max(std::abs(low), std::abs(high))) {
    const double middle = low * high > 0 ? std::copysign(std::sqrt(low * high), low) : 0.5 * (low + high);
    (below(middle) > 0 ? high : low) = middle;
  }
  result.least_eigenvalue = 0.5 * (low + high);

  inertia.negative(stiffness - low * mass);
  Eigen::VectorXd motion = Eigen::VectorXd::LinSpaced(stiffness.rows(), 1, 2);
  constexpr int iterations = 30;
  for (int k = 0; k < iterations; ++k) motion = inertia.solve(mass * motion).normalized();
  result.wave_length = wave_length(assembler, motion);
  return result;
}

}  // namespace tunica::axisym
