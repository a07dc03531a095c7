// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kernel/lifted.hpp"

namespace tunica::kernel {

/// Dense block of a cell matrix: rows are shape functions of the test field's component, columns those of
/// the trial field's.
template <int Width>
struct Block {
  double entry[Width][Width] = {};
};

/// Coefficients between the lifts of a test and of a trial function at a point.
template <class Frame>
struct LiftMatrix {
  double entry[Frame::lifts][Frame::lifts] = {};
};

/// block += weight * test^T coefficients trial
template <class Frame, int Width>
void add_block(double weight, const LiftMatrix<Frame>& coefficients, const Lifted<Frame, Width>& test,
               const Lifted<Frame, Width>& trial, Block<Width>& block) {
  // Most terms have few of the lifts: only rows that are not zero are kept.
  double row[Frame::lifts][Width];
  const double* lift[Frame::lifts];
  int rows = 0;
  for (int a = 0; a < Frame::lifts; ++a) {
    bool is_zero = true;
    for (int b = 0; b < Frame::lifts; ++b) {
      const double factor = weight * coefficients.entry[a][b];
      if (factor == 0) continue;
      if (is_zero)
        for (int l = 0; l < Width; ++l) row[rows][l] = factor * trial.lift[b][l];
      else
        for (int l = 0; l < Width; ++l) row[rows][l] += factor * trial.lift[b][l];
      is_zero = false;
    }
    if (!is_zero) lift[rows++] = test.lift[a];
  }
  for (int k = 0; k < Width; ++k) {
    double* const out = block.entry[k];
    for (int a = 0; a < rows; ++a) {
      const double t = lift[a][k];
      for (int l = 0; l < Width; ++l) out[l] += t * row[a][l];
    }
  }
}

/// One term of a weak form seen by a kernel: component of the field and lift of its shape functions.
struct Slot {
  int component;
  int lift;
};

/// Slots of a vector field: its components' values, then its gradient's entries.
template <class Frame>
constexpr auto vector_slots() {
  std::array<Slot, Frame::components + Frame::gradient.size()> slots{};
  for (int c = 0; c < Frame::components; ++c) slots[c] = {c, 0};
  for (std::size_t k = 0; k < Frame::gradient.size(); ++k)
    slots[Frame::components + k] = {Frame::gradient[k].component, Frame::gradient[k].lift};
  return slots;
}

/// Slots of a scalar field: its value, then its derivatives.
template <class Frame>
constexpr auto scalar_slots() {
  std::array<Slot, 1 + Frame::dimension> slots{};
  for (int k = 0; k <= Frame::dimension; ++k) slots[k] = {0, k};
  return slots;
}

/// Adds the derivative of a test field's terms by a trial field's terms. `derivative(out, in)` is that of
/// term `out` by term `in`, numbered as the slots; blocks are [test component][trial component].
template <class Frame, int Width, std::size_t Out, std::size_t In, int TestComponents, int TrialComponents,
          class Derivative>
void contract(double weight, const std::array<Slot, Out>& out, const std::array<Slot, In>& in,
              const Derivative& derivative, const Lifted<Frame, Width>& test,
              const Lifted<Frame, Width>& trial, Block<Width> (&blocks)[TestComponents][TrialComponents]) {
  LiftMatrix<Frame> coefficients[TestComponents][TrialComponents];
  for (std::size_t o = 0; o < Out; ++o)
    for (std::size_t i = 0; i < In; ++i)
      coefficients[out[o].component][in[i].component].entry[out[o].lift][in[i].lift] +=
          derivative(static_cast<int>(o), static_cast<int>(i));
  for (int a = 0; a < TestComponents; ++a)
    for (int b = 0; b < TrialComponents; ++b)
      add_block(weight, coefficients[a][b], test, trial, blocks[a][b]);
}

/// residual += weight * (force . phi + stress : dphi/dX) for all test functions.
template <class Frame, int Width>
void test_vector(double weight, const Vector<double>& force, const Tensor<double>& stress,
                 const Lifted<Frame, Width>& test, NodalVector<Frame, Width>& residual) {
  double coefficient[Frame::components][Frame::lifts] = {};
  for (int c = 0; c < Frame::components; ++c) coefficient[c][0] = weight * force[Frame::axes[c]];
  for (const frame::GradientSlot slot : Frame::gradient)
    coefficient[slot.component][slot.lift] += weight * stress.entries[slot.entry];
  for (int c = 0; c < Frame::components; ++c)
    for (int a = 0; a < Frame::lifts; ++a)
      for (int k = 0; k < Width; ++k) residual.value[c][k] += coefficient[c][a] * test.lift[a][k];
}

}  // namespace tunica::kernel
