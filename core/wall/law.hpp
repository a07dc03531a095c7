// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <variant>
#include <vector>

#include "core/wall/collagen.hpp"
#include "core/wall/exp1.hpp"
#include "core/wall/exp2.hpp"
#include "core/wall/linear_laws.hpp"
#include "core/wall/neo_hookean.hpp"
#include "core/wall/volumetric.hpp"

namespace tunica::wall {

/// U(J) + matrix(I1bar) + collagen families(I4bar): the paper's four laws and the isochoric-split
/// neo-Hookean solid. P is the scalar of the parameters (a dual gives parameter derivatives), S that
/// of the deformation.
template <class P, template <class> class Matrix>
struct SplitLaw {
  Volumetric<P> volumetric;
  Matrix<P> matrix;
  std::vector<CollagenFamily<P>> families;

  /// U(J) + W(I1bar) + sum of the families' energies as if fully recruited.
  template <class S>
  S energy(const Tensor<S>& displacement_gradient, const MaterialAxes& axes) const {
    const Kinematics<S> k(displacement_gradient);
    S sum = volumetric.energy(k) + matrix.energy(k.isochoric_first_invariant_change());
    for (const auto& family : families) sum = sum + family.energy(family.excess(k, axes));
    return sum;
  }

  /// Isochoric Kirchhoff stress dev[2 W' J^(-2/3) b + sum H 2 W_f' J^(-2/3) a x a].
  template <class S>
  Tensor<S> isochoric_kirchhoff(const Kinematics<S>& k, const MaterialAxes& axes) const {
    const S slope = matrix.energy(seed(k.isochoric_first_invariant_change())).derivative[0];
    Tensor<S> stress = (2.0 * slope * k.isochoric_factor) * k.left_cauchy_green_change;
    for (const auto& family : families) stress = stress + family.kirchhoff_before_deviator(k, axes);
    return deviator(stress);
  }

  template <class S>
  Tensor<S> piola(const Tensor<S>& displacement_gradient, const MaterialAxes& axes) const {
    const Kinematics<S> k(displacement_gradient);
    Tensor<S> kirchhoff = isochoric_kirchhoff(k, axes);
    const S pressure = volumetric.kirchhoff(k);
    for (int i = 0; i < 3; ++i) kirchhoff(i, i) = kirchhoff(i, i) + pressure;
    return k.piola_from_kirchhoff(kirchhoff);
  }

  const P& shear_stiffness() const { return matrix.shear_stiffness(); }
  const P& volumetric_stiffness() const { return volumetric.bulk_modulus; }

  template <class S>
  S volume_strain(const Tensor<S>& displacement_gradient) const {
    return volume_change(displacement_gradient);
  }
  template <class S>
  Tensor<S> volume_strain_slope(const Tensor<S>& displacement_gradient) const {
    return Kinematics<S>(displacement_gradient).deformation_cofactor;
  }
  template <class S>
  S volumetric_stress(const S& volume_strain) const {
    return volumetric.slope(volume_strain);
  }
  template <class S>
  Tensor<S> piola_with(const Tensor<S>& displacement_gradient, const MaterialAxes& axes,
                       const S& given) const {
    const Kinematics<S> k(displacement_gradient);
    return k.piola_from_kirchhoff(isochoric_kirchhoff(k, axes)) + given * k.deformation_cofactor;
  }
};

/// A law that is nothing but an energy of the displacement gradient, P = dW/dH by duals, given as
/// shape_energy(H) + volumetric_energy(volume_strain(H)).
template <class Energy>
struct EnergyLaw {
  Energy density;

  template <class S>
  S energy(const Tensor<S>& displacement_gradient, const MaterialAxes&) const {
    return density.shape_energy(displacement_gradient) +
           density.volumetric_energy(density.volume_strain(displacement_gradient));
  }

  template <class S>
  Tensor<S> piola(const Tensor<S>& displacement_gradient, const MaterialAxes& axes) const {
    return piola_with(displacement_gradient, axes, volumetric_stress(volume_strain(displacement_gradient)));
  }

  auto shear_stiffness() const { return density.shear_stiffness(); }
  auto volumetric_stiffness() const { return density.volumetric_stiffness(); }

