// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "axisym/assembler.hpp"
#include "axisym/locate.hpp"
#include "core/coupled/wall_strain.hpp"

namespace tunica::axisym {

/// Nodal values of a cell in the basis of the displacement.
kernel::NodalVector<Frame, cell_width> nodal_displacement(const Assembler& assembler, int cell,
                                                          std::span<const double> y);
/// Likewise. The bubble, which vanishes at corners together with its gradient, is left out.
kernel::NodalVector<Frame, cell_width> nodal_velocity(const Assembler& assembler, int cell,
                                                      std::span<const double> y);

using coupled::distinct_families;
using coupled::WallStrain;

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
  /// Mean directions of the wall over the places, in the unloaded vessel; the axis is NaN where no place has
  /// one.
  wall::MaterialAxes axes(std::span<const Place> places) const;

 private:
  const Assembler& assembler_;
  std::vector<const WallTable*> tables_;  ///< by cell, null in blood
};

}  // namespace tunica::axisym
