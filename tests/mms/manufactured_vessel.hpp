// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <type_traits>

#include "core/coupled/conditions.hpp"
#include "tests/support/manufactured.hpp"

/// Motions of a vessel with its blood that solve the coupled equations under loads that follow from them, by
/// the strong forms, which are written out here. Lengths, stiffnesses and densities are of order one.
namespace tunica::mms {

namespace manufactured = test_support::manufactured;
using coupled::Boundary, coupled::Conditions, coupled::InletKind, coupled::OutletCondition,
    coupled::OutletKind;
using std::cos;
using std::sin;
using std::sqrt;

/// A motion with what follows from it: loads, flows, scalars.
template <class Motion>
class Vessel : public Motion {
 public:
  using Problem = Conditions<Motion::dimension>;
  bool steady = false;  ///< all fields as they are at time 0, with rates of zero

  template <class S>
  Vector<S> displacement(const Vector<S>& x, const S& t) const {
    return Motion::displacement(x, clock(t));
  }
  template <class S>
  Vector<S> mesh_velocity(const Vector<S>& x, const S& t) const {
    return manufactured::rate(displacement_field(), x, t);
  }
  /// Of blood. That of the wall is mesh_velocity().
  template <class S>
  Vector<S> velocity(const Vector<S>& x, const S& t) const {
    const Vector<S> w = mesh_velocity(x, t), u = Motion::stream(x, clock(t));
    return {w[0] + u[0], w[1] + u[1], w[2] + u[2]};
  }
  template <class S>
  S pressure(const Vector<S>& x, const S& t) const {
    return Motion::pressure(x, clock(t));
  }
  /// Uniform pressures on inlet and outlet; what they lack to balance the blood's stress is a load.
  template <class S>
  S inlet_pressure(const S& t) const {
    return 2 + sin(2.0 * clock(t));
  }
  template <class S>
  S outlet_pressure(const S& t) const {
    return 1.5 + 0.7 * cos(3.0 * clock(t));
  }

  auto displacement_field() const {
    return [this](const auto& x, const auto& t) { return displacement(x, t); };
  }
  auto mesh_velocity_field() const {
    return [this](const auto& x, const auto& t) { return mesh_velocity(x, t); };
  }
  auto velocity_field() const {
    return [this](const auto& x, const auto& t) { return velocity(x, t); };
  }
  auto pressure_field() const {
    return [this](const auto& x, const auto& t) { return pressure(x, t); };
  }

  template <class S>
  Tensor<S> deformation(const Vector<S>& x, const S& t) const {
    return Tensor<S>::identity() + manufactured::gradient<typename Motion::Axes>(displacement_field(), x, t);
  }

  /// Of the flow along +z, per unloaded area.
  template <class S>
  S flow_density(const Vector<S>& x, const S& t) const {
    const Vector<S> area = cofactor(deformation(x, t)) * Vector<double>{0, 0, 1};
    return dot(Motion::stream(x, clock(t)), area);
  }
  /// Flow along +z through the current surface that was at height z.
  template <class S>
  S flow(double z, const S& t) const {
    S sum(0.0);
    Motion::for_each_in_section(z, [&](const Vector<double>& x, double area) {
      sum = sum + area * flow_density(Vector<S>{S(x[0]), S(x[1]), S(x[2])}, t);
    });
    return sum;
  }
  /// Of a Windkessel, such that the pressure before its proximal resistance is outlet_pressure().
  template <class S>
  S stored_pressure(const OutletCondition& outlet, const S& t) const {
    return outlet_pressure(t) - outlet.proximal_resistance * flow(Motion::length, t);
  }
  /// p_v for which resistance or Windkessel have these pressures.
  double pressure_beyond(const OutletCondition& outlet, double t) const {
    const double q = flow(Motion::length, t);
    if (outlet.kind == OutletKind::resistance) return outlet_pressure(t) - outlet.resistance * q;
    const Dual<double, 1> stored = stored_pressure(outlet, seed(t));
    return stored.value - outlet.resistance * (q - outlet.compliance * stored.derivative[0]);
  }

