// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/compressible_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "core/linear/band_matrix.hpp"

namespace tunica::radial {

using frame::Radial;

struct CompressibleRing::Solution {
  std::vector<Interval> mesh;
  std::vector<double> displacement;  ///< nodal; neighbours share their end node
};

/// The discrete equations, linearised. The inner node is prescribed: the other nodes are free.
struct CompressibleRing::System {
  linear::BandMatrix tangent;        ///< of the free nodes
  std::vector<double> inner_column;  ///< derivative of their residuals by the inner node
  std::vector<double> residual;      ///< of the free nodes
  /// The weak form tested with v = 1, p r_i = T(u_o) + int P_TT dR: it gives the pressure without the
  /// slopes that round-off spoils in the short elements at a front.
  double reaction = 0;
  std::vector<double> reaction_slope;  ///< by every node

  double reaction_along(double inner, std::span<const double> free) const {
    return std::inner_product(free.begin(), free.end(), reaction_slope.begin() + 1,
                              reaction_slope[0] * inner);
  }
};

namespace {

/// u(R) of an incompressible ring with the same lumen stretch: r^2 - R^2 is constant.
Field incompressible_guess(const Ring<double>& ring, double lumen_stretch) {
  const double r0 = ring.inner_radius;
  const double shift = (lumen_stretch * lumen_stretch - 1) * r0 * r0;
  return [&ring, shift](double xi) {
    const double radius = ring.radius(xi);
    const double current = std::sqrt(radius * radius + shift);
    return std::pair{shift / (current + radius), radius / current - 1};
  };
}

/// dP/dH restricted to the two entries of H that a ring has.
struct RadialStress {
  double radial, hoop;
  std::array<double, 2> radial_tangent, hoop_tangent;
};

RadialStress radial_stress(const wall::Law<double>& law, double slope, double hoop) {
  using Strain = Dual<double, 2>;
  const auto gradient =
      Tensor<Strain>::diagonal(Strain::variable(slope, 0), Strain::variable(hoop, 1), Strain(0.0));
  const auto stress = wall::piola(law, gradient, Radial::axes());
  return {stress(0, 0).value, stress(1, 1).value, stress(0, 0).derivative, stress(1, 1).derivative};
}

bool stress_jumps(const Ring<double>& ring) {
  return std::any_of(ring.layers.begin(), ring.layers.end(), [](const auto& layer) {
    const auto& families = wall::families(layer.law);
    return std::any_of(families.begin(), families.end(),
                       [](const auto& family) { return family.exponent == 1; });
  });
}

/// Families at +beta and -beta act alike on a ring, whose shear stress nobody asks for: one of twice
/// the weight stands for both.
Ring<double> with_mirror_images_merged(Ring<double> ring) {
  for (auto& layer : ring.layers) {
    std::visit(
        [&](auto& law) {
          if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>) {
            std::vector<wall::CollagenFamily<double>> merged;
            for (const auto& family : law.families) {
              const auto image = std::find_if(merged.begin(), merged.end(), [&](const auto& other) {
                return std::abs(other.angle) == std::abs(family.angle) &&
                       other.stiffness == family.stiffness && other.stiffening == family.stiffening &&
                       other.activation_squared == family.activation_squared &&
                       other.exponent == family.exponent &&
                       other.recruitment.sharpness == family.recruitment.sharpness &&
                       other.recruitment.sharp == family.recruitment.sharp;
              });
              if (image == merged.end())
                merged.push_back(family);
              else
                image->weight += family.weight;
            }
            law.families = std::move(merged);
          }
        },
        layer.law);
  }
  return ring;
}

Ring<double> with_sharpness_at_most(Ring<double> ring, double sharpness) {
  for (auto& layer : ring.layers) {
    std::visit(
        [&](auto& law) {
          if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>)
            for (auto& family : law.families)
              family.recruitment.sharpness = std::min(family.recruitment.sharpness, sharpness);
        },
        layer.law);
  }
  return ring;
}

std::size_t interval_at(const std::vector<Interval>& mesh, double xi) {
  // An interface belongs to the inner element.
  const auto it = std::lower_bound(mesh.begin(), mesh.end(), xi,
                                   [](const Interval& interval, double x) { return interval.upper < x; });
  return std::min<std::size_t>(it - mesh.begin(), mesh.size() - 1);
}

}  // namespace

