// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/frame.hpp"

/// Cell kernels: they lift nodal values to 3x3 tensors at quadrature points, evaluate the pointwise physics
/// there, on doubles for residuals and on duals for tangents, and contract the result with test and trial
/// functions. They know a frame by its tables and a cell by its shape functions, nothing else.
namespace tunica::kernel {

/// Shape functions at a point in a frame's lifts. `Width` is at least the number of shape functions; the
/// rest is zero, so that loops over it have a fixed length.
template <class Frame, int Width>
struct Lifted {
  double lift[Frame::lifts][Width] = {};
};

/// Nodal values of a vector field in a cell, by component.
template <class Frame, int Width>
struct NodalVector {
  double value[Frame::components][Width] = {};
};

template <int Width>
double interpolate(const double (&shape)[Width], const double (&nodal)[Width]) {
  double sum = 0;
  for (int k = 0; k < Width; ++k) sum += shape[k] * nodal[k];
  return sum;
}

/// Value of a vector field.
template <class Frame, int Width>
Vector<double> field_value(const Lifted<Frame, Width>& shapes, const NodalVector<Frame, Width>& nodal) {
  Vector<double> value{};
  for (int c = 0; c < Frame::components; ++c)
    value[Frame::axes[c]] = interpolate(shapes.lift[0], nodal.value[c]);
  return value;
}

/// Gradient of a vector field.
template <class Frame, int Width>
Tensor<double> field_gradient(const Lifted<Frame, Width>& shapes, const NodalVector<Frame, Width>& nodal) {
  Tensor<double> gradient;
  for (const frame::GradientSlot slot : Frame::gradient)
    gradient.entries[slot.entry] = interpolate(shapes.lift[slot.lift], nodal.value[slot.component]);
  return gradient;
}

template <class Frame>
inline constexpr int gradient_size = static_cast<int>(Frame::gradient.size());

/// Entries of a vector as duals numbered from `first`, one for each component.
template <class Frame, int N>
Vector<Dual<double, N>> seed_vector(const Vector<double>& value, int first, double slope = 1) {
  Vector<Dual<double, N>> seeded;
  for (int i = 0; i < 3; ++i) seeded[i] = Dual<double, N>(value[i]);
  for (int c = 0; c < Frame::components; ++c) seeded[Frame::axes[c]].derivative[first + c] = slope;
  return seeded;
}

/// Entries of a gradient as duals numbered from `first`, in the order of the frame's table.
template <class Frame, int N>
Tensor<Dual<double, N>> seed_gradient(const Tensor<double>& value, int first) {
  Tensor<Dual<double, N>> seeded = lift<Dual<double, N>>(value);
  for (int k = 0; k < gradient_size<Frame>; ++k)
    seeded.entries[Frame::gradient[k].entry].derivative[first + k] = 1;
  return seeded;
}

}  // namespace tunica::kernel
