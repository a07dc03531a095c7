// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/coarser_meshes.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "full3d/prolong.hpp"

namespace tunica::full3d {

namespace {

std::vector<Resolution> coarser_resolutions(const Resolution& finest, int layers) {
  std::vector<Resolution> meshes;
  for (const auto& counts : coupled::coarser_counts({{finest.wall_cells, std::max(1, layers)},
                                                     {finest.blood_cells, 1},
                                                     {finest.axial_cells, 10, 2},
                                                     {finest.around_cells, 8, 8}})) {
    Resolution& mesh = meshes.emplace_back(finest);
    mesh.wall_cells = counts[0];
    mesh.blood_cells = counts[1];
    mesh.axial_cells = counts[2];
    mesh.around_cells = counts[3];
  }
  return meshes;
}

class OwnMesh final : public coupled::StaticMesh {
 public:
  OwnMesh(const Scene& scene, const Resolution& resolution, Team& team)
      : setup_(setup_of(scene, resolution)),
        assembler_(setup_->problem, team.ranks(), solver_of(scene), team.open(scene, resolution)) {}
  coupled::Loading& loading() override { return *setup_; }
  const coupled::Equations& equations() const override { return assembler_; }

 private:
  std::unique_ptr<Setup> setup_;
  Assembler assembler_;
};

}  // namespace

CoarserMeshes::CoarserMeshes(const Scene& scene, const Setup& finest, Team& team)
    : scene_(scene), shape_(finest.shape), team_(team), finest_(finest.resolution) {
  // A mesh from a file has none.
  if (finest.axes) return;
  resolutions_ = coarser_resolutions(finest.resolution, finest.problem.mesh.layers());
  // A bend may ask for more cells along it than the coarsest meshes have.
  std::erase_if(resolutions_, [&](const Resolution& resolution) {
    try {
      o_grid_vessel(vessel_spec(scene, resolution, finest.problem.mesh.has(Part::blood)));
      return false;
    } catch (const InvalidInput&) {
      return true;
    }
  });
}

std::unique_ptr<coupled::StaticMesh> CoarserMeshes::make(int index) const {
  return std::make_unique<OwnMesh>(scene_, resolutions_[index], team_);
}

std::unique_ptr<coupled::StaticMesh> CoarserMeshes::make_finest() const {
  return std::make_unique<OwnMesh>(scene_, finest_, team_);
}

std::vector<double> CoarserMeshes::prolong(const coupled::Equations& from, std::span<const double> y,
                                           const coupled::Equations& to) const {
  const auto &source = dynamic_cast<const Assembler&>(from), &target = dynamic_cast<const Assembler&>(to);
  return full3d::prolong(shape_, source.problem(), source.layout(), y, target.problem(), target.layout());
}

}  // namespace tunica::full3d
