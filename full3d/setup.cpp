// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/coupled/gmsh_parts.hpp"
#include "core/coupled/sectional_motion.hpp"
#include "core/coupled/wall_strain.hpp"
#include "core/error.hpp"
#include "core/radial/from_scene.hpp"
#include "full3d/gmsh.hpp"
#include "full3d/inlet_profile.hpp"
#include "full3d/layout.hpp"
#include "full3d/measures.hpp"
#include "full3d/refusal.hpp"
#include "full3d/solver_options.hpp"
#include "full3d/tables.hpp"

namespace tunica::full3d {

namespace {

/// Coordinates that are normal to the inlet and the outlet, -1 where none is.
struct EndAxes {
  int inlet = 2, outlet = 2;
};

EndAxes end_axes(const Setup& setup) {
  if (!setup.axes) return {2, setup.shape.bend_angle == 0 ? 2 : -1};
  const Mesh& mesh = setup.problem.mesh;
  const bool blood = mesh.has(Part::blood);
  // What slides or is led goes along planes or lines that are off by this angle.
  constexpr double aligned = 1e-2;
  return {normal_axis(mesh, blood ? Boundary::inlet : Boundary::wall_inlet, aligned),
          normal_axis(mesh, blood ? Boundary::outlet : Boundary::wall_outlet, aligned)};
}

/// Sections move by unknowns here. The exponent k of the shares is the rate of the fall off the wall times
/// the radius, and what a section widens by, per area, is 2 u_r/R. Multigrid does not solve for what falls
/// off within a cell.
void set_motion(const Scene& scene, Setup& setup) {
  Problem& problem = setup.problem;
  if (!problem.mesh.has(Part::blood)) return;
  problem.discretisation.motion = coupled::mesh_motion_of(scene, false);
  if (problem.discretisation.motion != coupled::MeshMotion::sectional) return;
  const int rows = rows_of(problem, layout_of(problem));
  if (method_for(scene.text("solver.method"), rows) != "direct")
    throw InvalidInput(
        fmt::format("mesh.motion = \"sectional\" takes factors, and with {} unknowns solver.method = "
                    "\"auto\" iterates; write \"direct\", or mesh.motion = \"harmonic\"",
                    rows));
  const VesselShape shape = setup.shape;
  const auto is_clamped = [&](Boundary end) {
    const auto& held = problem.on(end).displacement;
    return held[0] && held[1] && held[2];
  };
  const coupled::SectionalMotion motion{0, shape.length, is_clamped(Boundary::inlet),
                                        is_clamped(Boundary::outlet)};
  problem.sections = [shape, motion](const Point& point) {
    const double s = shape.local(point).s, power = motion.power_at(shape.radius, s);
    return physics::MotionInSections{shape.axes(0, s).axial, std::pow(power / shape.radius, 2),
                                     0.5 * shape.radius * motion.lean_at(shape.radius, s)};
  };
}

void set_ends(const Scene& scene, Setup& setup) {
  Problem& problem = setup.problem;
  const bool clamped = scene.text("geometry.ends") == "clamped";
  const EndAxes axes = end_axes(setup);
  if (!clamped && (axes.inlet < 0 || axes.outlet < 0))
    throw InvalidInput(
        "geometry.ends = \"sliding\" lets the ends slide in planes across the coordinate axes, in which "
        "those of "
        "a torus are not, nor those of this mesh; write \"clamped\", or geometry.kind = \"cylinder\"");
  if (!clamped && setup.axes)
    for (const Boundary boundary :
         {Boundary::wall_inlet, Boundary::wall_outlet, Boundary::inlet, Boundary::outlet})
      if (problem.mesh.has(Part::blood) || boundary == Boundary::wall_inlet ||
          boundary == Boundary::wall_outlet)
        coupled::check_sliding(boundary, inclination(surface(problem.mesh, boundary)),
                               scene.number("accuracy.tolerance"));
  const auto hold = [&](Boundary boundary, int axis) {
    auto& held = problem.on(boundary).displacement;
    held = {clamped, clamped, clamped};
    if (axis >= 0) held[axis] = true;
  };
  for (const Boundary boundary : {Boundary::inlet, Boundary::wall_inlet}) hold(boundary, axes.inlet);
  for (const Boundary boundary : {Boundary::outlet, Boundary::wall_outlet}) hold(boundary, axes.outlet);
  // Blood comes in along the axis (paper, 2.3). Where it may also come in from the side, its momentum makes
  // the pressure condition unstable. A section that is free to widen stands for one within a longer artery.
  const auto lead = [&](Boundary boundary, int axis) {
    auto& led = problem.on(boundary).velocity;
    led = {true, true, true};
    led[axis] = false;
  };
  if (axes.inlet >= 0) lead(Boundary::inlet, axes.inlet);
  if (!clamped) lead(Boundary::outlet, axes.outlet);
}

double parabola(const Point& place, double radius) {
  return 1 - (place[0] * place[0] + place[1] * place[1]) / (radius * radius);
}

/// Flow of the parabola 1 - (r/R)^2 as the element interpolates it at the inlet: less than pi R^2/2, as
/// faces end within the circle.
double parabola_flux(const Problem& problem, double radius) {
  const Mesh& mesh = problem.mesh;
  const Basis basis = displacement_basis(problem.discretisation.element);
  double flux = 0;
  for (const Face& face : mesh.faces) {
    if (face.boundary != Boundary::inlet) continue;
    const auto rule = element::solid::face_rule(mesh.shape, basis, face.face);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto shapes = element::solid::shapes_at(mesh.shape, basis, rule.points[q]);
      const Image at = image(mesh, face.cell, rule.points[q]);
      Vector<double> along[2] = {};
      for (int s = 0; s < 2; ++s)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < 3; ++c) along[s][i] += at.slope[i][c] * rule.directions[s][c];
      double value = 0;
      for (int k = 0; k < shapes.count; ++k)
        value += shapes.value[k] * parabola(mesh.points[mesh.node(face.cell, basis, k)], radius);
      const Vector<double> area = cross(along[0], along[1]);
      flux += rule.weights[q] * value * std::sqrt(dot(area, area));
    }
  }
  return problem.copies * flux;
}