CompressibleRing::CompressibleRing(Ring<double> ring, std::vector<Seeded> seeded, Options options)
    : ring_(std::move(ring)),
      merged_(with_mirror_images_merged(ring_)),
      seeded_(std::move(seeded)),
      options_(options),
      line_(options.degree, options.points),
      boundaries_(layer_boundaries(ring_)) {}

Field CompressibleRing::field(const Solution& solution) const {
  return [this, &solution](double xi) {
    const auto s = state(ring_, solution, solution.displacement, xi);
    return std::pair{s.displacement, s.radial_slope};
  };
}

void CompressibleRing::interpolate(const Field& field, Solution& solution) const {
  const int degree = line_.degree();
  solution.displacement.resize(solution.mesh.size() * degree + 1);
  for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
    const Interval& cell = solution.mesh[e];
    for (int k = 0; k <= degree; ++k) {
      const double xi = cell.lower + 0.5 * (cell.upper - cell.lower) * (1 + line_.node(k));
      solution.displacement[e * degree + k] = field(std::min(xi, cell.upper)).first;
    }
  }
}

void CompressibleRing::assemble(const Ring<double>& ring, const Solution& solution, System& system) const {
  const int n = line_.nodes();
  const std::size_t nodes = solution.displacement.size();
  system.tangent.reset(nodes - 1, n - 1);
  system.inner_column.assign(nodes - 1, 0.0);
  system.residual.assign(nodes - 1, 0.0);
  system.reaction_slope.assign(nodes, 0.0);
  system.reaction = 0;
  std::vector<double> slope(n), hoop(n);
  for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
    const Interval& cell = solution.mesh[e];
    const auto& law = ring.layers[cell.layer].law;
    const double half = 0.5 * (cell.upper - cell.lower);
    const double half_width = half * ring.thickness;
    const std::size_t first = e * (n - 1);
    for (std::size_t q = 0; q < line_.rule().size(); ++q) {
      const double radius = ring.radius(cell.lower + half * (1 + line_.rule()[q].position));
      double du = 0, u_over_r = 0;
      for (int k = 0; k < n; ++k) {
        slope[k] = line_.slope(q, k) / half_width;
        hoop[k] = line_.shape(q, k) / radius;
        du += slope[k] * solution.displacement[first + k];
        u_over_r += hoop[k] * solution.displacement[first + k];
      }
      const RadialStress stress = radial_stress(law, du, u_over_r);
      const double weight = line_.rule()[q].weight * half_width * Radial::measure(radius);
      system.reaction += weight / radius * stress.hoop;
      for (int i = 0; i < n; ++i) {
        system.reaction_slope[first + i] +=
            weight / radius * (stress.hoop_tangent[0] * slope[i] + stress.hoop_tangent[1] * hoop[i]);
        if (first + i == 0) continue;
        const std::size_t row = first + i - 1;
        system.residual[row] += weight * (stress.radial * slope[i] + stress.hoop * hoop[i]);
        const double by_slope =
            weight * (slope[i] * stress.radial_tangent[0] + hoop[i] * stress.hoop_tangent[0]);
        const double by_hoop =
            weight * (slope[i] * stress.radial_tangent[1] + hoop[i] * stress.hoop_tangent[1]);
        for (int j = 0; j < n; ++j) {
          const double entry = by_slope * slope[j] + by_hoop * hoop[j];
          if (first + j == 0)
            system.inner_column[row] += entry;
          else
            system.tangent.add(row, first + j - 1, entry);
        }
      }
    }
  }
  const auto tether = ring.tether_force(seed(solution.displacement.back()));
  system.residual.back() += tether.value;
  system.tangent.add(nodes - 2, nodes - 2, tether.derivative[0]);
  system.reaction += tether.value;
  system.reaction_slope.back() += tether.derivative[0];
}