  /// First Piola-Kirchhoff stress of blood, J sigma F^-T.
  template <class S>
  Tensor<S> blood_stress(const physics::Blood& blood, const Vector<S>& x, const S& t) const {
    const Tensor<S> f = deformation(x, t), minors = cofactor(f);
    const Tensor<S> gradient = manufactured::gradient<typename Motion::Axes>(velocity_field(), x, t) *
                               ((1.0 / determinant(f)) * transpose(minors));
    Tensor<S> sigma = blood.viscosity * (gradient + transpose(gradient));
    const S p = pressure(x, t);
    for (int i = 0; i < 3; ++i) sigma(i, i) = sigma(i, i) - p;
    return sigma * minors;
  }
  template <class S>
  Tensor<S> wall_stress(const wall::Law<double>& law, const Vector<S>& x, const S& t) const {
    return wall::piola(law, manufactured::gradient<typename Motion::Axes>(displacement_field(), x, t),
                       Motion::directions());
  }

  /// rho J (dv/dt + grad v (v - w)) - Div P
  Vector<double> blood_force(const physics::Blood& blood, const Vector<double>& x, double t) const {
    const Tensor<double> f = deformation(x, t);
    const double jacobian = determinant(f);
    const Tensor<double> gradient = manufactured::gradient<typename Motion::Axes>(velocity_field(), x, t) *
                                    ((1 / jacobian) * transpose(cofactor(f)));
    const Vector<double> convection = gradient * Motion::stream(x, clock(t));
    const Vector<double> change = manufactured::rate(velocity_field(), x, t);
    const Vector<double> stress = manufactured::divergence<typename Motion::Axes>(
        [&](const auto& place, const auto& time) { return blood_stress(blood, place, time); }, x, t);
    Vector<double> force{};
    for (int i = 0; i < 3; ++i) force[i] = blood.density * jacobian * (change[i] + convection[i]) - stress[i];
    return force;
  }
  /// J div v
  double blood_volume(const Vector<double>& x, double t) const {
    return contract(cofactor(deformation(x, t)),
                    manufactured::gradient<typename Motion::Axes>(velocity_field(), x, t));
  }
  /// rho d2d/dt2 - Div P
  Vector<double> wall_force(const wall::Law<double>& law, double density, const Vector<double>& x,
                            double t) const {
    const Vector<double> acceleration = manufactured::second_rate(displacement_field(), x, t);
    const Vector<double> stress = manufactured::divergence<typename Motion::Axes>(
        [&](const auto& place, const auto& time) { return wall_stress(law, place, time); }, x, t);
    Vector<double> force{};
    for (int i = 0; i < 3; ++i) force[i] = density * acceleration[i] - stress[i];
    return force;
  }
  /// - Div Grad d
  Vector<double> mesh_force(const Vector<double>& x, double t) const {
    const Vector<double> laplacian = manufactured::divergence<typename Motion::Axes>(
        [&](const auto& place, const auto& time) {
          return manufactured::gradient<typename Motion::Axes>(displacement_field(), place, time);
        },
        x, t);
    return {-laplacian[0], -laplacian[1], -laplacian[2]};
  }

  /// What the blood's stress at an opening lacks to balance the pressure there and, at the outlet, the
  /// resistance against backflow.
  Vector<double> opening_load(const Problem& problem, const Vector<double>& x, double t,
                              bool at_outlet) const {
    const Vector<double> normal{0, 0, at_outlet ? 1.0 : -1.0};
    const Vector<double> area = cofactor(deformation(x, t)) * normal;
    const double p = at_outlet ? outlet_pressure(t) : inlet_pressure(t);
    Vector<double> load = blood_stress(problem.blood, x, t) * normal;
    for (int i = 0; i < 3; ++i) load[i] += p * area[i];
    const double flow = flow_density(x, t);
    if (at_outlet && flow < 0) {
      const Vector<double> v = velocity(x, t);
      for (int i = 0; i < 3; ++i) load[i] -= problem.outlet.backflow * problem.blood.density * flow * v[i];
    }
    return load;
  }
  /// P N + the tether
  Vector<double> outer_load(const Problem& problem, const Vector<double>& x, double t) const {
    const Vector<double> normal = Motion::normal(x), d = displacement(x, t),
                         area = cofactor(deformation(x, t)) * normal;
    const double outward = dot(d, normal), size = std::sqrt(dot(area, area));
    Vector<double> load = wall_stress(problem.laws[0], x, t) * normal;
    for (int i = 0; i < 3; ++i) switch (problem.tether.traction) {
        case radial::TetherTraction::normal:
          load[i] += problem.tether.stiffness * (outward * area[i] + d[i] - outward * normal[i]);
          break;
        case radial::TetherTraction::reference:
          load[i] += problem.tether.stiffness * d[i];
          break;
        case radial::TetherTraction::current:
          load[i] += problem.tether.stiffness * size * d[i];
      }
    return load;
  }