void set_inlet(const Scene& scene, Setup& setup) {
  Problem& problem = setup.problem;
  const Setup* const here = &setup;
  if (!coupled::needs_profile(scene, setup, problem.inlet)) {
    if (end_axes(setup).inlet < 0)
      throw InvalidInput(
          "geometry.file: the inlet's normal is along none of the coordinates, which blood that comes in by "
          "itself "
          "needs to be led along; turn the mesh, or prescribe a flow with inlet.profile = \"parabolic\"");
    return;
  }
  problem.on(Boundary::inlet).velocity = {true, true, true};
  if (setup.axes) {
    problem.velocity = [here, profile = InletProfile(problem.mesh, scene.number("accuracy.tolerance"))](
                           const Point& place, double time) {
      Vector<double> velocity = profile.at(place);
      for (double& component : velocity) component *= here->inlet_value(time);
      return velocity;
    };
    return;
  }
  const double radius = setup.shape.radius, peak = 1 / parabola_flux(problem, radius);
  problem.velocity = [here, radius, peak](const Point& place, double time) -> Vector<double> {
    // The inlet lies in the plane z = 0, and nothing else of the lumen does.
    if (std::abs(place[2]) > 1e-9 * radius) return {};
    return {0, 0, here->inlet_value(time) * peak * parabola(place, radius)};
  };
}

coupled::Tube tube_of(const Scene& scene, const Setup& setup) {
  const VesselShape& shape = setup.shape;
  return {shape.radius, shape.thickness, shape.length, scene.text("geometry.ends") == "clamped",
          [&shape, &mesh = setup.problem.mesh](int node) -> coupled::Tube::Place {
            const VesselShape::Local at = shape.local(mesh.points[node]);
            const auto axes = shape.axes(std::atan2(at.y, at.x), at.s);
            return {at.s, std::hypot(at.x, at.y), cross(axes.circumferential, axes.axial), axes.axial};
          }};
}

