// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/coarser_meshes.hpp"

#include <algorithm>

#include "axisym/prolong.hpp"

namespace tunica::axisym {

namespace {

std::vector<Resolution> coarser_resolutions(const Resolution& finest, int layers) {
  std::vector<Resolution> meshes;
  for (const auto& counts : coupled::coarser_counts({{finest.wall_cells, std::max(2, layers)},
                                                     {finest.blood_cells, 2},
                                                     {finest.axial_cells, 16, 2}})) {
    Resolution& mesh = meshes.emplace_back(finest);
    mesh.wall_cells = counts[0];
    mesh.blood_cells = counts[1];
    mesh.axial_cells = counts[2];
  }
  return meshes;
}

class OwnMesh final : public coupled::StaticMesh {
 public:
  OwnMesh(const Scene& scene, const Resolution& resolution)
      : setup_(setup_of(scene, resolution)), assembler_(setup_->problem) {}
  coupled::Loading& loading() override { return *setup_; }
  const coupled::Equations& equations() const override { return assembler_; }

 private:
  std::unique_ptr<Setup> setup_;
  Assembler assembler_;
};

}  // namespace

CoarserMeshes::CoarserMeshes(const Scene& scene, const Setup& finest)
    : scene_(scene), finest_(finest.resolution) {
  if (scene.text("geometry.kind") != "mesh")
    resolutions_ = coarser_resolutions(finest.resolution, finest.problem.mesh.layers());
}

std::unique_ptr<coupled::StaticMesh> CoarserMeshes::make(int index) const {
  return std::make_unique<OwnMesh>(scene_, resolutions_[index]);
}

std::unique_ptr<coupled::StaticMesh> CoarserMeshes::make_finest() const {
  return std::make_unique<OwnMesh>(scene_, finest_);
}

std::vector<double> CoarserMeshes::prolong(const coupled::Equations& from, std::span<const double> y,
                                           const coupled::Equations& to) const {
  return axisym::prolong(dynamic_cast<const Assembler&>(from), y, dynamic_cast<const Assembler&>(to));
}

}  // namespace tunica::axisym
