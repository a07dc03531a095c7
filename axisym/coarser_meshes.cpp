// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/coarser_meshes.hpp"

#include <algorithm>
#include <cmath>

#include "axisym/prolong.hpp"

namespace tunica::axisym {

namespace {

/// Meshes that lead from a coarse one to that of a resolution, each of at most twice the cells in a
/// direction; without the latter.
std::vector<Resolution> coarser_resolutions(const Resolution& finest, int layers) {
  using Count = int Resolution::*;
  struct Direction {
    Count count;
    int least;
  };
  const Direction directions[] = {{&Resolution::wall_cells, std::max(2, layers)},
                                  {&Resolution::blood_cells, 2},
                                  {&Resolution::axial_cells, 16}};
  double ratio = 1;
  for (const auto& [count, least] : directions)
    ratio = std::max(ratio, static_cast<double>(finest.*count) / least);
  const int levels = static_cast<int>(std::ceil(std::log2(ratio) - 1e-9));
  std::vector<Resolution> meshes(levels, finest);
  for (int k = 0; k < levels; ++k) {
    for (const auto& [count, least] : directions) {
      if (finest.*count <= least) continue;
      const double share = static_cast<double>(k) / levels;
      meshes[k].*count = static_cast<int>(std::lround(least * std::pow(finest.*count / least, share)));
    }
    meshes[k].axial_cells += meshes[k].axial_cells % 2;
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
