// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/coupled/wall_strain.hpp"
#include "full3d/layout.hpp"
#include "full3d/locate.hpp"

namespace tunica::full3d {

using coupled::WallStrain;

/// Reads the wall at places that stay the same out of states.
class WallProbe {
 public:
  virtual ~WallProbe() = default;
  /// At each place, in their order.
  virtual std::vector<WallStrain> strains(std::span<const double> y) const = 0;
};

/// Blood at a place of the moving mesh.
struct BloodSample {
  Vector<double> displacement{}, velocity{};
  Tensor<double> displacement_gradient{}, velocity_gradient{};  ///< by the place in the reference mesh
  double pressure = 0;
};

class BloodProbe {
 public:
  virtual ~BloodProbe() = default;
  virtual std::vector<BloodSample> samples(std::span<const double> y) const = 0;
};

/// Places must lie in wall cells (in blood cells). With `keep` the tables of all their cells are kept, which
/// is for few cells that are read often; without, they are made at each reading, on so many threads.
std::unique_ptr<WallProbe> wall_probe(const Problem& problem, const Layout& layout, std::vector<Place> places,
                                      bool keep, int threads = 1);
std::unique_ptr<BloodProbe> blood_probe(const Problem& problem, const Layout& layout,
                                        std::vector<Place> places);

/// Mean pressure of the blood over the current image of some faces of its cells: int p da / int da.
double mean_pressure(const Problem& problem, const Layout& layout, std::span<const Face> faces,
                     std::span<const double> y);

}  // namespace tunica::full3d
