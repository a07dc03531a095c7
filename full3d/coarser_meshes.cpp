// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/coarser_meshes.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "full3d/prolong.hpp"

namespace tunica::full3d {

namespace {

std::vector<Resolution> coarser_resolutions(const Resolution& finest, int layers) {
  using Count = int Resolution::*;
  struct Direction {
    Count count;
    int least;
    int multiple;
  };
  const Direction directions[] = {{&Resolution::wall_cells, std::max(1, layers), 1},
                                  {&Resolution::blood_cells, 1, 1},
                                  {&Resolution::axial_cells, 10, 2},
                                  {&Resolution::around_cells, 8, 8}};
  double ratio = 1;
  for (const auto& [count, least, multiple] : directions)
    ratio = std::max(ratio, static_cast<double>(finest.*count) / least);
  const int levels = static_cast<int>(std::ceil(std::log2(ratio) - 1e-9));
  std::vector<Resolution> meshes(levels, finest);
  for (int k = 0; k < levels; ++k)
    for (const auto& [count, least, multiple] : directions) {
      if (finest.*count <= least) continue;
      const double share = static_cast<double>(k) / levels;
      const double wanted = least * std::pow(static_cast<double>(finest.*count) / least, share);
      meshes[k].*count = multiple * static_cast<int>(std::lround(wanted / multiple));
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
