// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/compressible_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/linear/band_matrix.hpp"
#include "core/radial/area_motion.hpp"
#include "core/radial/ring_variants.hpp"

namespace tunica::radial {

struct CompressibleRing::Solution {
  std::vector<Interval> mesh;
  double inner = 0;           ///< v_i, cm2
  std::vector<double> nodal;  ///< w, cm2; neighbours share their end node
};

/// The discrete equations, linearised. The inner node, where w = 0, is prescribed: the other nodes are free.
struct CompressibleRing::System {
  linear::BandMatrix tangent;          ///< of the free nodes
  std::vector<double> residual;        ///< of the free nodes
  std::vector<double> by_inner;        ///< derivative of their residuals by v_i
  double pressure = 0;                 ///< in the lumen
  std::vector<double> pressure_slope;  ///< by every node
  double pressure_by_inner = 0;

  double pressure_along(double inner, std::span<const double> free) const {
    return std::inner_product(free.begin(), free.end(), pressure_slope.begin() + 1,
                              pressure_by_inner * inner);
  }
};

namespace {

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
  const bool is_incompressible =
      std::all_of(solution.nodal.begin(), solution.nodal.end(), [](double w) { return w == 0; });
  return [this, &solution, is_incompressible](double xi) {
    if (is_incompressible) {
      const auto moved = motion(solution.inner, 0.0, merged_.radius(xi));
      return std::pair{moved.displacement, moved.radial_slope};
    }
    const auto place = place_of(merged_, solution, solution.inner, solution.nodal, xi);
    const auto moved = motion(place.area, place.area_slope, place.radius);
    return std::pair{moved.displacement, moved.radial_slope};
  };
}

CompressibleRing::Solution CompressibleRing::incompressible(LumenStretch lumen_stretch) const {
  Solution solution{
      refined_for(merged_, radial_mesh(boundaries_, {})), inner_area(merged_, lumen_stretch), {}};
  solution.nodal.assign(solution.mesh.size() * line_.degree() + 1, 0.0);
  return solution;
}

CompressibleRing::Solution CompressibleRing::refitted(const Solution& solution, LumenStretch lumen_stretch,
                                                      const std::vector<Front>& fronts) const {
  const int degree = line_.degree();
  Solution fitted{
      refined_for(merged_, radial_mesh(boundaries_, fronts)), inner_area(merged_, lumen_stretch), {}};
  fitted.nodal.resize(fitted.mesh.size() * degree + 1);
  std::vector<double> shapes(line_.nodes());
  for (std::size_t e = 0; e < fitted.mesh.size(); ++e) {
    const Interval& cell = fitted.mesh[e];
    for (int k = 0; k <= degree; ++k) {
      const double xi =
          std::min(cell.lower + 0.5 * (cell.upper - cell.lower) * (1 + line_.node(k)), cell.upper);
      const std::size_t from = interval_at(solution.mesh, xi);
      const Interval& source = solution.mesh[from];
      line_.shapes_at((2 * xi - source.lower - source.upper) / (source.upper - source.lower), shapes.data());
      fitted.nodal[e * degree + k] =
          std::inner_product(shapes.begin(), shapes.end(), solution.nodal.begin() + from * degree, 0.0);
    }
  }
  fitted.nodal.front() = 0;
  return fitted;
}

void CompressibleRing::assemble(const Ring<double>& ring, const Solution& solution, System& system) const {
  using Change = Dual<double, 2>;
  const int n = line_.nodes();
  const std::size_t nodes = solution.nodal.size();
  system.tangent.reset(nodes - 1, n - 1);
  system.residual.assign(nodes - 1, 0.0);
  system.by_inner.assign(nodes - 1, 0.0);
  system.pressure_slope.assign(nodes, 0.0);
  const double radius = ring.radius(1.0);
  const auto tether = ring.external_pressure(
      motion(seed(solution.inner + solution.nodal.back()), Dual<double, 1>(0.0), radius).displacement);
  system.pressure = tether.value;
  system.pressure_by_inner = tether.derivative[0];
  std::vector<double> shape(n), slope(n), of_element(static_cast<std::size_t>(n) * n);
  for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
    const Interval& cell = solution.mesh[e];
    const auto& law = ring.layers[cell.layer].law;
    const double half = 0.5 * (cell.upper - cell.lower);
    const double half_width = half * ring.thickness;
    const std::size_t first = e * (n - 1);
    std::fill(of_element.begin(), of_element.end(), 0.0);
    for (std::size_t q = 0; q < line_.rule().size(); ++q) {
      const double place = ring.radius(cell.lower + half * (1 + line_.rule()[q].position));
      double area = 0, area_slope = 0;
      for (int k = 0; k < n; ++k) {
        slope[k] = line_.slope(q, k) / half_width;
        area += line_.shape(q, k) * solution.nodal[first + k];
        area_slope += slope[k] * solution.nodal[first + k];
      }
      const auto flux =
          fluxes(law, Change::variable(solution.inner + area, 0), Change::variable(area_slope, 1), place);
      const auto& [radial, hoop] = flux;
      const double weight = line_.rule()[q].weight * half_width;
      system.pressure += weight * hoop.value;
      system.pressure_by_inner += weight * hoop.derivative[0];
      for (int k = 0; k < n; ++k) shape[k] = line_.shape(q, k);
      for (int i = 0; i < n; ++i) {
        system.pressure_slope[first + i] +=
            weight * (hoop.derivative[0] * shape[i] + hoop.derivative[1] * slope[i]);
        if (first + i == 0) continue;
        const std::size_t row = first + i - 1;
        system.residual[row] += weight * (radial.value * slope[i] + hoop.value * shape[i]);
        const double by_area = weight * (radial.derivative[0] * slope[i] + hoop.derivative[0] * shape[i]);
        const double by_slope = weight * (radial.derivative[1] * slope[i] + hoop.derivative[1] * shape[i]);
        system.by_inner[row] += by_area;
        double* in_row = &of_element[static_cast<std::size_t>(i) * n];
        for (int j = 0; j < n; ++j) in_row[j] += by_area * shape[j] + by_slope * slope[j];
      }
    }
    for (int i = first == 0 ? 1 : 0; i < n; ++i)
      for (int j = first == 0 ? 1 : 0; j < n; ++j)
        system.tangent.add(first + i - 1, first + j - 1, of_element[static_cast<std::size_t>(i) * n + j]);
  }
  system.residual.back() += tether.value;
  system.by_inner.back() += tether.derivative[0];
  system.tangent.add(nodes - 2, nodes - 2, tether.derivative[0]);
  system.pressure_slope.back() += tether.derivative[0];
}

