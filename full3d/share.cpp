// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/share.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/coupled/openings.hpp"
#include "core/error.hpp"
#include "core/threads.hpp"
#include "full3d/partition.hpp"
#include "full3d/solver_options.hpp"

namespace tunica::full3d {

namespace {

/// Adds the time that it lives to a sum, s.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Share::Share(const Problem& problem, const Layout& layout, const Ranks& ranks, SolverChoice choice)
    : problem_(problem), layout_(layout), ranks_(ranks), choice_(std::move(choice)) {
  const std::vector<int> owner = partition(problem, ranks);
  std::vector<int> mine;
  for (int cell = 0; cell < static_cast<int>(owner.size()); ++cell)
    if (owner[cell] == ranks.rank()) mine.push_back(cell);
  work_ = cell_work(problem, layout, mine, std::max(1, available_threads() / ranks.on_machine()),
                    choice_.condense);
  share_rows(owner);
  choice_.mesh_is_given = layout.mesh_follows();
  choice_.name = method_for(choice_.name, rows_of(problem, layout));
}

Share::~Share() = default;

void Share::share_rows(const std::vector<int>& owner_of_cell) {
  const Mesh& mesh = problem_.mesh;
  std::vector<int> owner(mesh.points.size(), ranks_.size() - 1);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (const int node : mesh.cells[cell].nodes)
      if (node >= 0) owner[node] = std::min(owner[node], owner_of_cell[cell]);
  counts_.assign(ranks_.size(), 0);
  std::vector<int> owner_of_unknown(layout_.unknowns());
  for (int u = 0; u < layout_.unknowns(); ++u) {
    const std::size_t entry = layout_.entry(u);
    owner_of_unknown[u] = ranks_.size() - 1;
    if (entry < layout_.pressure_begin()) owner_of_unknown[u] = owner[layout_.node_of(entry)];
  }
  // The node of a pressure is found by going through the nodes: node_of would search for each.
  for (int node = 0; node < layout_.nodes(); ++node)
    if (layout_.has_pressure(node)) {
      const int u = layout_.unknown(layout_.pressure(node));
      if (u >= 0) owner_of_unknown[u] = owner[node];
    }
  // A bubble's unknowns have no rows; its node is of one cell alone.
  const bool bubble = choice_.condense && problem_.discretisation.element == Element::bubble;
  if (bubble)
    for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
      if (mesh.cells[cell].part != Part::blood) continue;
      const int node =
          mesh.node(cell, Basis::linear_bubble, element::solid::shape_count(mesh.shape, Basis::linear));
      for (int c = 0; c < layout_.components(); ++c)
        owner_of_unknown[layout_.unknown(layout_.velocity(node, c))] = -1;
    }
  condenses_ = bubble;
  for (const int rank : owner_of_unknown)
    if (rank >= 0) ++counts_[rank];
  offsets_.assign(ranks_.size(), 0);
  for (int r = 1; r < ranks_.size(); ++r) offsets_[r] = offsets_[r - 1] + counts_[r - 1];
  std::vector<int> next = offsets_;
  petsc_index_.assign(layout_.unknowns(), -1);
  for (int u = 0; u < layout_.unknowns(); ++u)
    if (owner_of_unknown[u] >= 0) petsc_index_[u] = next[owner_of_unknown[u]]++;
}

LeastJacobian Share::residual(const LoadedStage& stage, std::span<const double> y,
                              std::span<double> residual) {
  const Stopwatch watch(assembly_seconds_);
  std::fill(residual.begin(), residual.end(), 0.0);
  LeastJacobian least = work_->residual(stage, y, residual);
  if (problem_.loads.blood_force || problem_.loads.wall_force || problem_.loads.mesh_force ||
      problem_.loads.blood_volume || problem_.loads.traction)
    work_->add_loads(stage.stage.time, residual);
  ranks_.sum_to_leader(residual);
  if (ranks_.size() == 1) return least;
  struct {
    double value;
    int cell;
  } mine{std::isnan(least.value) ? -std::numeric_limits<double>::infinity() : least.value, least.cell},
      found{};
  check_mpi(MPI_Allreduce(&mine, &found, 1, MPI_DOUBLE_INT, MPI_MINLOC, ranks_.communicator()),
            "MPI_Allreduce");
  return {found.value, found.cell};
}

void Share::make_matrix() {
  std::vector<MatrixPlace> places = work_->pattern();
  own_entries_ = places.size();
  if (ranks_.leads())
    for (const auto& entry : coupled::scalar_tangent(problem_.outlet, layout_, 1))
      places.push_back({entry.row, entry.column});
  std::vector<PetscInt> rows, columns;
  rows.reserve(places.size());
  columns.reserve(places.size());
  for (const MatrixPlace& place : places) {
    rows.push_back(petsc_index_[place.row]);
    columns.push_back(petsc_index_[place.column]);
  }
  values_.resize(places.size());
  places = {};
  const PetscInt local = counts_[ranks_.rank()], all = PETSC_DETERMINE;
  check(MatCreate(ranks_.communicator(), matrix_.put()), "MatCreate");
  check(MatSetSizes(matrix_.get(), local, local, all, all), "MatSetSizes");
  check(MatSetType(matrix_.get(), MATAIJ), "MatSetType");
  check(MatSetPreallocationCOO(matrix_.get(), static_cast<PetscCount>(rows.size()), rows.data(),
                               columns.data()),
        "MatSetPreallocationCOO");
  check(MatCreateVecs(matrix_.get(), solution_.put(), right_.put()), "MatCreateVecs");
}

void Share::make_solver() {
  const int own = counts_[ranks_.rank()];
  insert_options(choice_, own);
  check(KSPCreate(ranks_.communicator(), solver_.put()), "KSPCreate");
  check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
  check(KSPSetFromOptions(solver_.get()), "KSPSetFromOptions");
  PetscBool direct = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(solver_.get()), KSPPREONLY, &direct),
        "PetscObjectTypeCompare");
  if (direct) return;
  std::vector<int> unknowns(own);
  for (int u = 0; u < layout_.unknowns(); ++u) {
    const int row = petsc_index_[u] - offsets_[ranks_.rank()];
    if (row >= 0 && row < own) unknowns[row] = u;
  }
  blocks_ = std::make_unique<Blocks>(layout_, unknowns, ranks_.communicator());
}

