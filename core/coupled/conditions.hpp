// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/coupled/vessel.hpp"
#include "core/physics/blood.hpp"
#include "core/physics/tether.hpp"
#include "core/physics/wall_momentum.hpp"
#include "core/wall/law.hpp"

namespace tunica::coupled {

/// Bases of velocity, displacement and pressure.
///   quadratic  velocity and displacement quadratic, blood pressure continuous and linear (Taylor-Hood), wall
///              pressure linear in each cell: orders 3, 3 and 2;
///   linear     all linear, the pressure stabilised; wall pressure constant in each cell;
///   bubble     the paper's: velocity linear with a bubble, all else linear; triangles and tetrahedra only.
enum class Element { quadratic, linear, bubble };

/// How the mesh in the blood follows the wall.
enum class MeshMotion {
  harmonic,   ///< as a harmonic field (the paper's)
  stiffened,  ///< so, with small cells stiffer by the inverse square of their size
  sectional   ///< section by section, as known shares of the wall's displacement (LayoutSpec::shares)
};

struct Discretisation {
  Element element = Element::quadratic;
  /// Interpolate the wall pressure on its own, so that nearly incompressible tissue does not lock. Laws far
  /// from incompressible, and the bubble element, use the law's own stress.
  bool mixed_wall = true;
  MeshMotion motion = MeshMotion::harmonic;
  /// The mesh in the blood is where the steps before lead to expect it (Stage::mesh), and none of the
  /// unknowns: it follows the wall after the step.
  bool lagged_mesh = false;
};

/// True for tissue whose pressure cells interpolate on their own (those of the bubble element never do).
inline bool mixes(const Discretisation& discretisation, const wall::Law<double>& law) {
  return discretisation.mixed_wall && discretisation.element != Element::bubble &&
         physics::pointwise_volumetric_share(law) < 1;
}

enum class InletKind {
  prescribed,  ///< by the velocity on the boundary
  flow,        ///< flow through it, by an unknown uniform pressure
  pressure     ///< uniform pressure
};
struct InletCondition {
  InletKind kind = InletKind::prescribed;
  std::function<double(double time)> value;  ///< flow into the vessel, cm3/s, or pressure, dyn/cm2
  double backflow = 0;  ///< beta of physics::backflow_load: not for prescribed velocities
};

enum class OutletKind {
  prescribed,  ///< by the velocity on the boundary
  resistance,  ///< p = p_v + R Q (paper eq. 18 with the sign corrected)
  windkessel   ///< p = p_c + R_prox Q, C dp_c/dt = Q - (p_c - p_v)/R
};
struct OutletCondition {
  OutletKind kind = OutletKind::resistance;
  double resistance = 0;                                                     ///< R, dyn s/cm5
  double proximal_resistance = 0;                                            ///< R_prox
  double compliance = 0;                                                     ///< C, cm5/dyn
  std::function<double(double time)> pressure = [](double) { return 0.0; };  ///< p_v, dyn/cm2
  double backflow = 0;  ///< beta of physics::backflow_load
};

/// Which components of a vector (in the order of the frame's) are prescribed on a boundary. The velocity on
/// the wall is that of the wall.
template <int components>
struct Prescribed {
  std::array<bool, components> displacement{};
  std::array<bool, components> velocity{};
};

/// Loads besides those of a vessel, per unit reference volume or area: manufactured solutions and exact ones.
/// Empty ones are none.
template <int dimension>
struct Loads {
  using Point = std::array<double, dimension>;
  std::function<Vector<double>(const Point&, double time)> blood_force, wall_force, mesh_force;
  std::function<double(const Point&, double time)> blood_volume;  ///< J div v is this instead of 0
  std::function<Vector<double>(const Point&, double time, Boundary)> traction;
};

/// All that is computed with but the mesh: the physics and what happens on the boundaries. Points are
/// those of the mesh in the unloaded vessel, cm.
template <int dimension>
struct Conditions {
  using Point = std::array<double, dimension>;
  Discretisation discretisation;
  /// How often what is meshed is in the whole vessel, whose flows are those of the inlet and the outlet: 2 or
  /// 4 for a half or a quarter of it.
  double copies = 1;
  physics::Blood blood{1.0, 0.035};
  std::vector<wall::Law<double>> laws;  ///< by layer
  double wall_density = 0;
  physics::Tether tether{0};
  InletCondition inlet;
  OutletCondition outlet;
  /// Pressure on the inner surface of a wall without blood, dyn/cm2.
  std::function<double(double time)> lumen_pressure = [](double) { return 0.0; };
  std::array<Prescribed<dimension>, boundaries> prescribed = symmetries();
  /// Values where they are prescribed; empty for zero.
  std::function<Vector<double>(const Point&, double time)> displacement, velocity;
  Loads<dimension> loads;

  Prescribed<dimension>& on(Boundary boundary) { return prescribed[static_cast<std::size_t>(boundary)]; }
  const Prescribed<dimension>& on(Boundary boundary) const {
    return prescribed[static_cast<std::size_t>(boundary)];
  }

  /// Nothing moves across an axis or a plane of symmetry.
  static constexpr std::array<Prescribed<dimension>, boundaries> symmetries() {
    std::array<Prescribed<dimension>, boundaries> all{};
    const auto hold = [&](Boundary boundary, int component) {
      auto& fixed = all[static_cast<std::size_t>(boundary)];
      fixed.displacement[component] = fixed.velocity[component] = true;
    };
    hold(Boundary::axis, 0);
    hold(Boundary::symmetry_x, 0);
    hold(Boundary::symmetry_y, 1);
    return all;
  }
};

}  // namespace tunica::coupled