bool CompressibleRing::newton(const Ring<double>& ring, Solution& solution) const {
  constexpr int most_iterations = 40;
  double previous_update = ring.inner_radius * ring.inner_radius;
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
    const std::vector<double> before = solution.nodal;
    const auto inverted = [&] {
      for (std::size_t k = 1; k < before.size(); ++k) solution.nodal[k] = before[k] + step * update[k - 1];
      const int degree = line_.degree();
      for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
        const Interval& cell = solution.mesh[e];
        const double half = 0.5 * (cell.upper - cell.lower);
        for (std::size_t q = 0; q < line_.rule().size(); ++q) {
          const double radius = ring.radius(cell.lower + half * (1 + line_.rule()[q].position));
          double area = solution.inner, area_slope = 0;
          for (int k = 0; k <= degree; ++k) {
            area += line_.shape(q, k) * solution.nodal[e * degree + k];
            area_slope += line_.slope(q, k) * solution.nodal[e * degree + k];
          }
          if (radius + area_slope / (half * ring.thickness) <= 0 || radius * radius + 2 * area <= 0)
            return true;
        }
      }
      const double outer = ring.radius(1.0);
      return outer * outer + 2 * (solution.inner + solution.nodal.back()) <= 0;
    };
    while (inverted() && step > 1e-3) step *= 0.5;
    // Well-behaved walls converge in a few full steps. Where stress all but jumps Newton's method
    // cycles around the jump, unless each step has to bring the residual down.
    constexpr int full_steps = 6;
    // Convergence is quadratic, so the error that an update leaves is about its square over the one
    // before. That error, and not the update, has to be negligible beside w, which is all that the stiff
    // volume change depends on.
    double largest = 0;
    for (const double w : solution.nodal) largest = std::max(largest, std::abs(w));
    const double negligible = options_.left_by_newton * largest;
    const auto is_small = [&] { return size * size <= negligible * previous_update; };
    if (iteration >= full_steps) {
      const auto squared = [](std::span<const double> r) {
        return std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
      };
      const double before_step = squared(system.residual);
      const auto grows = [&] {
        const auto r = residual(ring, solution, solution.inner).nodal;
        return !(squared(std::span(r).subspan(1)) < before_step);
      };
      while (!is_small() && grows() && step > 1e-3) {
        step *= 0.5;
        inverted();
      }
    }
    if (step == 1 && is_small()) return true;
    previous_update = std::max(size, negligible);
  }
  return false;
}

