// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/wall/catalog.hpp"
#include "core/wall/collagen.hpp"

/// The laws once more, by closed forms in extended precision that share no code with core: energies as
/// printed, stresses derived by hand.
namespace tunica::test_support {

using Real = long double;
using Matrix3 = std::array<std::array<Real, 3>, 3>;

struct ReferenceFamily {
  Real angle;  ///< rad
  Real weight, stiffness, stiffening, activation_squared;
  int exponent;
  bool sharp;
  Real sharpness;
};

struct ReferenceLaw {
  wall::Matrix matrix{};
  bool incompressible = false;  ///< no volumetric term
  Real bulk_modulus = 0, stiffness = 0, stiffening = 0, shear_modulus = 0;
  Real lambda = 0, mu = 0;  ///< Lame's
  std::vector<ReferenceFamily> families;

  /// Energy of everything but fibres.
  Real matrix_energy(const Matrix3& F) const;
  /// Energy of family k as if fully recruited.
  Real fiber_energy(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const;
  /// J^(-2/3) |F a0|^2 - a^2
  Real excess(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const;
  /// H = atan(epsilon x)/pi + 1/2, or the step.
  Real share(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const;

  /// P of everything but fibres:
  ///   kappa/2 [J (J-1) + ln J] F^-T + 2 W1 J^(-2/3) (F - I1/3 F^-T),
  /// or of the benchmark laws mu (F - F^-T) + lambda ln J F^-T, F (lambda tr E I + 2 mu E),
  /// lambda tr e I + 2 mu e.
  Matrix3 matrix_piola(const Matrix3& F) const;
  /// P of family k as if fully recruited: 2 W4 J^(-2/3) (F a0 x a0 - I4/3 F^-T).
  Matrix3 fiber_piola(std::size_t k, const Matrix3& F, const wall::MaterialAxes& axes) const;
  /// The law's stress: that of the matrix, and of each family times its share.
  Matrix3 piola(const Matrix3& F, const wall::MaterialAxes& axes) const;
};

/// The tissue below `prefix` as the scene's own numbers give it.
ReferenceLaw reference_law(const Scene& scene, const std::string& prefix = "wall.");

/// F = I + H, without rounding.
Matrix3 deformation_gradient(const Tensor<double>& displacement_gradient);
Tensor<double> rounded(const Matrix3& a);
Matrix3 inverse_transpose(const Matrix3& a, Real& determinant);

/// dW/dF by central differences of an energy W(F); the step balances truncation (step^2) and rounding
/// (1e-19/step), which leaves about 1e-10 relative.
template <class Energy>
Matrix3 by_differences(const Energy& energy, Matrix3 F) {
  constexpr Real step = 1e-6L;
  Matrix3 slope;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Real here = F[i][j];
      F[i][j] = here + step;
      const Real above = energy(F);
      F[i][j] = here - step;
      slope[i][j] = (above - energy(F)) / (2 * step);
      F[i][j] = here;
    }
  return slope;
}

}  // namespace tunica::test_support