bool CompressibleRing::newton(const Ring<double>& ring, Solution& solution) const {
  constexpr int most_iterations = 40;
  // Convergence is quadratic, so the error that an update leaves is about its square over the one
  // before. That error, and not the update, has to be negligible.
  const double negligible = 1e-13 * ring.inner_radius;
  double previous_update = ring.inner_radius;
  const auto inner = solution.displacement.front();
  System system;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    assemble(ring, solution, system);
    if (!system.tangent.factorise()) return false;
    std::vector<double> update(system.residual.size());
    for (std::size_t k = 0; k < update.size(); ++k) update[k] = -system.residual[k];
    system.tangent.solve(update);
    double size = 0;
    for (const double change : update) size = std::max(size, std::abs(change));
    if (!std::isfinite(size)) return false;

    // A full step that would turn an element inside out is shortened.
    double step = 1;
    const std::vector<double> before = solution.displacement;
    const auto inverted = [&] {
      for (std::size_t k = 1; k < before.size(); ++k)
        solution.displacement[k] = before[k] + step * update[k - 1];
      const int degree = line_.degree();
      for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
        const Interval& cell = solution.mesh[e];
        const double half_width = 0.5 * (cell.upper - cell.lower) * ring.thickness;
        for (std::size_t q = 0; q < line_.rule().size(); ++q) {
          double du = 0;
          for (int k = 0; k <= degree; ++k) du += line_.slope(q, k) * solution.displacement[e * degree + k];
          if (1 + du / half_width <= 0) return true;
        }
      }
      return false;
    };
    while (inverted() && step > 1e-3) step *= 0.5;
    // Well-behaved walls converge in a few full steps. Where stress all but jumps Newton's method
    // cycles around the jump, unless each step has to bring the residual down.
    constexpr int full_steps = 6;
    if (iteration >= full_steps) {
      const auto squared = [](std::span<const double> r) {
        return std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
      };
      const double before_step = squared(system.residual);
      const auto grows = [&] {
        const auto r = residual(ring, solution, inner).nodal;
        return !(squared(std::span(r).subspan(1)) < before_step);
      };
      while (size * size > negligible * previous_update && grows() && step > 1e-3) {
        step *= 0.5;
        inverted();
      }
    }
    solution.displacement.front() = inner;
    if (step == 1 && size * size < negligible * previous_update) return true;
    previous_update = std::max(size, negligible);
  }
  return false;
}

CompressibleRing::Solution CompressibleRing::solve_from(const Ring<double>& ring, double lumen_stretch,
                                                        const Field& guess) const {
  const double inner = (lumen_stretch - 1) * ring.inner_radius;
  Solution solution;
  solution.mesh = radial_mesh(boundaries_, find_fronts(ring, boundaries_, guess));
  interpolate(guess, solution);
  solution.displacement.front() = inner;
  constexpr int most_fits = 30;
  for (int fit = 0; fit < most_fits; ++fit) {
    if (!newton(ring, solution))
      throw SolverFailure(fmt::format(
          "the wall has no equilibrium that Newton's method finds at lumen stretch {:.6g}", lumen_stretch));
    const std::vector<Front> moved = find_fronts(ring, boundaries_, field(solution));
    const bool fitted_already = std::all_of(
        moved.begin(), moved.end(), [&](const Front& front) { return has_end_near(solution.mesh, front); });
    if (fitted_already) return solution;
    Solution fitted{radial_mesh(boundaries_, moved), {}};
    interpolate(field(solution), fitted);
    fitted.displacement.front() = inner;
    solution = std::move(fitted);
  }
  throw SolverFailure(
      fmt::format("the recruitment front does not settle at lumen stretch {:.6g}", lumen_stretch));
}

CompressibleRing::Solution CompressibleRing::solve(double lumen_stretch) const {
  if (!(lumen_stretch > 0))
    throw SolverFailure(fmt::format("the lumen has closed (stretch {:.6g})", lumen_stretch));
  const Field guess = incompressible_guess(merged_, lumen_stretch);
  if (stress_jumps(merged_)) return solve_by_sharpening(lumen_stretch, guess);
  try {
    return solve_from(merged_, lumen_stretch, guess);
  } catch (const SolverFailure&) {
    return solve_by_stretching(lumen_stretch);
  }
}

double CompressibleRing::accuracy() const {
  // A stress that all but jumps leaves elements so short that round-off shows in their slopes.
  return stress_jumps(merged_) ? 1e-7 : 1e-10;
}