CompressibleRing::Solution CompressibleRing::solve_from(const Ring<double>& ring, LumenStretch lumen_stretch,
                                                        const Solution& guess) const {
  Solution start = guess;
  start.inner = inner_area(merged_, lumen_stretch);
  std::vector<Front> put = find_fronts(ring, boundaries_, field(start), options_.kink);
  Solution solution = refitted(start, lumen_stretch, put);
  FrontSearch search;
  constexpr int most_fits = 60;
  for (int fit = 0; fit < most_fits; ++fit) {
    if (!newton(ring, solution))
      throw SolverFailure(fmt::format(
          "Newton's method finds no equilibrium of the wall at lumen stretch {:.6g}", lumen_stretch.value()));
    const std::vector<Front> found = find_fronts(ring, boundaries_, field(solution), options_.kink);
    const bool is_fitted = std::all_of(
        found.begin(), found.end(), [&](const Front& front) { return has_end_near(solution.mesh, front); });
    if (is_fitted) return solution;
    put = search.next(put, found);
    if (search.is_closed()) return solution;
    solution = refitted(solution, lumen_stretch, put);
  }
  throw SolverFailure(
      fmt::format("the recruitment front does not settle at lumen stretch {:.6g}", lumen_stretch.value()));
}

CompressibleRing::Solution CompressibleRing::solve(LumenStretch lumen_stretch) const {
  if (!(lumen_stretch.value() > 0))
    throw SolverFailure(fmt::format("the lumen has closed (stretch {:.6g})", lumen_stretch.value()));
  if (stress_jumps(merged_)) return solve_by_sharpening(lumen_stretch);
  try {
    return solve_from(merged_, lumen_stretch, incompressible(lumen_stretch));
  } catch (const SolverFailure&) {
    return with_bulk_moduli_times(merged_, 1) ? solve_by_softening(lumen_stretch)
                                              : solve_by_stretching(lumen_stretch);
  }
}

double CompressibleRing::accuracy() const {
  // A stress that all but jumps leaves elements so short that round-off shows in their slopes.
  return std::max(options_.accuracy, stress_jumps(merged_) ? 1e-7 : 1e-10);
}

CompressibleRing::Solution CompressibleRing::solve_by_sharpening(LumenStretch lumen_stretch) const {
  double sharpest = 0;
  for (const auto& layer : merged_.layers)
    for (const auto& family : wall::families(layer.law))
      sharpest = std::max(sharpest, family.recruitment.sharpness);
  double sharpness = 10, ratio = 4;
  Solution solution =
      solve_from(with_sharpness_at_most(merged_, sharpness), lumen_stretch, incompressible(lumen_stretch));
  while (sharpness < sharpest) {
    const double next = std::min(sharpest, sharpness * ratio);
    try {
      solution = solve_from(with_sharpness_at_most(merged_, next), lumen_stretch, solution);
      sharpness = next;
    } catch (const SolverFailure&) {
      ratio = std::sqrt(ratio);
      if (ratio < 1.02) throw;
    }
  }
  return solution;
}