  template <class S>
  S volume_strain(const Tensor<S>& displacement_gradient) const {
    return density.volume_strain(displacement_gradient);
  }
  template <class S>
  Tensor<S> volume_strain_slope(const Tensor<S>& displacement_gradient) const {
    return density.volume_strain_slope(displacement_gradient);
  }
  template <class S>
  S volumetric_stress(const S& volume_strain) const {
    return density.volumetric_energy(seed(volume_strain)).derivative[0];
  }
  template <class S>
  Tensor<S> piola_with(const Tensor<S>& displacement_gradient, const MaterialAxes&, const S& given) const {
    Tensor<Dual<S, 9>> seeded;
    for (int k = 0; k < 9; ++k) seeded.entries[k] = Dual<S, 9>::variable(displacement_gradient.entries[k], k);
    Tensor<S> stress;
    stress.entries = density.shape_energy(seeded).derivative;
    return stress + given * density.volume_strain_slope(displacement_gradient);
  }
};

template <class P>
using Law = std::variant<SplitLaw<P, Exp1>, SplitLaw<P, Exp2>, SplitLaw<P, NeoHookean>,
                         EnergyLaw<NeoHookeanCompressible<P>>, EnergyLaw<StVenantKirchhoff<P>>,
                         EnergyLaw<LinearElastic<P>>>;

template <class L>
concept HasFamilies = requires(const L& law) {
  law.families;
};

/// The families of a law; none for a law without fibres.
template <class P>
const std::vector<CollagenFamily<P>>& families(const Law<P>& law) {
  static const std::vector<CollagenFamily<P>> no_families;
  return std::visit(
      [](const auto& l) -> const std::vector<CollagenFamily<P>>& {
        if constexpr (HasFamilies<std::decay_t<decltype(l)>>) return l.families;
        return no_families;
      },
      law);
}

/// Not of a temporary: its families would be gone with it.
template <class P>
const std::vector<CollagenFamily<P>>& families(const Law<P>&& law) = delete;

/// First Piola-Kirchhoff stress P(H), dyn/cm2, for the displacement gradient H = F - I.
template <class P, class S>
Tensor<S> piola(const Law<P>& law, const Tensor<S>& displacement_gradient, const MaterialAxes& axes) {
  return std::visit([&](const auto& l) { return l.piola(displacement_gradient, axes); }, law);
}

/// Kirchhoff stress without its hydrostatic part, for tissue taken as exactly incompressible.
/// Throws std::logic_error for a law that does not split the volume change off.
template <class P, class S>
Tensor<S> isochoric_kirchhoff(const Law<P>& law, const Tensor<S>& displacement_gradient,
                              const MaterialAxes& axes) {
  return std::visit(
      [&](const auto& l) -> Tensor<S> {
        if constexpr (HasFamilies<std::decay_t<decltype(l)>>)
          return l.isochoric_kirchhoff(Kinematics<S>(displacement_gradient), axes);
        throw std::logic_error("isochoric_kirchhoff: the law has no volumetric split");
      },
      law);
}

/// Every law is W = W_shape(H) + V(theta(H)), where the volume strain theta is what its stiffness against
/// changes of volume, lambda or kappa, multiplies: J - 1, or the trace of the strain that the law is
/// quadratic in. So the stress V'(theta) can be interpolated on its own:
///   P = dW_shape/dH + V'(theta) dtheta/dH.
template <class P, class S>
S volume_strain(const Law<P>& law, const Tensor<S>& displacement_gradient) {
  return std::visit([&](const auto& l) { return l.volume_strain(displacement_gradient); }, law);
}

/// dtheta/dH
template <class P, class S>
Tensor<S> volume_strain_slope(const Law<P>& law, const Tensor<S>& displacement_gradient) {
  return std::visit([&](const auto& l) { return l.volume_strain_slope(displacement_gradient); }, law);
}

/// V'(theta), dyn/cm2
template <class P, class S>
S volumetric_stress(const Law<P>& law, const S& volume_strain) {
  return std::visit([&](const auto& l) { return l.volumetric_stress(volume_strain); }, law);
}

/// First Piola-Kirchhoff stress with another value in the place of V'(theta), dyn/cm2.
template <class P, class S>
Tensor<S> piola_with(const Law<P>& law, const Tensor<S>& displacement_gradient, const MaterialAxes& axes,
                     const S& given) {
  return std::visit([&](const auto& l) { return l.piola_with(displacement_gradient, axes, given); }, law);
}

/// V''(0) over the stiffness against changes of shape: 118 to 515 for the paper's laws, without bound as
/// Poisson's ratio tends to 1/2.
template <class P>
double volumetric_ratio(const Law<P>& law) {
  return std::visit(
      [](const auto& l) { return plain(l.volumetric_stiffness()) / plain(l.shear_stiffness()); }, law);
}

/// Stress and tangent dP_k/dH_l, entries row-major in both.
struct StressAndTangent {
  Tensor<double> stress;
  std::array<std::array<double, 9>, 9> tangent;
};

/// Both by one evaluation with duals.
inline StressAndTangent stress_and_tangent(const Law<double>& law,
                                           const Tensor<double>& displacement_gradient,
                                           const MaterialAxes& axes) {
  Tensor<Dual<double, 9>> seeded;
  for (int k = 0; k < 9; ++k)
    seeded.entries[k] = Dual<double, 9>::variable(displacement_gradient.entries[k], k);
  const auto dual_stress = piola(law, seeded, axes);
  StressAndTangent result;
  for (int k = 0; k < 9; ++k) {
    result.stress.entries[k] = dual_stress.entries[k].value;
    result.tangent[k] = dual_stress.entries[k].derivative;
  }
  return result;
}

/// A layer of the wall: from the lumen outwards, its share of the thickness and its law.
template <class P>
struct Layer {
  P share;
  Law<P> law;
};

template <class P>
using Wall = std::vector<Layer<P>>;

}  // namespace tunica::wall