 private:
  template <class S>
  S clock(const S& t) const {
    return steady ? S(0.0) : t;
  }
};

/// The same function of place and time, which keeps what it gave for the latest time: every iteration asks
/// again.
template <class Point, class Function>
auto kept(Function function) {
  using Result = std::invoke_result_t<Function, Point, double>;
  struct Memory {
    double time = std::numeric_limits<double>::quiet_NaN();
    std::map<Point, Result> results;
  };
  return [function, memory = std::make_shared<Memory>()](const Point& x, double t) {
    if (t != memory->time) memory->results.clear();
    memory->time = t;
    const auto [place, is_new] = memory->results.try_emplace(x);
    if (is_new) place->second = function(x, t);
    return place->second;
  };
}

/// Gives `problem`, which has a mesh of the vessel, laws and parameters, the loads and boundary values that
/// make the vessel's motion its solution. Displacements are prescribed at the ends, those of the wall too:
/// were its end free but for the node that it shares with the outlet's mesh, orders would be lost, since a
/// solid cannot be held at a point. `vessel` and `problem` have to stay where they are.
template <class Motion>
void set_loads(const Vessel<Motion>& vessel, Conditions<Motion::dimension>& problem) {
  using Point = typename Conditions<Motion::dimension>::Point;
  const auto place = [](const Point& x) { return Motion::place(x); };
  const auto of_time = [](auto function) {
    return [keeper = kept<Point>([function](const Point&, double t) { return function(t); })](double t) {
      return keeper(Point{}, t);
    };
  };
  const auto* const v = &vessel;
  const auto* const p = &problem;
  problem.displacement = kept<Point>([=](const Point& x, double t) { return v->displacement(place(x), t); });
  problem.velocity = kept<Point>([=](const Point& x, double t) { return v->velocity(place(x), t); });
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement.fill(true);
  problem.on(Boundary::inlet).velocity.fill(problem.inlet.kind == InletKind::prescribed);
  if (problem.inlet.kind == InletKind::flow)
    problem.inlet.value = of_time([=](double t) { return v->flow(0, t); });
  if (problem.inlet.kind == InletKind::pressure)
    problem.inlet.value = [=](double t) { return v->inlet_pressure(t); };
  problem.outlet.pressure = of_time([=](double t) { return v->pressure_beyond(p->outlet, t); });
  problem.loads.blood_force =
      kept<Point>([=](const Point& x, double t) { return v->blood_force(p->blood, place(x), t); });
  problem.loads.blood_volume =
      kept<Point>([=](const Point& x, double t) { return v->blood_volume(place(x), t); });
  problem.loads.mesh_force =
      kept<Point>([=](const Point& x, double t) { return v->mesh_force(place(x), t); });
  problem.loads.wall_force = kept<Point>(
      [=](const Point& x, double t) { return v->wall_force(p->laws[0], p->wall_density, place(x), t); });
  const auto inlet =
      kept<Point>([=](const Point& x, double t) { return v->opening_load(*p, place(x), t, false); });
  const auto outlet =
      kept<Point>([=](const Point& x, double t) { return v->opening_load(*p, place(x), t, true); });
  const auto outer = kept<Point>([=](const Point& x, double t) { return v->outer_load(*p, place(x), t); });
  // The wall's normal on the interface is that of the lumen turned round.
  const auto interface = kept<Point>([=](const Point& point, double t) {
    const Vector<double> x = place(point);
    return (v->blood_stress(p->blood, x, t) - v->wall_stress(p->laws[0], x, t)) * v->normal(x);
  });
  // Planes that the vessel is cut along are none of symmetry here.
  const auto cut = kept<Point>([=](const Point& point, double t) {
    const Vector<double> x = place(point);
    return v->blood_stress(p->blood, x, t) * v->cut_normal(x);
  });
  for (const auto boundary : {Boundary::symmetry_x, Boundary::symmetry_y}) {
    problem.on(boundary).displacement.fill(true);
    problem.on(boundary).velocity.fill(false);
  }
  problem.loads.traction = [=](const Point& x, double t, Boundary boundary) {
    switch (boundary) {
      case Boundary::inlet:
        return inlet(x, t);
      case Boundary::outlet:
        return outlet(x, t);
      case Boundary::interface:
        return interface(x, t);
      case Boundary::outer:
        return outer(x, t);
      case Boundary::symmetry_x:
      case Boundary::symmetry_y:
        return cut(x, t);
      default:
        return Vector<double>{};
    }
  };
}

}  // namespace tunica::mms
