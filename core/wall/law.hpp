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
};

/// A law that is nothing but an energy of the displacement gradient: P = dW/dH by duals.
template <class Energy>
struct EnergyLaw {
  Energy density;

  template <class S>
  S energy(const Tensor<S>& displacement_gradient, const MaterialAxes&) const {
    return density.energy(displacement_gradient);
  }

  template <class S>
  Tensor<S> piola(const Tensor<S>& displacement_gradient, const MaterialAxes&) const {
    Tensor<Dual<S, 9>> seeded;
    for (int k = 0; k < 9; ++k) seeded.entries[k] = Dual<S, 9>::variable(displacement_gradient.entries[k], k);
    Tensor<S> stress;
    stress.entries = density.energy(seeded).derivative;
    return stress;
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

/// True for a law U(J) + W(isochoric deformation), whose hydrostatic part can be interpolated on its own.
template <class P>
bool splits_volume(const Law<P>& law) {
  return std::visit([](const auto& l) { return HasFamilies<std::decay_t<decltype(l)>>; }, law);
}

/// First Piola-Kirchhoff stress without its hydrostatic part. Throws std::logic_error as isochoric_kirchhoff.
template <class P, class S>
Tensor<S> isochoric_piola(const Law<P>& law, const Kinematics<S>& k, const MaterialAxes& axes) {
  return std::visit(
      [&](const auto& l) -> Tensor<S> {
        if constexpr (HasFamilies<std::decay_t<decltype(l)>>)
          return k.piola_from_kirchhoff(l.isochoric_kirchhoff(k, axes));
        throw std::logic_error("isochoric_piola: the law has no volumetric split");
      },
      law);
}

/// The volumetric term U(J) of a law that splits it off. Throws std::logic_error as isochoric_kirchhoff.
template <class P>
const Volumetric<P>& volumetric(const Law<P>& law) {
  return std::visit(
      [](const auto& l) -> const Volumetric<P>& {
        if constexpr (HasFamilies<std::decay_t<decltype(l)>>) return l.volumetric;
        throw std::logic_error("volumetric: the law has no volumetric split");
      },
      law);
}
template <class P>
const Volumetric<P>& volumetric(const Law<P>&& law) = delete;

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
