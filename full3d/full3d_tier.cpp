// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/full3d_tier.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/coupled/gmsh_parts.hpp"
#include "core/coupled/locking.hpp"
#include "core/coupled/vessel_run.hpp"
#include "core/coupled/wall_strain.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/scene/unused.hpp"
#include "core/stability/warning.hpp"
#include "core/threads.hpp"
#include "full3d/coarser_meshes.hpp"
#include "full3d/fields.hpp"
#include "full3d/measures.hpp"
#include "full3d/memory.hpp"
#include "full3d/observer.hpp"
#include "full3d/option_check.hpp"
#include "full3d/refusal.hpp"
#include "full3d/solver_options.hpp"

namespace tunica::full3d {

namespace {

const char* name_of(Sector sector) {
  return sector == Sector::full ? "full" : sector == Sector::half ? "half" : "quarter";
}

/// Throws InvalidInput for options that no solver can have: before other ranks are told of them.
SolverChoice tried_solver_of(const Scene& scene, const Setup& setup) {
  const SolverChoice choice = solver_of(scene);
  check_options(choice);
  const Problem& problem = setup.problem;
  const bool with_blood = problem.mesh.has(Part::blood), lagged_mesh = problem.discretisation.lagged_mesh;
  const auto try_with = [&](bool lagged) {
    SolverChoice tried = choice;
    tried.name = method_for(choice.name, rows_of(problem, layout_of(problem)));
    try_options(tried, with_blood, lagged);
  };
  try_with(lagged_mesh);
  // Steady states are found with the mesh among the unknowns.
  if (lagged_mesh && scene.text("time.start") != "rest") try_with(false);
  return choice;
}

/// Throws InvalidInput for what there is no memory for.
std::unique_ptr<Setup> setup_in_memory(const Scene& scene) {
  auto setup = setup_of(scene);
  Problem& problem = setup->problem;
  const auto check_mesh = [&] {
    const int rows = rows_of(problem, layout_of(problem));
    check_memory(method_for(scene.text("solver.method"), rows), rows, available_memory());
  };
  // A steady state to begin from is found with the mesh among the unknowns.
  if (scene.text("time.start") != "rest") check_mesh();
  problem.discretisation.lagged_mesh = coupled::lags_mesh(scene, problem.mesh.has(Part::blood), true);
  check_mesh();
  return setup;
}

class Full3dVessel final : public coupled::Vessel {
 public:
  Full3dVessel(const Scene& scene, Team& team)
      : scene_(scene),
        ranks_(team.ranks()),
        setup_(setup_in_memory(scene)),
        solver_(tried_solver_of(scene, *setup_)),
        assembler_(setup_->problem, team.ranks(), solver_,
                   team.open(scene, setup_->resolution, setup_->problem.discretisation.lagged_mesh)),
        coarser_(scene, *setup_, team),
        observer_(*setup_, assembler_),
        fields_(*setup_, assembler_, std::max(1, available_threads() / team.ranks().on_machine())) {}

  coupled::Loading& loading() override { return *setup_; }
  const coupled::Equations& equations() const override { return assembler_; }
  const coupled::CoarserMeshes& coarser() const override { return coarser_; }
  std::unique_ptr<coupled::StaticMesh> steady_mesh() const override {
    return assembler_.layout().mesh_follows() ? coarser_.make_finest() : nullptr;
  }
  const coupled::Observing& observer() const override { return observer_; }
  const coupled::Picturing& fields() const override { return fields_; }
  double local_tolerance() const override { return setup_->resolution.local_tolerance; }
  double newton_tolerance() const override { return setup_->resolution.newton_tolerance; }

  void describe(RunRecord& record) const override {
    const Resolution& r = setup_->resolution;
    const Mesh& mesh = setup_->problem.mesh;
    record.tier = tier_name;
    record.resolution = {{"element", scene_.text("mesh.element")},
                         {"cells", mesh.cells.size()},
                         {"nodes", mesh.points.size()},
                         {"solver", assembler_.share().method()},
                         {"ranks", ranks_.size()}};
    if (setup_->axes) return;
    record.resolution["wall_cells"] = r.wall_cells;
    record.resolution["blood_cells"] = r.blood_cells;
    record.resolution["axial_cells"] = r.axial_cells;
    record.resolution["around_cells"] = r.around_cells;
    record.resolution["symmetry"] = name_of(setup_->sector);
  }

