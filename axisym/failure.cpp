// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::axisym {

namespace {

/// Cells that are compressed to less than this are taken for the cause.
constexpr double compressed = 0.15;

std::string place_of(const Mesh& mesh, int cell, int node) {
  return fmt::format("r = {:.4g}, z = {:.4g} cm (cell {} of {})", mesh.points[node][0], mesh.points[node][1],
                     cell, mesh.cells.size());
}

/// A wall that bulges or caves in beside an end that is held leans over it.
bool beside_clamped_end(const Problem& problem, const Point& place) {
  const Extent ends = extent(problem.mesh);
  const double near = 2 * inlet_radius(problem.mesh);
  return problem.on(Boundary::wall_inlet).displacement[0] &&
         (place[1] < ends.inlet + near || place[1] > ends.outlet - near);
}

std::string compression(const Problem& problem, const LeastJacobian& least) {
  const Mesh& mesh = problem.mesh;
  const Cell& cell = mesh.cells[least.cell];
  const bool blood = cell.part == Part::blood;
  const int centre = cell.nodes[mesh.centre_node()];
  std::string text = fmt::format(
      "; the {} is {} at {}", blood ? "blood's mesh" : "wall",
      least.value > 0 ? fmt::format("compressed to J = {:.2g}", least.value) : "turned inside out",
      place_of(mesh, least.cell, centre));
  if (!blood) return text;
  if (beside_clamped_end(problem, mesh.points[centre]))
    return text + ", beside a clamped end; geometry.ends = \"sliding\" bears more";
  return problem.discretisation.stiffened_mesh ? text : text + "; mesh.motion = \"stiffened\" may bear more";
}

}  // namespace

std::string place_of(const Assembler& assembler, std::size_t entry) {
  const Layout& layout = assembler.layout();
  const Mesh& mesh = assembler.problem().mesh;
  if (entry >= layout.scalar_begin())
    return entry == layout.inlet_pressure ? "pressure at the inlet" : "pressure at the outlet";
  int node = -1;
  const char* field = "blood's pressure";
  if (entry < layout.pressure_begin()) {
    const bool moves = entry < layout.velocity_begin();
    node = static_cast<int>((moves ? entry : entry - layout.velocity_begin()) / 2);
    field = !moves ? "blood's velocity" : layout.on_wall(node) ? "wall's displacement" : "motion of the mesh";
  } else {
    for (int n = 0; node < 0 && n < static_cast<int>(mesh.points.size()); ++n)
      if (layout.has_pressure(n) && layout.pressure(n) == entry) node = n;
  }
  const auto cell = std::find_if(mesh.cells.begin(), mesh.cells.end(), [&](const Cell& c) {
    return std::find(c.nodes.begin(), c.nodes.end(), node) != c.nodes.end();
  });
  return fmt::format("{} at {}", field, place_of(mesh, static_cast<int>(cell - mesh.cells.begin()), node));
}

std::string explain(const Assembler& assembler, const NewtonReport& report) {
  const LeastJacobian& least = assembler.least_jacobian();
  std::string text = report.failure;
  if (least.cell >= 0 && !(least.value >= compressed)) return text + compression(assembler.problem(), least);
  return report.worst ? text + "; farthest from a solution is the " + place_of(assembler, *report.worst)
                      : text;
}

std::string limit_of_wall(const radial::RingModel* ring, double pressure) {
  if (!ring || pressure <= 0) return {};
  constexpr double mmhg = 1333.22387, growth = 1.03;
  // Where pressure grows by less than this share of the growth of the stretch, it will not grow much more.
  constexpr double flat = 0.3;
  double greatest = 0, at = 1, before = 0;
  bool is_flat = false;
  try {
    for (double stretch = growth; stretch < radial::WallCurve::greatest_stretch; stretch *= growth) {
      const double p = ring->respond(stretch, {}, false).pressure;
      if (p >= pressure) return {};
      is_flat = p < before * (1 + flat * (growth - 1));
      before = p;
      if (p > greatest) {
        greatest = p;
        at = stretch;
      }
    }
  } catch (const SolverFailure&) {
    // What was found up to there counts.
  }
  if (!is_flat) return {};
  return fmt::format(
      "; the wall cannot carry {:.4g} mmHg: as a ring it carries at most {:.4g} mmHg, at lumen "
      "stretch {:.3g}",
      pressure / mmhg, greatest / mmhg, at);
}

}  // namespace tunica::axisym