CompressibleRing::Solution CompressibleRing::solve_by_sharpening(double lumen_stretch,
                                                                 const Field& guess) const {
  double sharpest = 0;
  for (const auto& layer : merged_.layers)
    for (const auto& family : wall::families(layer.law))
      sharpest = std::max(sharpest, family.recruitment.sharpness);
  double sharpness = 10, ratio = 4;
  Solution solution = solve_from(with_sharpness_at_most(merged_, sharpness), lumen_stretch, guess);
  while (sharpness < sharpest) {
    const double next = std::min(sharpest, sharpness * ratio);
    try {
      solution = solve_from(with_sharpness_at_most(merged_, next), lumen_stretch, field(solution));
      sharpness = next;
    } catch (const SolverFailure&) {
      ratio = std::sqrt(ratio);
      if (ratio < 1.02) throw;
    }
  }
  return solution;
}

CompressibleRing::Solution CompressibleRing::solve_by_stretching(double lumen_stretch) const {
  double reached = 1, step = 0.25 * (lumen_stretch - 1);
  Solution solution = solve_from(merged_, 1.0, incompressible_guess(ring_, 1.0));
  while (std::abs(reached - lumen_stretch) > 1e-14) {
    const double next = std::abs(lumen_stretch - reached) <= std::abs(step) ? lumen_stretch : reached + step;
    try {
      solution = solve_from(merged_, next, field(solution));
      reached = next;
      step *= 1.5;
    } catch (const SolverFailure&) {
      step *= 0.25;
      if (std::abs(step) < 1e-3 * std::abs(lumen_stretch - 1)) throw;
    }
  }
  return solution;
}

template <class P>
CompressibleRing::Residual<P> CompressibleRing::residual(const Ring<P>& ring, const Solution& solution,
                                                         const P& inner_displacement) const {
  const int n = line_.nodes();
  std::vector<P> displacement(solution.displacement.begin(), solution.displacement.end());
  displacement.front() = inner_displacement;
  Residual<P> result{std::vector<P>(displacement.size(), P(0.0)), ring.tether_force(displacement.back())};
  for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
    const Interval& cell = solution.mesh[e];
    const MovingInterval<P> ends = moved_with_layers(ring, boundaries_, cell);
    const P half = 0.5 * (ends.upper - ends.lower);
    const P half_width = half * ring.thickness;
    const std::size_t first = e * (n - 1);
    for (std::size_t q = 0; q < line_.rule().size(); ++q) {
      const P radius = ring.radius(P(ends.lower + half * (1 + line_.rule()[q].position)));
      P u(0.0), du(0.0);
      for (int k = 0; k < n; ++k) {
        u += line_.shape(q, k) * displacement[first + k];
        du += line_.slope(q, k) * displacement[first + k];
      }
      const Tensor<P> stress = wall::piola(ring.layers[cell.layer].law,
                                           Radial::gradient(u, P(du / half_width), radius), Radial::axes());
      const P weight = line_.rule()[q].weight * half_width * Radial::measure(radius);
      result.reaction += weight * Radial::contract_with_test(stress, 1.0, P(0.0), radius);
      for (int k = 0; k < n; ++k)
        result.nodal[first + k] +=
            weight *
            Radial::contract_with_test(stress, line_.shape(q, k), P(line_.slope(q, k) / half_width), radius);
    }
  }
  result.nodal.back() += ring.tether_force(displacement.back());
  return result;
}