CompressibleRing::Solution CompressibleRing::solve_by_softening(LumenStretch lumen_stretch) const {
  // So stiff that only overflow keeps Newton's method from the incompressible solution.
  constexpr double stiffest = 1e8;
  double factor = stiffest, ratio = 100;
  Solution solution =
      solve_from(*with_bulk_moduli_times(merged_, factor), lumen_stretch, incompressible(lumen_stretch));
  while (factor > 1) {
    const double next = std::max(1.0, factor / ratio);
    try {
      solution = solve_from(*with_bulk_moduli_times(merged_, next), lumen_stretch, solution);
      factor = next;
      ratio *= 1.5;
    } catch (const SolverFailure&) {
      ratio = std::sqrt(ratio);
      if (ratio < 1.02) throw;
    }
  }
  return solution;
}

CompressibleRing::Solution CompressibleRing::solve_by_stretching(LumenStretch lumen_stretch) const {
  const double strain = lumen_stretch.strain();
  double share = 0, step = 0.25;
  Solution solution = solve_from(merged_, 1.0, incompressible(1.0));
  while (share < 1) {
    const double next = std::min(1.0, share + step);
    try {
      solution = solve_from(merged_, LumenStretch::of_strain(next * strain), solution);
      share = next;
      step *= 1.5;
    } catch (const SolverFailure&) {
      step *= 0.25;
      if (step < 1e-3) throw;
    }
  }
  return solution;
}

template <class P>
CompressibleRing::Residual<P> CompressibleRing::residual(const Ring<P>& ring, const Solution& solution,
                                                         const P& inner) const {
  const int n = line_.nodes();
  const P outer = ring.radius(1.0);
  const P tether =
      ring.external_pressure(motion(P(inner + solution.nodal.back()), P(0.0), outer).displacement);
  Residual<P> result{std::vector<P>(solution.nodal.size(), P(0.0)), tether};
  for (std::size_t e = 0; e < solution.mesh.size(); ++e) {
    const Interval& cell = solution.mesh[e];
    const MovingInterval<P> ends = moved_with_layers(ring, boundaries_, cell);
    const P half = 0.5 * (ends.upper - ends.lower);
    const P half_width = half * ring.thickness;
    const std::size_t first = e * (n - 1);
    for (std::size_t q = 0; q < line_.rule().size(); ++q) {
      const P radius = ring.radius(P(ends.lower + half * (1 + line_.rule()[q].position)));
      double area = 0, area_slope = 0;
      for (int k = 0; k < n; ++k) {
        area += line_.shape(q, k) * solution.nodal[first + k];
        area_slope += line_.slope(q, k) * solution.nodal[first + k];
      }
      const auto [radial, hoop] =
          fluxes(ring.layers[cell.layer].law, P(inner + area), P(area_slope / half_width), radius);
      const P weight = line_.rule()[q].weight * half_width;
      result.pressure += weight * hoop;
      for (int k = 0; k < n; ++k)
        result.nodal[first + k] +=
            weight * (radial * P(line_.slope(q, k) / half_width) + hoop * line_.shape(q, k));
    }
  }
  result.nodal.back() += tether;
  return result;
}

template <class P, class S>
CompressibleRing::Place<P, S> CompressibleRing::place_of(const Ring<P>& ring, const Solution& solution,
                                                         const S& inner, const std::vector<S>& nodal,
                                                         double xi) const {
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
  S area(0.0), area_slope(0.0);
  for (int k = 0; k < n; ++k) {
    area += shapes[k] * nodal[e * (n - 1) + k];
    area_slope += slopes[k] * nodal[e * (n - 1) + k];
  }
  if constexpr (!std::same_as<P, double>) {
    if (const double speed = moving_position.derivative[0]; speed != 0) {
      area.derivative[0] += area_slope.value * speed;
      // The second derivative, from the first at the nodes: both are polynomials of the element.
      double curvature = 0;
      std::vector<double> at_node(n);
      for (int j = 0; j < n; ++j) {
        line_.slopes_at(line_.node(j), at_node.data());
        double slope = 0;
        for (int k = 0; k < n; ++k) slope += at_node[k] * nodal[e * (n - 1) + k].value;
        curvature += slope * slopes[j];
      }
      area_slope.derivative[0] += curvature * speed;
    }
  }
  area += inner;
  area_slope = area_slope / (half * ring.thickness);
  return {cell.layer, ring.radius(xi), area, area_slope};
}

