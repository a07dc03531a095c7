// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <utility>

#include "core/scene/parameter.hpp"
#include "core/wall/catalog.hpp"

namespace tunica::scene {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Bounds positive(double upper) {
  return {0.0, upper, true, false};
}
Bounds from_zero(double upper) {
  return {0.0, upper, false, false};
}
Bounds between(double lower, double upper) {
  return {lower, upper, false, false};
}

Parameter number(std::string key, std::string unit, std::optional<double> value, Bounds bounds,
                 std::string meaning, std::string derived = {}) {
  Parameter parameter{std::move(key), Kind::number, std::move(unit),   {}, std::move(derived),
                      bounds,         {},           std::move(meaning)};
  if (value) parameter.default_value = *value;
  return parameter;
}

Parameter choice(std::string key, std::string value, std::vector<std::string> choices, std::string meaning) {
  return {std::move(key), Kind::choice, "", value, "", {}, std::move(choices), std::move(meaning)};
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const auto& law : wall::laws()) names.emplace_back(law.name);
  return names;
}

/// What a law may read, for the whole wall ("wall.") and again for a layer ("wall.layers[].").
void add_law_parameters(std::vector<Parameter>& all, const std::string& prefix, bool layer) {
  const auto inherited = [&](std::optional<double> value) { return layer ? std::nullopt : value; };
  const std::string derived = layer ? "the wall's" : "by law";
  Parameter law = choice(prefix + "law", "EXP1+EXP2-FS", law_names(), "Constitutive law of the tissue.");
  if (layer) {
    law.default_value.reset();
    law.derived_default = derived;
  }
  all.push_back(std::move(law));
  all.push_back(number(prefix + "bulk_modulus", "dyn/cm2", inherited(9e6), positive(1e13),
                       "Penalty kappa on volume change in U(J) = kappa/4 [(J-1)^2 + ln^2 J].",
                       layer ? derived : ""));
  all.push_back(number(prefix + "stiffness", "dyn/cm2", {}, positive(1e12),
                       "Coefficient alpha of the matrix (elastin) term: its stiffness at low strain.",
                       derived));
  all.push_back(number(prefix + "stiffening", "1", {}, positive(100),
                       "Exponent gamma of the matrix (elastin) term: how fast it stiffens.", derived));
  all.push_back(number(prefix + "fiber_stiffness", "dyn/cm2", {}, from_zero(1e12),
                       "Coefficient alpha of each collagen family.", derived));
  all.push_back(number(prefix + "fiber_stiffening", "1", {}, positive(100),
                       "Exponent gamma of each collagen family.", derived));
  all.push_back(number(prefix + "fiber_angle", "deg", {}, between(0, 90),
                       "Angle beta of the two collagen families (+beta and -beta) to the circumference.",
                       derived));
  all.push_back(number(prefix + "activation_stretch", "1", {}, between(0.5, 5),
                       "Circumferential stretch at constant length at which fibres are recruited: "
                       "a^2 = activation_stretch^2 cos^2 beta + sin^2 beta.",
                       derived));
  all.push_back(
      number(prefix + "activation_squared", "1", {}, between(0.1, 25),
             "Threshold a^2 of the squared fibre stretch, given directly; it overrides activation_stretch.",
             layer ? derived : "from activation_stretch"));
  Parameter exponent{
      prefix + "exponent",
      Kind::integer,
      "1",
      2L,
      "",
      between(1, 2),
      {},
      "Power of (I4 - a^2) in the fibre energy: 2, or 1 as the paper's text prints it (the stress "
      "then jumps at recruitment)."};
  Parameter recruitment = choice(
      prefix + "recruitment", "smooth", {"smooth", "sharp"},
      "How fibres switch on: smooth is H = atan(sharpness (I4 - a^2))/pi + 1/2, sharp its limit, a step.");
  if (layer) {
    for (Parameter* parameter : {&exponent, &recruitment}) {
      parameter->default_value.reset();
      parameter->derived_default = derived;
    }
  }
  all.push_back(std::move(exponent));
  all.push_back(std::move(recruitment));
  all.push_back(number(prefix + "sharpness", "1", inherited(5e5), between(1, 1e9),
                       "Sharpness epsilon of the smooth recruitment.", layer ? derived : ""));
  all.push_back(number(prefix + "shear_modulus", "dyn/cm2", {}, positive(1e12),
                       "Shear modulus of the neo-Hookean laws.", derived));
  all.push_back(number(prefix + "young_modulus", "dyn/cm2", {}, positive(1e12),
                       "Young's modulus of the St-Venant-Kirchhoff and linear-elastic laws.", derived));
  all.push_back(number(prefix + "poisson_ratio", "1", {}, {-1.0, 0.5, true, true},
                       "Poisson's ratio of the St-Venant-Kirchhoff and linear-elastic laws.", derived));
}