BloodVolumes Share::blood_volumes() const {
  const std::size_t nodes = problem_.mesh.points.size();
  BloodVolumes volumes{std::vector<double>(nodes), std::vector<double>(nodes), problem_.blood.density,
                       problem_.blood.viscosity};
  work_->add_blood_volumes(volumes.velocity, volumes.pressure);
  ranks_.sum_to_all(volumes.velocity);
  ranks_.sum_to_all(volumes.pressure);
  return volumes;
}

void Share::assemble(const LoadedStage& stage, std::span<const double> y) {
  if (!matrix_) make_matrix();
  const Stopwatch watch(assembly_seconds_);
  work_->tangent(stage, y, std::span(values_).first(own_entries_));
  if (ranks_.leads()) {
    std::size_t next = own_entries_;
    for (const auto& entry : coupled::scalar_tangent(problem_.outlet, layout_, stage.stage.coefficient))
      values_[next++] = entry.value;
  }
  check(MatSetValuesCOO(matrix_.get(), values_.data(), INSERT_VALUES), "MatSetValuesCOO");
}

bool Share::factorise(const LoadedStage& stage, std::span<const double> y) {
  assemble(stage, y);
  const bool is_first = !solver_;
  if (is_first) make_solver();
  PC pc = nullptr;
  check(KSPGetPC(solver_.get(), &pc), "KSPGetPC");
  if (blocks_) blocks_->scale(stage.stage.coefficient, matrix_.get());
  if (blocks_ && is_first) blocks_->split(pc, problem_.mesh, blood_volumes());
  check(KSPSetUp(solver_.get()), "KSPSetUp");
  if (blocks_) blocks_->update(pc, stage.stage.coefficient);
  PCFailedReason reason{};
  check(PCGetFailedReason(pc, &reason), "PCGetFailedReason");
  if (!ranks_.all(reason != PC_FACTOR_OUTMEMORY))
    throw SolverFailure(
        "the factors of the derivative found no memory; write solver.method = \"block\", or ask for fewer "
        "cells (mesh.*_cells, accuracy.tolerance, or a coarser geometry.file)");
  entries_ = factor_entries(pc);
  return ranks_.all(reason == PC_NOERROR);
}

