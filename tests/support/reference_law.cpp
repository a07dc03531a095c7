// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/reference_law.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tunica::test_support {

namespace {

constexpr Real pi = std::numbers::pi_v<Real>;
using Vector3 = std::array<Real, 3>;

Real determinant_of(const Matrix3& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

/// tr F^T F
Real first_invariant(const Matrix3& F) {
  Real sum = 0;
  for (const auto& row : F)
    for (const Real entry : row) sum += entry * entry;
  return sum;
}

Vector3 fiber(const ReferenceFamily& family, const wall::MaterialAxes& axes) {
  Vector3 a0;
  for (int i = 0; i < 3; ++i)
    a0[i] = std::cos(family.angle) * axes.circumferential[i] + std::sin(family.angle) * axes.axial[i];
  return a0;
}

Vector3 mapped(const Matrix3& F, const Vector3& a0) {
  Vector3 a;
  for (int i = 0; i < 3; ++i) a[i] = F[i][0] * a0[0] + F[i][1] * a0[1] + F[i][2] * a0[2];
  return a;
}

Real squared(const Vector3& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// (F^T F - I)/2
Matrix3 green_lagrange(const Matrix3& F) {
  Matrix3 e;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Real sum = i == j ? -1 : 0;
      for (int k = 0; k < 3; ++k) sum += F[k][i] * F[k][j];
      e[i][j] = sum / 2;
    }
  return e;
}

/// (F + F^T)/2 - I
Matrix3 small_strain(const Matrix3& F) {
  Matrix3 e;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) e[i][j] = (F[i][j] + F[j][i]) / 2 - (i == j ? 1 : 0);
  return e;
}

}  // namespace

Matrix3 inverse_transpose(const Matrix3& a, Real& determinant) {
  determinant = determinant_of(a);
  Matrix3 t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      // The minor that leaves row i and column j out, with its sign.
      const int r0 = i == 0 ? 1 : 0, r1 = i == 2 ? 1 : 2, c0 = j == 0 ? 1 : 0, c1 = j == 2 ? 1 : 2;
      const Real minor = a[r0][c0] * a[r1][c1] - a[r0][c1] * a[r1][c0];
      t[i][j] = ((i + j) % 2 == 0 ? minor : -minor) / determinant;
    }
  return t;
}

Real ReferenceLaw::matrix_energy(const Matrix3& F) const {
  const Real J = determinant_of(F), I1 = first_invariant(F), x = std::pow(J, -2 / Real(3)) * I1 - 3;
  const Real log_j = std::log(J);
  const Real U = incompressible ? 0 : bulk_modulus / 4 * ((J - 1) * (J - 1) + log_j * log_j);
  const auto quadratic = [&](const Matrix3& e) {
    const Real tr = e[0][0] + e[1][1] + e[2][2];
    return lambda / 2 * tr * tr + mu * first_invariant(e);
  };
  switch (matrix) {
    case wall::Matrix::exp1:
      return U + stiffness / (2 * stiffening) * (std::exp(stiffening * x) - 1);
    case wall::Matrix::exp2:
      return U + stiffness / (2 * stiffening) * (std::exp(stiffening * x * x) - 1);
    case wall::Matrix::neo_hookean:
      return U + shear_modulus / 2 * x;
    case wall::Matrix::neo_hookean_compressible:
      return mu / 2 * (I1 - 3 - 2 * log_j) + lambda / 2 * log_j * log_j;
    case wall::Matrix::st_venant_kirchhoff:
      return quadratic(green_lagrange(F));
    case wall::Matrix::linear_elastic:
      return quadratic(small_strain(F));
  }
  throw std::logic_error("a law without a reference: derive its energy by hand here");
}

Matrix3 ReferenceLaw::matrix_piola(const Matrix3& F) const {
  Real J = 0;
  const Matrix3 T = inverse_transpose(F, J);
  const Real factor = std::pow(J, -2 / Real(3)), I1 = first_invariant(F), x = factor * I1 - 3;
  const Real log_j = std::log(J);
  const Real pressure = incompressible ? 0 : bulk_modulus / 2 * (J * (J - 1) + log_j);
  Matrix3 P{};
  const auto split = [&](Real slope) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        P[i][j] = pressure * T[i][j] + 2 * slope * factor * (F[i][j] - I1 / 3 * T[i][j]);
  };
  const auto hooke = [&](const Matrix3& e) {
    Matrix3 s;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        s[i][j] = 2 * mu * e[i][j] + (i == j ? lambda * (e[0][0] + e[1][1] + e[2][2]) : 0);
    return s;
  };
  switch (matrix) {
    case wall::Matrix::exp1:
      split(stiffness / 2 * std::exp(stiffening * x));
      return P;
    case wall::Matrix::exp2:
      split(stiffness * x * std::exp(stiffening * x * x));
      return P;
    case wall::Matrix::neo_hookean:
      split(shear_modulus / 2);
      return P;
    case wall::Matrix::neo_hookean_compressible:
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) P[i][j] = mu * (F[i][j] - T[i][j]) + lambda * log_j * T[i][j];
      return P;
    case wall::Matrix::st_venant_kirchhoff: {
      const Matrix3 S = hooke(green_lagrange(F));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) P[i][j] += F[i][k] * S[k][j];
      return P;
    }
    case wall::Matrix::linear_elastic:
      return hooke(small_strain(F));
  }
  throw std::logic_error("a law without a reference: derive its stress by hand here");
}