  void judge_static(std::span<const double> state, RunRecord& record) const override {
    if (assembler_.has_blood()) return;
    const int rows = rows_of(setup_->problem, assembler_.layout());
    const auto available = available_memory();
    if (const double needed = estimated_memory("direct", rows); available && needed > *available) {
      record.findings.push_back(fmt::format(
          "stability was not checked: that takes factors, an estimated {:.3g} GiB", needed / (1 << 30)));
      return;
    }
    try {
      const LeastMode mode = assembler_.least_mode(0, state);
      TangentStability found = mode.stability;
      // Meshes from a file have no lines along their wall.
      if (!setup_->axes)
        found.wave_length = wave_length(setup_->problem, assembler_.layout(), setup_->shape, mode.motion);
      coupled::record_stability(found, setup_->problem.tether.traction, record);
    } catch (const SolverFailure& failure) {
      record.findings.emplace_back(failure.what());
    }
  }

  void conclude(RunRecord& record) const override {
    record.resolution["assembly_seconds"] = assembler_.share().assembly_seconds();
    if (const long solutions = assembler_.share().solutions(); solutions > 0) {
      record.resolution["krylov_iterations"] = assembler_.krylov_iterations();
      record.resolution["krylov_solutions"] = solutions;
    }
    const auto unused = unused_options(solver_);
    if (!unused.empty())
      record.findings.push_back(
          fmt::format("solver.options: the solver does not ask for {}", fmt::join(unused, ", ")));
  }

  std::vector<std::string> warnings() const override {
    std::vector<scene::Unused> unused{{{"lumped."}, "the tier is full3d"}};
    if (scene_.text("time.mode") == "static")
      unused.push_back({{"time.beats", "time.start", "time.ramp", "output.interval", "output.profile_times",
                         "outlet.compliance", "solver.geometry"},
                        "time.mode is \"static\""});
    if (!assembler_.has_blood())
      unused.push_back({{"blood.", "inlet.profile", "inlet.pressure_kind", "outlet.", "mesh.blood_cells",
                         "mesh.motion", "solver.geometry"},
                        "a wall under a given pressure is computed without its blood"});
    if (setup_->inlet.is_pressure) unused.push_back({{"inlet.profile"}, "a pressure drives the flow"});
    if (setup_->problem.inlet.kind == InletKind::prescribed)
      unused.push_back({{"inlet.pressure_kind"}, "the velocity at the inlet is prescribed"});
    if (setup_->axes)
      unused.push_back({{"geometry.thickness", "geometry.length"}, "geometry.kind is \"mesh\""});
    if (scene_.text("mesh.element") == "bubble")
      unused.push_back({{"mesh.mixed_wall"}, "mesh.element is \"bubble\""});
    else if (coupled::is_far_from_incompressible(setup_->problem.laws))
      unused.push_back({{"mesh.mixed_wall"}, "the wall is far from incompressible"});
    auto warnings = scene::remarks_on(scene_, unused);
    const Problem& problem = setup_->problem;
    if (const auto remark = coupled::locking_remark(problem.discretisation.element,
                                                    problem.mesh.shape == Shape::tetrahedron, problem.laws))
      warnings.push_back(*remark);
    if (setup_->axes)
      if (const auto remark = coupled::radius_remark(inlet_radius(setup_->problem.mesh), scene_))
        warnings.push_back(*remark);
    if (stability::may_ripple(scene_) && !setup_->axes)
      if (const auto warning = stability::warning(scene_, setup_->expected_pressure))
        warnings.push_back(*warning);
    return warnings;
  }

 private:
  const Scene& scene_;
  const Ranks& ranks_;
  std::unique_ptr<Setup> setup_;
  SolverChoice solver_;
  Assembler assembler_;
  CoarserMeshes coarser_;
  Observer observer_;
  Fields fields_;
};

}  // namespace

std::string_view Full3dTier::name() const {
  return tier_name;
}
std::string Full3dTier::refusal(const Scene& scene) const {
  return full3d::refusal(scene);
}
bool Full3dTier::suits(const Scene& scene) const {
  return full3d::suits(scene);
}

std::unique_ptr<TierRun> Full3dTier::prepare(const Scene& scene) const {
  return coupled::vessel_run(scene, [&] { return std::make_unique<Full3dVessel>(scene, team_); });
}

}  // namespace tunica::full3d