bool Share::solve(std::span<double> right_hand_side) {
  if (!condenses_) return solve_rows(right_hand_side);
  std::vector<double> right(right_hand_side.begin(), right_hand_side.end());
  right.resize(layout_.unknowns());
  ranks_.broadcast(right);
  std::vector<double> change(right.size(), 0.0), solution = right;
  work_->condense(right, change);
  ranks_.sum_to_leader(change);
  for (std::size_t u = 0; u < change.size(); ++u) solution[u] += change[u];
  const bool solved = solve_rows(solution);
  ranks_.broadcast(solution);
  std::vector<double> inner = solution;
  work_->recover(right, inner);
  // Each bubble is set on one rank: the others add nothing to it.
  for (std::size_t u = 0; u < inner.size(); ++u)
    change[u] = petsc_index_[u] < 0 ? inner[u] - solution[u] : 0.0;
  ranks_.sum_to_leader(change);
  if (ranks_.leads())
    for (std::size_t u = 0; u < solution.size(); ++u) right_hand_side[u] = solution[u] + change[u];
  return solved;
}

bool Share::solve_rows(std::span<double> right_hand_side) {
  const int own = counts_[ranks_.rank()];
  std::vector<double> ordered;
  const auto rows = [&](const auto& visit) {
    for (std::size_t u = 0; u < right_hand_side.size(); ++u)
      if (petsc_index_[u] >= 0) visit(right_hand_side[u], ordered[petsc_index_[u]]);
  };
  if (ranks_.leads()) {
    ordered.resize(offsets_.back() + counts_.back());
    rows([](double value, double& row) { row = value; });
  }
  PetscScalar* local = nullptr;
  check(VecGetArray(right_.get(), &local), "VecGetArray");
  check_mpi(MPI_Scatterv(ordered.data(), counts_.data(), offsets_.data(), MPI_DOUBLE, local, own, MPI_DOUBLE,
                         0, ranks_.communicator()),
            "MPI_Scatterv");
  check(VecRestoreArray(right_.get(), &local), "VecRestoreArray");
  if (blocks_) blocks_->scale_right(right_.get());
  check(KSPSolve(solver_.get(), right_.get(), solution_.get()), "KSPSolve");
  KSPConvergedReason reason{};
  check(KSPGetConvergedReason(solver_.get(), &reason), "KSPGetConvergedReason");
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(solver_.get(), &iterations), "KSPGetIterationNumber");
  latest_iterations_ = std::max<long>(1, iterations);
  if (blocks_) {
    ++solutions_;
    iterations_ += iterations;
    blocks_->unscale_solution(solution_.get());
  }
  const PetscScalar* found = nullptr;
  check(VecGetArrayRead(solution_.get(), &found), "VecGetArrayRead");
  check_mpi(MPI_Gatherv(found, own, MPI_DOUBLE, ordered.data(), counts_.data(), offsets_.data(), MPI_DOUBLE,
                        0, ranks_.communicator()),
            "MPI_Gatherv");
  check(VecRestoreArrayRead(solution_.get(), &found), "VecRestoreArrayRead");
  if (ranks_.leads()) rows([](double& value, double row) { value = row; });
  return reason > 0;
}

}  // namespace tunica::full3d
