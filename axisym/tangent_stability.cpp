// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/tangent_stability.hpp"

#include <Eigen/SparseCholesky>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tunica::axisym {

namespace {

/// L D L^T without pivoting; exact in its count of signs as long as no pivot nearly vanishes.
class StiffnessAndMass final : public coupled::StiffnessAndMass {
 public:
  StiffnessAndMass(const Assembler& assembler, double time, std::span<const double> y) {
    const auto symmetric = [](const SparseMatrix& a) -> SparseMatrix {
      return 0.5 * (a + SparseMatrix(a.transpose()));
    };
    SparseMatrix tangent = assembler.pattern(), dynamic = assembler.pattern();
    assembler.tangent({time, 0, {}}, y, tangent);
    assembler.tangent({time, coefficient, {}}, y, dynamic);
    stiffness_ = symmetric(tangent);
    mass_ = symmetric((dynamic - tangent) / (coefficient * coefficient));
    factors_.analyzePattern(stiffness_);
  }

  int negative(double lambda) override {
    factors_.factorize(stiffness_ - lambda * mass_);
    if (factors_.info() != Eigen::Success) throw SolverFailure(coupled::vanishing_pivot);
    return static_cast<int>((factors_.vectorD().array() < 0).count());
  }
  /// The motion that changes the slowest, with the latest factors.
  Eigen::VectorXd slowest() const {
    Eigen::VectorXd motion = Eigen::VectorXd::LinSpaced(stiffness_.rows(), 1, 2);
    for (int k = 0; k < iterations; ++k) motion = factors_.solve(mass_ * motion).normalized();
    return motion;
  }

 private:
  SparseMatrix stiffness_, mass_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

/// Radial displacement by height along the inner surface.
std::vector<std::pair<double, double>> inner_line(const Assembler& assembler, const Eigen::VectorXd& motion) {
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
  return line;
}

}  // namespace

TangentStability tangent_stability(const Assembler& assembler, double time, std::span<const double> y) {
  if (assembler.problem().mesh.has(Part::blood))
    throw std::logic_error("tangent_stability: for a wall alone");
  StiffnessAndMass pencil(assembler, time, y);
  TangentStability result = coupled::least_mode(pencil);
  result.wave_length = coupled::wave_length(inner_line(assembler, pencil.slowest()));
  return result;
}

}  // namespace tunica::axisym