template <class P, class S>
WallState<S> CompressibleRing::state(const Ring<P>& ring, const Solution& solution, const S& inner,
                                     const std::vector<S>& nodal, double xi) const {
  const auto [layer, radius, area, area_slope] = place_of(ring, solution, inner, nodal, xi);
  WallState<S> result = motion(area, area_slope, radius);
  result.radial_stress = fluxes(ring.layers[layer].law, area, area_slope, radius).radial_stress;
  return result;
}

RingResponse CompressibleRing::respond(LumenStretch lumen_stretch, std::span<const double> places,
                                       bool derivatives) const {
  using D = Dual<double, 1>;
  Solution solution = solve(lumen_stretch);
  System system;
  assemble(merged_, solution, system);
  const std::size_t free = system.residual.size();
  if (!system.tangent.factorise())
    throw SolverFailure(
        fmt::format("the wall's equilibrium is singular at lumen stretch {:.6g}", lumen_stretch.value()));
  // The equations are linearised for the response, so that a last step of Newton's method is for nothing.
  std::vector<double> last(free);
  for (std::size_t k = 0; k < free; ++k) last[k] = -system.residual[k];
  system.tangent.solve(last);
  for (std::size_t k = 0; k < free; ++k) solution.nodal[k + 1] += last[k];
  system.pressure += system.pressure_along(0.0, last);
  const auto nodal_along = [&](std::span<const double> change) {
    std::vector<D> nodal(solution.nodal.begin(), solution.nodal.end());
    for (std::size_t k = 0; k < free; ++k) nodal[k + 1].derivative[0] = change[k];
    return nodal;
  };

  RingResponse response;
  response.pressure = system.pressure;
  for (const double xi : places)
    response.states.push_back(state(ring_, solution, solution.inner, solution.nodal, xi));

  // Along the curve of equilibria the free nodes follow v_i: K dw = -d(residual)/dv_i.
  std::vector<double> follow(free);
  for (std::size_t k = 0; k < free; ++k) follow[k] = -system.by_inner[k];
  system.tangent.solve(follow);
  const double area_by_stretch = lumen_stretch.value() * ring_.inner_radius * ring_.inner_radius;
  response.pressure_slope = system.pressure_along(1.0, follow) * area_by_stretch;
  {
    const auto nodal = nodal_along(follow);
    for (const double xi : places) {
      const D inner(solution.inner, {1.0});
      const auto s = state(ring_, solution, inner, nodal, xi);
      response.state_rates.push_back({s.displacement.derivative[0] * area_by_stretch,
                                      s.radial_slope.derivative[0] * area_by_stretch, 0.0});
    }
  }
  if (!derivatives) return response;

  for (const Seeded& ring : seeded_) {
    const D inner = inner_area(ring, lumen_stretch);
    const Residual<D> r = residual(ring, solution, inner);
    std::vector<double> change(free);
    for (std::size_t k = 0; k < free; ++k) change[k] = -r.nodal[k + 1].derivative[0];
    system.tangent.solve(change);
    response.pressure_derivatives.push_back(r.pressure.derivative[0] + system.pressure_along(0.0, change));
    const auto nodal = nodal_along(change);
    auto& states = response.state_derivatives.emplace_back();
    for (const double xi : places) {
      const WallState<D> s = state(ring, solution, inner, nodal, xi);
      states.push_back(
          {s.displacement.derivative[0], s.radial_slope.derivative[0], s.radial_stress.derivative[0]});
    }
  }
  return response;
}

}  // namespace tunica::radial
