// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/dual.hpp"

namespace tunica {

template <class S>
using Vector = std::array<S, 3>;

/// Second-order tensor on three-dimensional space, row-major. Every frame (Cartesian, axisymmetric,
/// radial) hands its gradients over in this form, so that no law knows the dimension of a mesh.
template <class S>
struct Tensor {
  std::array<S, 9> entries{};

  S& operator()(int i, int j) { return entries[3 * i + j]; }
  const S& operator()(int i, int j) const { return entries[3 * i + j]; }

  static Tensor identity() { return diagonal(S(1.0), S(1.0), S(1.0)); }
  static Tensor diagonal(const S& a, const S& b, const S& c) {
    Tensor t;
    t(0, 0) = a;
    t(1, 1) = b;
    t(2, 2) = c;
    return t;
  }
};

template <class S>
Tensor<S> operator+(Tensor<S> a, const Tensor<S>& b) {
  for (int k = 0; k < 9; ++k) a.entries[k] = a.entries[k] + b.entries[k];
  return a;
}
template <class S>
Tensor<S> operator-(Tensor<S> a, const Tensor<S>& b) {
  for (int k = 0; k < 9; ++k) a.entries[k] = a.entries[k] - b.entries[k];
  return a;
}
template <class S, class Factor>
requires std::same_as<Factor, S> || std::is_arithmetic_v<Factor> || ConstantOf<Factor, S> Tensor<S>
operator*(const Factor& factor, Tensor<S> a) {
  for (S& entry : a.entries) entry = entry * factor;
  return a;
}
template <class S>
Tensor<S> operator*(const Tensor<S>& a, const Tensor<S>& b) {
  Tensor<S> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}
template <class S, class V>
Vector<S> operator*(const Tensor<S>& a, const Vector<V>& v) {
  Vector<S> w;
  for (int i = 0; i < 3; ++i) w[i] = a(i, 0) * v[0] + a(i, 1) * v[1] + a(i, 2) * v[2];
  return w;
}

template <class S>
Tensor<S> transpose(const Tensor<S>& a) {
  Tensor<S> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = a(j, i);
  return t;
}
template <class S>
S trace(const Tensor<S>& a) {
  return a(0, 0) + a(1, 1) + a(2, 2);
}
/// a : b = a_ij b_ij
template <class S>
S contract(const Tensor<S>& a, const Tensor<S>& b) {
  S sum = a.entries[0] * b.entries[0];
  for (int k = 1; k < 9; ++k) sum = sum + a.entries[k] * b.entries[k];
  return sum;
}
template <class S>
S dot(const Vector<S>& a, const Vector<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class S>
Vector<S> cross(const Vector<S>& a, const Vector<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class S>
Tensor<S> outer(const Vector<S>& a, const Vector<S>& b) {
  Tensor<S> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = a[i] * b[j];
  return t;
}
/// cof A = det(A) A^-T
template <class S>
Tensor<S> cofactor(const Tensor<S>& a) {
  Tensor<S> c;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  }
  return c;
}
template <class S>
S determinant(const Tensor<S>& a) {
  const Tensor<S> c = cofactor(a);
  return a(0, 0) * c(0, 0) + a(0, 1) * c(0, 1) + a(0, 2) * c(0, 2);
}
/// A - tr(A)/3 I
template <class S>
Tensor<S> deviator(Tensor<S> a) {
  const S mean = trace(a) * (1.0 / 3.0);
  for (int i = 0; i < 3; ++i) a(i, i) = a(i, i) - mean;
  return a;
}

/// Entries of another scalar type, as constants: Tensor<double> to a tensor of duals.
template <class S, class From>
Tensor<S> lift(const Tensor<From>& a) {
  Tensor<S> t;
  for (int k = 0; k < 9; ++k) t.entries[k] = S(a.entries[k]);
  return t;
}

}  // namespace tunica
