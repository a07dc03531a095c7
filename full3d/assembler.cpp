// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/assembler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/coupled/openings.hpp"
#include "core/error.hpp"
#include "full3d/solver_options.hpp"

namespace tunica::full3d {

using coupled::Stage;

namespace {

std::vector<int> all_cells_of(const Mesh& mesh) {
  std::vector<int> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

}  // namespace

Assembler::Assembler(const Problem& problem, const Ranks& ranks, SolverChoice choice,
                     std::unique_ptr<Announcer> announcer)
    : problem_(problem),
      ranks_(ranks),
      layout_(layout_of(problem)),
      share_(problem, layout_, ranks, std::move(choice)),
      announcer_(std::move(announcer)),
      all_(cell_work(problem, layout_, all_cells_of(problem.mesh), 1, false)) {
  if (!announcer_ && ranks.size() > 1) throw std::logic_error("Assembler: the other ranks are not told");
}

void Assembler::complete(const Stage& stage, std::span<double> y) const {
  coupled::complete(problem_, layout_, problem_.mesh.points, frame::Cartesian::axes, stage, y);
}

LoadedStage Assembler::loaded(const Stage& stage, std::span<const double> y) const {
  LoadedStage loaded{stage, {}};
  for (const Boundary boundary : {Boundary::inlet, Boundary::outlet, Boundary::interface})
    loaded.pressure[static_cast<std::size_t>(boundary)] =
        coupled::pressure_on(problem_, layout_, boundary, stage.time, y);
  return loaded;
}

bool Assembler::residual(const Stage& stage, std::span<const double> y, std::span<double> residual) const {
  const LoadedStage at = loaded(stage, y);
  if (announcer_) announcer_->residual(at, y);
  least_ = share_.residual(at, y, residual);
  if (!(least_.value > 0)) return false;
  coupled::add_scalars(problem_.inlet, problem_.outlet, layout_, stage, y, residual);
  return std::all_of(residual.begin(), residual.end(), [](double r) { return std::isfinite(r); });
}

void Assembler::follow(double time, std::span<double> y) const {
  if (!layout_.mesh_follows()) return;
  if (!follower_) follower_ = std::make_unique<MeshFollower>(layout_, *all_, share_.method() == "direct");
  follower_->follow(time, y);
}

std::vector<double> Assembler::volume_shares() const {
  std::vector<double> shares(problem_.mesh.points.size(), 0.0);
  all_->add_volumes(has_wall() ? Part::wall : Part::blood, shares);
  const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= whole;
  return shares;
}

coupled::Throughflow Assembler::flow(const Stage& stage, std::span<const double> y, Boundary boundary) const {
  const coupled::Throughflow meshed = all_->flow(stage, y, boundary);
  return {problem_.copies * meshed.net, problem_.copies * meshed.leaving};
}

LeastMode Assembler::least_mode(double time, std::span<const double> y) const {
  if (has_blood()) throw std::logic_error("least_mode: for a wall alone");
  const LoadedStage at = loaded({time, 0, {}}, y);
  if (announcer_) announcer_->least_mode(at, y);
  owner_of_factors_ = nullptr;
  return full3d::least_mode(share_, problem_, layout_, ranks_, at, y);
}

std::string Assembler::place_of_node(int node) const {
  const Point& x = problem_.mesh.points[node];
  return fmt::format("x = {:.4g}, y = {:.4g}, z = {:.4g} cm", x[0], x[1], x[2]);
}

std::string Assembler::compression(const LeastJacobian& least) const {
  const Mesh& mesh = problem_.mesh;
  const bool blood = mesh.cells[least.cell].part == Part::blood;
  const element::solid::Local centre = mesh.shape == Shape::hexahedron
                                           ? element::solid::Local{0, 0, 0}
                                           : element::solid::Local{0.25, 0.25, 0.25};
  const Point x = image(mesh, least.cell, centre).point;
  std::string text = fmt::format(
      "; the {} is {} at x = {:.4g}, y = {:.4g}, z = {:.4g} cm (cell {} of {})",
      blood ? "blood's mesh" : "wall",
      least.value > 0 ? fmt::format("compressed to J = {:.2g}", least.value) : "turned inside out", x[0],
      x[1], x[2], least.cell, mesh.cells.size());
  if (!blood || problem_.discretisation.motion != coupled::MeshMotion::harmonic) return text;
  return text + "; geometry.ends = \"sliding\" or, in a cylinder, mesh.motion = \"sectional\" may bear more";
}

/// That the linear solver cannot go on for lack of memory, or by what the user's options make of it, is told
/// with what the run has so far. Other failures are mistakes of the program.
template <class Work>
bool solver_failure_of(const SolverChoice& choice, const Work& work) {
  try {
    return work();
  } catch (const PetscFailure& error) {
    const std::string given = given_options(choice);
    const bool is_given = given.find_first_not_of(' ') != std::string::npos;
    if (!is_given && error.code() != PETSC_ERR_MEM && error.code() != PETSC_ERR_LIB) throw;
    throw SolverFailure(fmt::format("the linear solver failed, {}{}", error.what(),
                                    is_given ? fmt::format(" (options: {})", given) : ""));
  }
}

/// The derivative, whose factors or preconditioner the ranks share.
class SharedTangent final : public coupled::TangentSolver {
 public:
  explicit SharedTangent(const Assembler& assembler) : assembler_(assembler) {}

  bool factorise(const Stage& stage, std::span<const double> y) override {
    const LoadedStage at = assembler_.loaded(stage, y);
    if (assembler_.announcer_) assembler_.announcer_->factorise(at, y);
    assembler_.owner_of_factors_ = this;
    return solver_failure_of(assembler_.share_.choice(), [&] { return assembler_.share_.factorise(at, y); });
  }
  bool solve(std::span<double> right_hand_side) override {
    if (assembler_.owner_of_factors_ != this)
      throw std::logic_error("a solution with factors that have been replaced");
    if (assembler_.announcer_) assembler_.announcer_->solve();
    return solver_failure_of(assembler_.share_.choice(),
                             [&] { return assembler_.share_.solve(right_hand_side); });
  }
  long iterations() const override { return assembler_.share_.latest_iterations(); }
  // Factors and preconditioners are made of their matrix alone.
  void forget() override {}
  double entries() const override { return assembler_.share_.entries(); }

 private:
  const Assembler& assembler_;
};

std::unique_ptr<coupled::TangentSolver> Assembler::tangent_solver() const {
  return std::make_unique<SharedTangent>(*this);
}

}  // namespace tunica::full3d