template <class P>
WallState<P> CompressibleRing::state(const Ring<P>& ring, const Solution& solution,
                                     const std::vector<P>& displacement, double xi) const {
  const std::size_t e = interval_at(solution.mesh, xi);
  const Interval& cell = solution.mesh[e];
  const MovingInterval<P> ends = moved_with_layers(ring, boundaries_, cell);
  const P half = 0.5 * (ends.upper - ends.lower);
  // With the layers' shares the element passes by the place.
  const P moving_position = (xi - ends.lower) / half - 1.0;
  const double position = plain(moving_position);
  const int n = line_.nodes();
  std::vector<double> shapes(n), slopes(n);
  line_.shapes_at(position, shapes.data());
  line_.slopes_from(shapes.data(), slopes.data());
  P u(0.0), du(0.0);
  for (int k = 0; k < n; ++k) {
    u += shapes[k] * displacement[e * (n - 1) + k];
    du += slopes[k] * displacement[e * (n - 1) + k];
  }
  if constexpr (!std::same_as<P, double>) {
    if (const double speed = moving_position.derivative[0]; speed != 0) {
      u.derivative[0] += du.value * speed;
      // The second derivative, from the first at the nodes: both are polynomials of the element.
      double curvature = 0;
      std::vector<double> at_node(n);
      for (int j = 0; j < n; ++j) {
        line_.slopes_at(line_.node(j), at_node.data());
        double slope = 0;
        for (int k = 0; k < n; ++k) slope += at_node[k] * displacement[e * (n - 1) + k].value;
        curvature += slope * slopes[j];
      }
      du.derivative[0] += curvature * speed;
    }
  }
  du = du / (half * ring.thickness);
  return {u, du, P(0.0)};
}

RingResponse CompressibleRing::respond(double lumen_stretch, std::span<const double> places,
                                       bool derivatives) const {
  const Solution solution = solve(lumen_stretch);
  const std::vector<double>& u = solution.displacement;
  System system;
  assemble(merged_, solution, system);
  const std::size_t free = system.residual.size();
  if (!system.tangent.factorise())
    throw SolverFailure(
        fmt::format("the wall's equilibrium is singular at lumen stretch {:.6g}", lumen_stretch));

  // Along the curve of equilibria the free nodes follow the inner one: K_ff du_f/du_i = -K_fi.
  const double inner_radius = lumen_stretch * ring_.inner_radius;
  std::vector<double> follow(free);
  for (std::size_t k = 0; k < free; ++k) follow[k] = -system.inner_column[k];
  system.tangent.solve(follow);
  RingResponse response;
  response.pressure = system.reaction / inner_radius;
  response.pressure_slope =
      (system.reaction_along(1.0, follow) - response.pressure) / inner_radius * ring_.inner_radius;

  const auto state_with_stress = [&]<class P>(const Ring<P>& ring, const std::vector<P>& displacement,
                                              double xi) {
    WallState<P> s = state(ring, solution, displacement, xi);
    const auto gradient = Radial::gradient(s.displacement, s.radial_slope, ring.radius(xi));
    const auto& law = ring.layers[solution.mesh[interval_at(solution.mesh, xi)].layer].law;
    s.radial_stress = cauchy_stress(wall::piola(law, gradient, Radial::axes()), gradient)(0, 0);
    return s;
  };
  for (const double xi : places) response.states.push_back(state_with_stress(ring_, u, xi));
  std::vector<double> rates{ring_.inner_radius};
  for (const double f : follow) rates.push_back(f * ring_.inner_radius);
  for (const double xi : places) response.state_rates.push_back(state(ring_, solution, rates, xi));
  if (!derivatives) return response;

  using D = Dual<double, 1>;
  for (const Seeded& ring : seeded_) {
    const D inner = (lumen_stretch - 1) * ring.inner_radius;
    const Residual<D> r = residual(ring, solution, inner);
    std::vector<double> du(free);
    for (std::size_t k = 0; k < free; ++k) du[k] = -r.nodal[k + 1].derivative[0];
    system.tangent.solve(du);
    const double reaction = r.reaction.derivative[0] + system.reaction_along(0.0, du);
    response.pressure_derivatives.push_back(
        (reaction - response.pressure * lumen_stretch * ring.inner_radius.derivative[0]) / inner_radius);
    std::vector<D> displacement(u.size());
    displacement[0] = inner;
    for (std::size_t k = 0; k < free; ++k) displacement[k + 1] = D(u[k + 1], {du[k]});
    auto& states = response.state_derivatives.emplace_back();
    for (const double xi : places) {
      const WallState<D> s = state_with_stress(ring, displacement, xi);
      states.push_back(
          {s.displacement.derivative[0], s.radial_slope.derivative[0], s.radial_stress.derivative[0]});
    }
  }
  return response;
}

}  // namespace tunica::radial
