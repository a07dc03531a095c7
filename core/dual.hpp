// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <numbers>
#include <type_traits>

namespace tunica {

/// Forward-mode dual number: a value and its N directional derivatives,
///   f(x + sum_k e_k d_k) = f(x) + sum_k e_k f'(x) d_k,  e_k e_l = 0.
/// The scalar T may itself be a dual, which gives second derivatives.
template <class T, int N>
struct Dual {
  T value{};
  std::array<T, N> derivative{};

  constexpr Dual() = default;
  constexpr Dual(const T& v) : value(v) {}  // NOLINT(google-explicit-constructor): constants mix freely
  constexpr Dual(double v)                  // NOLINT(google-explicit-constructor)
      requires(!std::same_as<T, double>)
      : value(v) {}
  constexpr Dual(const T& v, const std::array<T, N>& d) : value(v), derivative(d) {}

  /// The independent variable number `direction`: derivative 1 along it.
  static constexpr Dual variable(const T& v, int direction = 0) {
    Dual x(v);
    x.derivative[direction] = T(1.0);
    return x;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
};

template <class S>
struct DualTraits {
  static constexpr bool is_dual = false;
};
template <class T, int N>
struct DualTraits<Dual<T, N>> {
  static constexpr bool is_dual = true;
  using Scalar = T;
};

/// True when S is a constant to the dual D: an arithmetic number or a scalar that D is built from.
template <class S, class D>
constexpr bool is_constant_of() {
  if constexpr (std::is_arithmetic_v<S>) {
    return true;
  } else if constexpr (DualTraits<D>::is_dual) {
    using T = typename DualTraits<D>::Scalar;
    return std::same_as<S, T> || is_constant_of<S, T>();
  } else {
    return false;
  }
}
template <class S, class D>
concept ConstantOf = DualTraits<D>::is_dual && !std::same_as<S, D> && is_constant_of<S, D>();

/// The double inside any nesting of duals.
inline double plain(double x) {
  return x;
}
template <class T, int N>
double plain(const Dual<T, N>& x) {
  return plain(x.value);
}

namespace detail {
/// f and f' at x.value, spread over the directions of x.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& x, const T& f, const T& slope) {
  Dual<T, N> y(f);
  for (int k = 0; k < N; ++k) y.derivative[k] = slope * x.derivative[k];
  return y;
}
}  // namespace detail

template <class T, int N>
Dual<T, N> operator-(const Dual<T, N>& a) {
  Dual<T, N> c(-a.value);
  for (int k = 0; k < N; ++k) c.derivative[k] = -a.derivative[k];
  return c;
}
template <class T, int N>
Dual<T, N> operator+(const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> c(a.value + b.value);
  for (int k = 0; k < N; ++k) c.derivative[k] = a.derivative[k] + b.derivative[k];
  return c;
}
template <class T, int N>
Dual<T, N> operator-(const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> c(a.value - b.value);
  for (int k = 0; k < N; ++k) c.derivative[k] = a.derivative[k] - b.derivative[k];
  return c;
}
template <class T, int N>
Dual<T, N> operator*(const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> c(a.value * b.value);
  for (int k = 0; k < N; ++k) c.derivative[k] = a.derivative[k] * b.value + a.value * b.derivative[k];
  return c;
}
template <class T, int N>
Dual<T, N> operator/(const Dual<T, N>& a, const Dual<T, N>& b) {
  const T inverse = 1.0 / b.value;
  Dual<T, N> c(a.value * inverse);
  for (int k = 0; k < N; ++k) c.derivative[k] = (a.derivative[k] - c.value * b.derivative[k]) * inverse;
  return c;
}

template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator+(Dual<T, N> a, const S& b) {
  a.value = a.value + b;
  return a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator+(const S& a, const Dual<T, N>& b) {
  return b + a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator-(Dual<T, N> a, const S& b) {
  a.value = a.value - b;
  return a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator-(const S& a, const Dual<T, N>& b) {
  return -b + a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator*(Dual<T, N> a, const S& b) {
  a.value = a.value * b;
  for (int k = 0; k < N; ++k) a.derivative[k] = a.derivative[k] * b;
  return a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator*(const S& a, const Dual<T, N>& b) {
  return b * a;
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator/(const Dual<T, N>& a, const S& b) {
  return a * (1.0 / b);
}
template <class T, int N, ConstantOf<Dual<T, N>> S>
Dual<T, N> operator/(const S& a, const Dual<T, N>& b) {
  const T quotient = a / b.value;
  return detail::chain(b, quotient, T(-quotient / b.value));
}

template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& x) {
  using std::exp;
  const T e = exp(x.value);
  return detail::chain(x, e, e);
}
template <class T, int N>
Dual<T, N> expm1(const Dual<T, N>& x) {
  using std::expm1;
  const T e = expm1(x.value);
  return detail::chain(x, e, T(e + 1.0));
}
template <class T, int N>
Dual<T, N> log(const Dual<T, N>& x) {
  using std::log;
  return detail::chain(x, T(log(x.value)), T(1.0 / x.value));
}
template <class T, int N>
Dual<T, N> log1p(const Dual<T, N>& x) {
  using std::log1p;
  return detail::chain(x, T(log1p(x.value)), T(1.0 / (1.0 + x.value)));
}
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
  using std::sqrt;
  const T root = sqrt(x.value);
  return detail::chain(x, root, T(0.5 / root));
}
template <class T, int N>
Dual<T, N> sin(const Dual<T, N>& x) {
  using std::cos;
  using std::sin;
  return detail::chain(x, T(sin(x.value)), T(cos(x.value)));
}
template <class T, int N>
Dual<T, N> cos(const Dual<T, N>& x) {
  using std::cos;
  using std::sin;
  return detail::chain(x, T(cos(x.value)), T(-sin(x.value)));
}
template <class T, int N>
Dual<T, N> atan(const Dual<T, N>& x) {
  using std::atan;
  return detail::chain(x, T(atan(x.value)), T(1.0 / (1.0 + x.value * x.value)));
}

template <class T, int N>
Dual<T, N> abs(const Dual<T, N>& x) {
  return plain(x) < 0 ? -x : x;
}
/// Angle of the point (x, y); regular where x = 0, unlike atan(y / x).
template <class T, int N>
Dual<T, N> atan2(const Dual<T, N>& y, const Dual<T, N>& x) {
  using std::atan2;
  const T radius_squared = x.value * x.value + y.value * y.value;
  Dual<T, N> angle(T(atan2(y.value, x.value)));
  for (int k = 0; k < N; ++k)
    angle.derivative[k] = (x.value * y.derivative[k] - y.value * x.derivative[k]) / radius_squared;
  return angle;
}

/// The dual of one variable that carries d/dx of an expression of x.
template <class S>
Dual<S, 1> seed(const S& x) {
  return Dual<S, 1>::variable(x);
}

}  // namespace tunica
