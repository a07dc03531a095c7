// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/axisym_tier.hpp"

#include "axisym/coarser_meshes.hpp"
#include "axisym/fields.hpp"
#include "axisym/key_derivative.hpp"
#include "axisym/observer.hpp"
#include "axisym/remarks.hpp"
#include "axisym/tangent_stability.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/coupled/locking.hpp"
#include "core/coupled/vessel_run.hpp"
#include "core/element/gmsh_file.hpp"
#include "core/error.hpp"
#include "core/stability/warning.hpp"

namespace tunica::axisym {

namespace {

std::unique_ptr<Setup> setup_for_steps(const Scene& scene) {
  auto setup = setup_of(scene);
  Problem& problem = setup->problem;
  problem.discretisation.lagged_mesh =
      coupled::lags_mesh(scene, problem.mesh.has(Part::blood), problem.mesh.has(Part::wall));
  return setup;
}

class AxisymVessel final : public coupled::Vessel {
 public:
  explicit AxisymVessel(const Scene& scene)
      : scene_(scene),
        setup_(setup_for_steps(scene)),
        assembler_(setup_->problem),
        coarser_(scene, *setup_),
        observer_(assembler_),
        fields_(assembler_) {}

  coupled::Loading& loading() override { return *setup_; }
  const coupled::Equations& equations() const override { return assembler_; }
  const coupled::CoarserMeshes& coarser() const override { return coarser_; }
  std::unique_ptr<coupled::StaticMesh> steady_mesh() const override {
    return assembler_.layout().mesh_follows() ? coarser_.make_finest() : nullptr;
  }
  std::unique_ptr<coupled::KeyedEquations> keyed(const coupled::Equations& equations) const override {
    return keyed_equations(scene_, setup_->resolution, dynamic_cast<const Assembler&>(equations));
  }
  const coupled::Observing& observer() const override { return observer_; }
  const coupled::Picturing& fields() const override { return fields_; }
  double local_tolerance() const override { return setup_->resolution.local_tolerance; }
  double newton_tolerance() const override { return setup_->resolution.newton_tolerance; }

  void describe(RunRecord& record) const override {
    const Resolution& r = setup_->resolution;
    const Mesh& mesh = setup_->problem.mesh;
    record.tier = "axisym";
    record.resolution = {{"element", scene_.text("mesh.element")},
                         {"cells", mesh.cells.size()},
                         {"nodes", mesh.points.size()}};
    if (scene_.text("geometry.kind") == "mesh") return;
    record.resolution["wall_cells"] = r.wall_cells;
    record.resolution["blood_cells"] = r.blood_cells;
    record.resolution["axial_cells"] = r.axial_cells;
  }

  std::vector<std::string> warnings() const override {
    auto warnings = remarks_on_unused_keys(scene_, *setup_);
    const Problem& problem = setup_->problem;
    if (const auto remark = coupled::locking_remark(problem.discretisation.element,
                                                    problem.mesh.shape == CellShape::triangle, problem.laws))
      warnings.push_back(*remark);
    if (scene_.text("geometry.kind") == "mesh")
      if (const auto remark = coupled::radius_remark(inlet_radius(setup_->problem.mesh), scene_))
        warnings.push_back(*remark);
    if (stability::may_ripple(scene_) && setup_->ring && scene_.text("geometry.kind") != "mesh")
      if (const auto warning = stability::warning(scene_, setup_->expected_pressure))
        warnings.push_back(*warning);
    return warnings;
  }

  void judge_static(std::span<const double> state, RunRecord& record) const override {
    if (assembler_.has_blood()) return;
    try {
      coupled::record_stability(tangent_stability(assembler_, 0, state), setup_->problem.tether.traction,
                                record);
    } catch (const SolverFailure& failure) {
      record.findings.emplace_back(failure.what());
    }
  }

 private:
  const Scene& scene_;
  std::unique_ptr<Setup> setup_;
  Assembler assembler_;
  CoarserMeshes coarser_;
  Observer observer_;
  Fields fields_;
};

}  // namespace

std::string AxisymTier::refusal(const Scene& scene) const {
  if (scene.has("mesh.motion") && scene.text("mesh.motion") == "sectional" && !has_sections(scene))
    return "mesh.motion = \"sectional\" needs the sections of own quadrilaterals; use \"harmonic\" or "
           "\"stiffened\"";
  if (scene.text("geometry.kind") == "torus")
    return "geometry.kind = \"torus\" is not axisymmetric; use a 3D tier, or kind = \"cylinder\"";
  if (scene.text("geometry.kind") == "mesh" &&
      element::gmsh_dimensions(scene.folder() / scene.text("geometry.file")) == 3)
    return "geometry.file is a vessel in space; use --tier full3d, or mesh its half plane";
  if (scene.flag("wall.incompressible"))
    return "wall.incompressible = true is for the 0D tier; write false and a large wall.bulk_modulus (9e6 "
           "dyn/cm2 "
           "changes the volume by 1 to 2 %)";
  if (!scene.texts("sensitivity.parameters").empty() && scene.text("time.start") == "periodic")
    return "sensitivity.parameters with time.start = \"periodic\" are for the 0D tier; write time.start = "
           "\"rest\" or \"static\", or use --tier lumped";
  if (scene.has("time.scheme") && scene.text("time.scheme") == "generalized-alpha" &&
      scene.number("time.step") == 0)
    return "time.scheme = \"generalized-alpha\" is of first order in pressure when steps vary; give "
           "time.step, such "
           "as 1e-3";
  return {};
}

bool AxisymTier::suits(const Scene& scene) const {
  return scene.text("geometry.kind") != "torus" && refusal(scene).empty();
}

std::unique_ptr<TierRun> AxisymTier::prepare(const Scene& scene) const {
  return coupled::vessel_run(scene, [&] { return std::make_unique<AxisymVessel>(scene); });
}

}  // namespace tunica::axisym
