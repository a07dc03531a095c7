// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <span>
#include <vector>

#include "core/coupled/layout.hpp"
#include "core/kernel/blood_cell.hpp"

namespace tunica::coupled {

/// The equations of the mesh's motion alone, int k grad d : grad psi dX = int f . psi dX, for the
/// displacement off the wall where it follows that of the wall (Layout::mesh_follows). They are linear,
/// symmetric and positive definite, and the same at all times.
class MeshExtension {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// A solver of among() x = b: overwrites b with x.
  using Solve = std::function<void(std::span<double> b)>;

  /// The layout must outlive it.
  explicit MeshExtension(const Layout& layout) : layout_(layout) {}

  /// Adds a blood cell. Every cell before finish().
  template <class Frame, int Width>
  void add(std::span<const int> nodes, double stiffness,
           std::span<const kernel::BloodPoint<Frame, Width>> points) {
    kernel::Block<Width> blocks[Frame::components][Frame::components];
    for (const auto& point : points) kernel::add_mesh_tangent(stiffness, {}, point, blocks);
    for (int c = 0; c < Frame::components; ++c)
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const int row = layout_.follower(layout_.displacement(nodes[k], c));
        if (row < 0) continue;
        for (std::size_t l = 0; l < nodes.size(); ++l)
          note(row, layout_.displacement(nodes[l], c), blocks[c][c].entry[k][l]);
      }
  }
  void finish();

  /// Between the entries that follow, in the order of Layout::followers; both triangles.
  const Matrix& among() const { return among_; }

  /// Adds what a force (cm per cm2, on the tensor's axes) on a cell does to the loads of the entries that
  /// follow.
  template <class Frame, int Width>
  void add_load(std::span<const int> nodes, const kernel::BloodPoint<Frame, Width>& at,
                const Vector<double>& force, std::span<double> loads) const {
    kernel::NodalVector<Frame, Width> nodal;
    kernel::test_vector(at.weight, force, Tensor<double>{}, at.displacement, nodal);
    for (int c = 0; c < Frame::components; ++c)
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const int row = layout_.follower(layout_.displacement(nodes[k], c));
        if (row >= 0) loads[row] += nodal.value[c][k];
      }
  }

  /// Sets the entries of y that follow from the others of the displacement, under the loads.
  void extend(std::span<double> loads, const Solve& solve, std::span<double> y) const;

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;
  void note(int row, std::size_t column, double value);
  static void gather(Entries& entries, Matrix& matrix);

  const Layout& layout_;
  Matrix among_, from_given_;  ///< columns: followers, entries of y
  Entries among_entries_, given_entries_;
};

}  // namespace tunica::coupled
