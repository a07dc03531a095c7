// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "axisym/assembler.hpp"
#include "axisym/locate.hpp"

namespace tunica::axisym {

/// Nodal values of a cell in the basis of the displacement.
kernel::NodalVector<Frame, cell_width> nodal_displacement(const Assembler& assembler, int cell,
                                                          std::span<const double> y);
/// Likewise. The bubble, which vanishes at corners together with its gradient, is left out.
kernel::NodalVector<Frame, cell_width> nodal_velocity(const Assembler& assembler, int cell,
                                                      std::span<const double> y);

/// What the stress of the wall is computed from.
struct WallStrain {
  Vector<double> displacement{};  ///< d, cm
  Tensor<double> gradient{};      ///< dd/dX
  double pressure = 0;            ///< of mixed tissue: the interpolated wall pressure, dyn/cm2

  void add(double factor, const WallStrain& other);
};

/// The wall in one of its cells at a state. Keeps references to the table and the problem.
class WallCell {
 public:
  WallCell(const Assembler& assembler, const WallTable& table, std::span<const double> y);
  WallStrain at(const element::Local& local) const;

 private:
  const Problem& problem_;
  const WallTable& table_;
  kernel::NodalVector<Frame, cell_width> displacement_;
  std::optional<kernel::WallPressure<Frame>> pressure_;
};

/// Reads the strain of the wall out of states and makes stress of it.
class WallReader {
 public:
  explicit WallReader(const Assembler& assembler);

  const Assembler& assembler() const { return assembler_; }
  WallCell cell(int cell, std::span<const double> y) const;
  /// Mean over the places: those where cells of a layer meet.
  WallStrain mean(std::span<const Place> places, std::span<const double> y) const;
  Tensor<double> cauchy(int layer, const WallStrain& strain, const wall::MaterialAxes& axes) const;
  /// Mean directions of the wall over the places, in the unloaded vessel.
  wall::MaterialAxes axes(std::span<const Place> places) const;

 private:
  const Assembler& assembler_;
  std::vector<const WallTable*> tables_;  ///< by cell, null in blood
  std::vector<bool> mixed_;               ///< by layer
};

/// Families of a law that do not act like an earlier one at every strain without swirl, as families of equal
/// |angle| and threshold do.
std::vector<int> distinct_families(const wall::Law<double>& law);

}  // namespace tunica::axisym