/// The mesh of geometry.file, with blood if it is wanted and there.
Mesh given_mesh(const Scene& scene, bool with_blood) {
  const auto file = scene.folder() / scene.text("geometry.file");
  const Mesh mesh = read_gmsh(file);
  const Element element = coupled::element_of(scene);
  if (element == Element::bubble && mesh.shape != Shape::tetrahedron)
    throw InvalidInput(fmt::format(
        "{}: mesh.element = \"bubble\" needs tetrahedra, and this mesh has hexahedra; mesh it with "
        "tetrahedra, or write mesh.element = \"quadratic\"",
        file.string()));
  coupled::check_unit(inlet_radius(mesh), {scene.number("geometry.radius"), file.string()});
  return adapted(mesh, element, with_blood);
}

/// Throws InvalidInput for a wall with fibres where the mesh leaves their directions open.
void check_fibers(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const auto rule = element::solid::cell_rule(mesh.shape, displacement_basis(problem.discretisation.element));
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != Part::wall) continue;
    const auto& law = problem.laws[mesh.cells[cell].layer];
    if (wall::families(law).empty()) continue;
    for (const auto& local : rule.points) {
      const Point at = image(mesh, cell, local).point;
      if (coupled::lacks_directions(law, problem.directions(cell, local, at)))
        coupled::refuse_fibers(
            fmt::format("wall cell at x = {:.6g}, y = {:.6g}, z = {:.6g} cm", at[0], at[1], at[2]),
            problem.discretisation.element);
    }
  }
}

}  // namespace

std::unique_ptr<Setup> setup_of(const Scene& scene) {
  return setup_of(scene, resolution(scene));
}

std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution) {
  auto setup = std::make_unique<Setup>();
  coupled::set_source(scene, *setup);
  setup->resolution = resolution;
  const Setup* const here = setup.get();
  Problem& problem = setup->problem;
  std::unique_ptr<const radial::RingModel> rings[2];  // of which one is for the curve
  if (scene.text("geometry.kind") == "mesh") {
    problem.mesh = given_mesh(scene, coupled::needs_blood(scene, *setup));
    const MeanTube tube = mean_tube(problem.mesh);
    setup->shape = {tube.radius, tube.thickness, tube.length, 0};
    setup->axes = std::make_unique<const WallAxes>(problem.mesh);
    problem.directions = [here](int cell, const element::solid::Local& local, const Point&) {
      return here->axes->at(cell, local);
    };
    for (auto& ring : rings) ring = coupled::ring_of(scene, tube.radius, tube.thickness);
  } else {
    const VesselSpec spec = vessel_spec(scene, resolution, coupled::needs_blood(scene, *setup));
    setup->sector = spec.sector;
    setup->shape = {spec.radius, scene.number("geometry.thickness"), spec.length, spec.bend_angle};
    problem.mesh = o_grid_vessel(spec);
    problem.directions = [here](int, const element::solid::Local&, const Point& place) {
      return here->shape.axes(place);
    };
    for (auto& ring : rings) ring = radial::ring_model(scene, {});
    // A bend straightens under pressure, which the estimate of a tube misses by too much to lead anywhere.
    if (spec.bend_angle == 0) setup->tube = tube_of(scene, *setup);
  }
  const bool with_blood = problem.mesh.has(Part::blood);
  coupled::set_conditions(scene, *setup, problem);
  coupled::check_layers(problem.mesh.layers(), problem.laws.size());
  if (setup->axes) check_fibers(problem);
  problem.copies = setup->sector == Sector::quarter ? 4 : setup->sector == Sector::half ? 2 : 1;
  setup->wall_density = problem.wall_density;
  set_ends(scene, *setup);
  set_motion(scene, *setup);
  setup->lumen_radius = setup->shape.radius;
  setup->ring = std::move(rings[0]);
  if (with_blood) {
    set_inlet(scene, *setup);
  } else {
    coupled::require_pressure(setup->inlet.is_pressure);
    problem.lumen_pressure = [here](double time) { return here->inlet_value(time); };
  }
  coupled::estimate_sizes(scene, std::move(rings[1]), *setup);
  coupled::set_steady_state(problem, with_blood, *setup);
  return setup;
}

}  // namespace tunica::full3d