void add_family_parameters(std::vector<Parameter>& all, const std::string& prefix) {
  all.push_back(number(prefix + "angle", "deg", {}, between(-90, 90),
                       "Angle of this family to the circumference, positive towards +z.", "must be given"));
  all.push_back(number(prefix + "weight", "1", 1.0, from_zero(1e3), "Factor on this family's energy."));
  all.push_back(number(prefix + "stiffness", "dyn/cm2", {}, from_zero(1e12),
                       "Coefficient alpha of this family.", "the tissue's fiber_stiffness"));
  all.push_back(number(prefix + "stiffening", "1", {}, positive(100), "Exponent gamma of this family.",
                       "the tissue's fiber_stiffening"));
  all.push_back(number(prefix + "activation_stretch", "1", {}, between(0.5, 5),
                       "Circumferential stretch at constant length that recruits this family.",
                       "the tissue's activation_stretch"));
  all.push_back(number(prefix + "activation_squared", "1", {}, between(0.1, 25),
                       "Threshold a^2 of this family, given directly; it overrides activation_stretch.",
                       "from activation_stretch"));
}

std::vector<Parameter> declare() {
  std::vector<Parameter> all;
  all.push_back(choice("geometry.kind", "cylinder", {"cylinder", "torus", "mesh"},
                       "Shape of the artery; mesh is one of any shape, from geometry.file."));
  all.push_back({"geometry.file",
                 Kind::text,
                 "",
                 {},
                 "must be given with kind = \"mesh\"",
                 {},
                 {},
                 "Gmsh file of the artery, in space or its half plane (x = r, y = z), in cm, with the named "
                 "parts blood, wall, inlet, outlet, outer, wall_inlet and wall_outlet."});
  all.push_back(
      number("geometry.radius", "cm", 0.033, positive(10), "Inner radius R0 of the unloaded artery."));
  all.push_back(number("geometry.thickness", "cm", 0.01, positive(10), "Thickness h of the unloaded wall."));
  all.push_back(number("geometry.length", "cm", 0.66, positive(1000), "Length L along the centreline."));
  all.push_back(number("geometry.bend_angle", "deg", 180, {0, 350, true, false},
                       "Angle that the torus turns through."));
  all.push_back(
      choice("geometry.ends", "clamped", {"clamped", "sliding"},
             "Ends of the wall: clamped, or sliding (held along the axis only, free to widen, as in a "
             "longer artery). The 0D tier has no ends."));

  add_law_parameters(all, "wall.", false);
  all.push_back(number("wall.density", "g/cm3", 1.2, positive(100), "Density of the tissue, unloaded."));
  all.push_back({"wall.incompressible",
                 Kind::flag,
                 "",
                 false,
                 "",
                 {},
                 {},
                 "Exactly incompressible tissue (0D tier): bulk_modulus is then not used."});
  add_family_parameters(all, "wall.families[].");
  all.push_back(
      {"wall.layers[].name",
       Kind::text,
       "",
       std::string("layer"),
       "",
       {},
       {},
       "Name of the layer (intima, media, adventitia); layers are listed from the lumen outwards."});
  all.push_back(number("wall.layers[].fraction", "1", {}, between(1e-3, 1),
                       "Share of the wall's thickness; shares add up to 1.", "must be given"));
  add_law_parameters(all, "wall.layers[].", true);
  add_family_parameters(all, "wall.layers[].families[].");

  all.push_back(number("tether.stiffness", "dyn/cm3", 1e7, from_zero(1e12),
                       "Stiffness K of the surrounding tissue (paper eq. 19). 0 removes it."));
  all.push_back(choice(
      "tether.traction", "normal", {"normal", "reference", "current"},
      "How the tether pulls: along the current normal per current area (normal), along the displacement "
      "per reference area as the paper prints it (reference), or per current area (current)."));

  all.push_back(number("blood.density", "g/cm3", 1.0, positive(100), "Density of blood."));
  all.push_back(
      number("blood.viscosity", "g/cm/s", 0.035, from_zero(100), "Dynamic viscosity of blood (Newtonian)."));

  all.push_back(
      {"inlet.waveform",
       Kind::text,
       "",
       std::string("ica"),
       "",
       {},
       {},
       "What is prescribed at the inlet: \"ica\" (flow of the internal carotid artery), \"constant\" (flow), "
       "\"pressure\" (constant pressure), \"pulse\" (inlet.pressure for inlet.duration, then 0, once a "
       "period), or the name of a CSV file with one period of time[s] and flow[cm3/s] or pressure[dyn/cm2] "
       "(any unit of that dimension)."});
  all.push_back(number("inlet.flow", "cm3/s", {}, between(-1e5, 1e5),
                       "Mean flow of the \"ica\" and \"constant\" waveforms.",
                       "4.25 (radius/0.195)^2: the carotid's 255 ml/min scaled by lumen area"));
  all.push_back(number("inlet.pressure", "dyn/cm2", 133322.387, between(-1e7, 1e7),
                       "Pressure of the \"pressure\" and \"pulse\" waveforms."));
  all.push_back(number("inlet.duration", "s", 3e-3, positive(100), "Length of the \"pulse\" waveform."));
  all.push_back(number("inlet.period", "s", 0.8, {1e-3, 100, false, false},
                       "Length of a heart beat. A CSV waveform brings its own period."));
  all.push_back(choice("inlet.profile", "parabolic", {"parabolic", "natural"},
                       "How a flow is imposed: parabolic prescribes the velocity (of developed flow where "
                       "the inlet is no circle), natural an unknown uniform pressure that "
                       "drives the flow. The 0D tier knows no profile."));
  all.push_back(choice(
      "inlet.pressure_kind", "total", {"total", "static"},
      "What is uniform over an inlet through which a pressure drives the blood (natural profile, "
      "pressures): the total pressure p + density v^2/2 of blood that comes in, as from a wide vessel, or "
      "the static one, for which any profile of incoming blood is as good as another: such a flow may turn "
      "back on the inlet (2D and 3D tiers)."));

  all.push_back(
      choice("outlet.kind", "resistance", {"resistance", "rcr"},
             "Model of the vessels beyond the outlet: resistance, or rcr (proximal resistance, compliance, "
             "distal resistance)."));
  all.push_back(number("outlet.resistance", "dyn s/cm5", 1.032e6, from_zero(1e15),
                       "Outlet resistance R (paper eq. 18); with rcr the distal resistance."));
  all.push_back(
      number("outlet.pressure", "dyn/cm2", 0.0, between(-1e7, 1e7), "Pressure p_v beyond the resistance."));
  all.push_back(
      number("outlet.proximal_resistance", "dyn s/cm5", 1e5, from_zero(1e15), "Proximal resistance of rcr."));
  all.push_back(number("outlet.compliance", "cm5/dyn", 3e-8, positive(1), "Compliance of rcr."));

  all.push_back(
      number("outlet.backflow", "1", 0.0, between(0, 1),
             "Resistance at the outlet against blood that flows back, as a multiple of its momentum; 0.5 "
             "takes out the energy that it brings in (2D and 3D tiers)."));

  all.push_back(
      choice("time.mode", "transient", {"transient", "static"},
             "static computes one state at rest, with the waveform's pressure in the lumen (\"pressure\") "
             "or the flow at time 0 (2D and 3D tiers)."));
  all.push_back(
      {"time.beats", Kind::integer, "1", 2L, "", between(1, 1000), {}, "Number of heart beats to compute."});
  all.push_back(choice("time.start", "rest", {"rest", "static", "periodic"},
                       "Start from rest (no load, no flow), from the steady state of the inlet's value at "
                       "time 0 (static), or on the limit cycle so that every beat is alike."));
  all.push_back(number(
      "time.ramp", "s", 0.05, from_zero(10),
      "From rest, the inlet grows smoothly to its waveform, and outlet.pressure to its value, over this "
      "time: (1 - cos(pi t/ramp))/2."));

  all.push_back(choice("time.scheme", "bdf2", {"bdf2", "backward-euler", "generalized-alpha"},
                       "Time scheme of the 2D and 3D tiers."));
  all.push_back(number("time.step", "s", 0.0, from_zero(1),
                       "Fixed time step of the 2D and 3D tiers; 0 chooses steps from accuracy.tolerance."));

  all.push_back(number("accuracy.tolerance", "1", 0.01, {1e-9, 0.1, false, false},
                       "Error allowed in the observables, relative to their range."));

  all.push_back(number("output.interval", "s", 1e-3, {1e-6, 10, false, false},
                       "Time between rows of observables.csv."));
  all.push_back({"output.profile_times",
                 Kind::numbers,
                 "s",
                 std::vector<double>{0.2112, 0.6},
                 "scaled by period/0.8 s",
                 {0.0, infinity, false, true},
                 {},
                 "Times within the last beat of profiles through the wall, and of pictures too."});
  all.push_back(number("output.field_interval", "s", 0.05, from_zero(1000),
                       "Time between the pictures in fields/, which ParaView shows as an animation. 0 leaves "
                       "fields/ out."));

  all.push_back(
      choice("mesh.element", "quadratic", {"quadratic", "linear", "bubble"},
             "Elements of the 2D and 3D tiers: quadratic (pressure linear), linear (pressure stabilised), or "
             "bubble, the paper's linear ones with a bubble in the velocity (triangles)."));
  all.push_back(choice("mesh.cell", "quadrilateral", {"quadrilateral", "triangle"},
                       "Cells of the mesh that is made of a cylinder; bubble makes triangles."));
  for (const auto& [key, where] :
       {std::pair{"mesh.wall_cells", "through the wall"},
        std::pair{"mesh.blood_cells",
                  "from the axis (3D: from the core of the lumen's mesh, of half the radius) to the wall"},
        std::pair{"mesh.axial_cells", "along the artery, an even number"}})
    all.push_back({key,
                   Kind::integer,
                   "1",
                   {},
                   "from accuracy.tolerance",
                   between(1, 4000),
                   {},
                   fmt::format("Number of cells {} of the 2D and 3D tiers.", where)});
  all.push_back({"mesh.around_cells",
                 Kind::integer,
                 "1",
                 {},
                 "from accuracy.tolerance",
                 between(8, 4000),
                 {},
                 "Number of cells around the artery, a multiple of 8 (3D tier)."});
  all.push_back(
      choice("mesh.symmetry", "auto", {"auto", "full", "half", "quarter"},
             "Part of the artery that the 3D tier meshes, the rest being its mirror image: auto takes the "
             "least that the artery and its fibres allow."));
  all.push_back(
      {"mesh.mixed_wall",
       Kind::flag,
       "",
       true,
       "",
       {},
       {},
       "Interpolate the pressure in the wall on its own, so that nearly incompressible tissue does not lock "
       "(2D and 3D tiers)."});
  all.push_back(
      {"mesh.motion",
       Kind::choice,
       "",
       {},
       "sectional for own quadrilaterals in 2D, two or more across the blood; else harmonic",
       {},
       {"harmonic", "sectional", "stiffened"},
       "How the mesh in the blood follows the wall: harmonic, section by section, each point keeping its "
       "share of the way to the wall, which bears larger motion (own quadrilaterals in 2D, a cylinder in "
       "3D), or harmonic with small cells made stiffer."});

  all.push_back(
      choice("solver.method", "auto", {"auto", "direct", "schwarz", "block"},
             "How the 3D tier solves its linear systems: direct factorises (MUMPS), schwarz is GMRES "
             "with additive Schwarz, block GMRES with a preconditioner by fields; auto is direct up "
             "to 300,000 unknowns and block beyond."));
  all.push_back(
      choice("solver.geometry", "implicit", {"implicit", "lagged"},
             "How the mesh in the blood moves within a step: implicit solves for it together with all else, "
             "lagged takes it from the steps before, which leaves fewer unknowns (2D and 3D tiers)."));
  all.push_back({"solver.options",
                 Kind::text,
                 "",
                 {},
                 "none",
                 {},
                 {},
                 "PETSc options of the 3D tier, such as \"-ksp_rtol 1e-8\", over those of solver.method."});

  all.push_back({"lumped.compartments",
                 Kind::integer,
                 "1",
                 1L,
                 "",
                 between(1, 200),
                 {},
                 "Number of compartments in series along the artery (0D tier)."});
  all.push_back({"lumped.inertance",
                 Kind::flag,
                 "",
                 false,
                 "",
                 {},
                 {},
                 "Include the inertia of blood between compartments (0D tier)."});

  all.push_back({"sensitivity.parameters",
                 Kind::texts,
                 "",
                 std::vector<std::string>{},
                 "",
                 {},
                 {},
                 "Keys of number parameters, for example \"outlet.resistance\": forward sensitivities of the "
                 "observables and of the recruitment times are written for each (0D and 2D tiers)."});
  return all;
}

}  // namespace

std::span<const Parameter> parameters() {
  static const std::vector<Parameter> all = declare();
  return all;
}

}  // namespace tunica::scene