Real ReferenceLaw::excess(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const {
  return std::pow(determinant_of(F), -2 / Real(3)) * squared(mapped(F, fiber(families[k], axes))) -
         families[k].activation_squared;
}

Real ReferenceLaw::share(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const {
  const Real x = excess(k, F, axes);
  if (families[k].sharp) return x > 0 ? 1 : x < 0 ? 0 : Real(0.5);
  return std::atan(families[k].sharpness * x) / pi + Real(0.5);
}

Real ReferenceLaw::fiber_energy(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const {
  const ReferenceFamily& f = families[k];
  const Real x = excess(k, F, axes);
  if (f.exponent == 2 && x < 0) return f.weight * f.stiffness / 2 * x * x;
  return f.weight * f.stiffness / (2 * f.stiffening) *
         (std::exp(f.stiffening * (f.exponent == 2 ? x * x : x)) - 1);
}

Matrix3 ReferenceLaw::fiber_piola(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const {
  const ReferenceFamily& f = families[k];
  const Vector3 a0 = fiber(f, axes), a = mapped(F, a0);
  const Real x = excess(k, F, axes);
  const Real exponential =
      f.exponent == 2 ? (x < 0 ? 1 : std::exp(f.stiffening * x * x)) : std::exp(f.stiffening * x);
  const Real slope = f.weight * f.stiffness * (f.exponent == 2 ? x : Real(0.5)) * exponential;
  Real J = 0;
  const Matrix3 T = inverse_transpose(F, J);
  Matrix3 P;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      P[i][j] = 2 * slope * std::pow(J, -2 / Real(3)) * (a[i] * a0[j] - squared(a) / 3 * T[i][j]);
  return P;
}

Matrix3 ReferenceLaw::piola(const Matrix3& F, const wall::MaterialAxes& axes) const {
  Matrix3 P = matrix_piola(F);
  for (std::size_t k = 0; k < families.size(); ++k) {
    const Matrix3 fibers = fiber_piola(k, F, axes);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P[i][j] += share(k, F, axes) * fibers[i][j];
  }
  return P;
}

ReferenceLaw reference_law(const Scene& scene, const std::string& prefix) {
  const auto number = [&](const std::string& key) -> Real {
    return scene.has(prefix + key) ? scene.number(prefix + key) : 0;
  };
  const wall::LawEntry& entry = *wall::find_law(scene.text(prefix + "law"));
  ReferenceLaw law;
  law.matrix = entry.matrix;
  law.incompressible = scene.flag("wall.incompressible");
  law.bulk_modulus = number("bulk_modulus");
  law.stiffness = number("stiffness");
  law.stiffening = number("stiffening");
  law.shear_modulus = number("shear_modulus");
  if (entry.matrix == wall::Matrix::neo_hookean_compressible) {
    law.mu = law.shear_modulus;
    law.lambda = law.bulk_modulus - 2 * law.mu / 3;
  } else if (const Real E = number("young_modulus"); E > 0) {
    const Real nu = number("poisson_ratio");
    law.mu = E / (2 * (1 + nu));
    law.lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  }
  if (!entry.has_fibers) return law;
  const auto add = [&](const std::string& below, const std::string& fiber, Real degrees, Real weight) {
    const Real angle = degrees * pi / 180, c = std::cos(angle), s = std::sin(angle);
    const Real stretch = number(below + "activation_stretch");
    const Real threshold = !entry.has_activation ? 1
                           : scene.has(prefix + below + "activation_squared")
                               ? number(below + "activation_squared")
                               : stretch * stretch * c * c + s * s;
    law.families.push_back({angle, weight, number(below + fiber + "stiffness"),
                            number(below + fiber + "stiffening"), threshold,
                            static_cast<int>(scene.integer(prefix + "exponent")),
                            scene.text(prefix + "recruitment") == "sharp", number("sharpness")});
  };
  for (std::size_t k = 0; k < scene.count(prefix + "families"); ++k) {
    const std::string below = "families[" + std::to_string(k) + "].";
    add(below, "", number(below + "angle"), number(below + "weight"));
  }
  if (law.families.empty()) {
    add("", "fiber_", number("fiber_angle"), 1);
    add("", "fiber_", -number("fiber_angle"), 1);
  }
  return law;
}

Matrix3 deformation_gradient(const Tensor<double>& displacement_gradient) {
  Matrix3 F;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[i][j] = Real(displacement_gradient(i, j)) + (i == j ? 1 : 0);
  return F;
}

Tensor<double> rounded(const Matrix3& a) {
  Tensor<double> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = static_cast<double>(a[i][j]);
  return t;
}

}  // namespace tunica::test_support
