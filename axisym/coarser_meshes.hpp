// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/setup.hpp"
#include "core/coupled/static_state.hpp"

namespace tunica::axisym {

/// Meshes that lead from a coarse one to that of a setup; none for a mesh from a file. The scene and the
/// setup must outlive it.
class CoarserMeshes final : public coupled::CoarserMeshes {
 public:
  CoarserMeshes(const Scene& scene, const Setup& finest);
  int count() const override { return static_cast<int>(resolutions_.size()); }
  std::unique_ptr<coupled::StaticMesh> make(int index) const override;
  /// The finest mesh.
  std::unique_ptr<coupled::StaticMesh> make_finest() const;
  std::vector<double> prolong(const coupled::Equations& from, std::span<const double> y,
                              const coupled::Equations& to) const override;

 private:
  const Scene& scene_;
  Resolution finest_;
  std::vector<Resolution> resolutions_;
};

}  // namespace tunica::axisym
