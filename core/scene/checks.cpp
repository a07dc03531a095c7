// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scene's values against each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/scene/message.hpp"
#include "core/scene/reader.hpp"

namespace tunica {

namespace {

/// Rows of observables.csv that still fit into memory and a plot (a few gigabytes of text).
constexpr double most_rows = 5e6;
/// Fixed steps that some computer still takes within a week.
constexpr double most_steps = 1e7;
/// Pictures in fields/ that still make an animation; whether those of a mesh fit into memory is seen when it
/// is there (observables::check_output_memory).
constexpr double most_field_times = 1e4;

/// A key of the same name elsewhere, rather below the same table: a layer's stiffness for the wall's.
std::string same_name(std::string_view key, const std::vector<std::string>& keys) {
  const std::string name = fmt::format(".{}", key.substr(key.rfind('.') + 1));
  const std::string_view table = key.substr(0, key.find('.'));
  std::string best;
  for (const std::string& other : keys) {
    if (!other.ends_with(name)) continue;
    if (other.starts_with(table)) return other;
    if (best.empty()) best = other;
  }
  return best;
}

}  // namespace

void SceneReader::check() const {
  check_geometry();
  check_times();
  check_outlet();
  check_sensitivities();
}

void SceneReader::check_geometry() const {
  const double radius = scene_.number("geometry.radius");
  const double thickness = scene_.number("geometry.thickness");
  // Between these all tiers have the closed forms of a tube; no vessel is thinner, and 0D loses equilibria of
  // such walls with collagen (docs/decisions/024-thinnest-walls.md).
  constexpr double thinnest = 0.01, thickest = 10, rounding = 1e-12;
  const double ratio = thickness / radius;
  if (ratio < thinnest * (1 - rounding) || ratio > thickest * (1 + rounding))
    refuse("geometry.thickness",
           fmt::format(
               "geometry.thickness = {:g} cm is {:g} times geometry.radius = {:g} cm; allowed is {:g} to "
               "{:g} times",
               thickness, ratio, radius, thinnest, thickest));
  if (scene_.text("geometry.kind") == "mesh" && !scene_.has("geometry.file"))
    refuse("geometry.file",
           "geometry.file is missing; geometry.kind = \"mesh\" needs the name of a Gmsh file (.msh)");
  if (scene_.has("mesh.axial_cells") && scene_.integer("mesh.axial_cells") % 2 != 0)
    refuse("mesh.axial_cells",
           fmt::format("mesh.axial_cells = {} is odd; an even number puts a cell line at mid-length, try {}",
                       scene_.integer("mesh.axial_cells"), scene_.integer("mesh.axial_cells") + 1));
  if (scene_.text("geometry.kind") != "torus") return;
  const double angle = scene_.number("geometry.bend_angle") * std::numbers::pi / 180;
  const double bend_radius = scene_.number("geometry.length") / angle;
  if (bend_radius <= radius + thickness)
    refuse("geometry.bend_angle",
           fmt::format(
               "geometry.bend_angle = {:g} deg over geometry.length = {:g} cm bends with a radius of {:.4g} "
               "cm, within the artery's outer radius {:g} cm; reduce bend_angle or lengthen the artery",
               scene_.number("geometry.bend_angle"), scene_.number("geometry.length"), bend_radius,
               radius + thickness));
}

void SceneReader::check_times() const {
  const double period = scene_.number("inlet.period");
  const double total = static_cast<double>(scene_.integer("time.beats")) * period;
  if (scene_.has("inlet.duration") && scene_.number("inlet.duration") >= period)
    refuse("inlet.duration",
           fmt::format("inlet.duration = {:g} s is no shorter than inlet.period = {:g} s; reduce it",
                       scene_.number("inlet.duration"), period));
  const double step = scene_.has("time.step") ? scene_.number("time.step") : 0;
  if (step >= period)
    refuse("time.step", fmt::format("time.step = {:g} s is no shorter than the period {:g} s; reduce it, or "
                                    "write 0 for steps that follow accuracy.tolerance",
                                    step, period));
  if (step > 0 && total / step > most_steps)
    refuse("time.step",
           fmt::format("time.step = {:g} s over time.beats x inlet.period = {:g} s makes {:.3g} steps, more "
                       "than {:g}; increase it",
                       step, total, total / step, most_steps));
  const double interval = scene_.number("output.interval");
  if (interval > total)
    refuse("output.interval",
           fmt::format("output.interval = {:g} s is longer than the {:g} s computed; reduce it", interval,
                       total));
  if (total / interval > most_rows)
    refuse("output.interval",
           fmt::format(
               "output.interval = {:g} s over time.beats x inlet.period = {:g} s makes {:.3g} rows, more "
               "than {:g}; increase it",
               interval, total, total / interval, most_rows));
  const double field_interval = scene_.number("output.field_interval");
  if (field_interval > 0 && total / field_interval > most_field_times)
    refuse(
        "output.field_interval",
        fmt::format(
            "output.field_interval = {:g} s over time.beats x inlet.period = {:g} s makes {:.3g} pictures, "
            "more than {:g}; increase it, or write 0 for none",
            field_interval, total, total / field_interval, most_field_times));
  for (const double time : scene_.numbers("output.profile_times"))
    if (time >= period)
      refuse("output.profile_times",
             fmt::format(
                 "output.profile_times has {:g} s, not within a beat; allowed is 0 to less than the period "
                 "{:g} s",
                 time, period));
}

void SceneReader::check_outlet() const {
  const bool flow_given = scene_.has("inlet.flow");
  double resistance = scene_.number("outlet.resistance") + scene_.number("blood.viscosity");
  if (scene_.has("outlet.proximal_resistance")) resistance += scene_.number("outlet.proximal_resistance");
  if (!flow_given && resistance == 0)
    refuse("outlet.resistance",
           "outlet.resistance = 0 with blood.viscosity = 0 leaves nothing to limit the flow that "
           "inlet.waveform's "
           "pressure drives; give either a value > 0");
}

void SceneReader::check_fractions() const {
  double sum = 0;
  const std::size_t layers = scene_.count("wall.layers");
  for (std::size_t i = 0; i < layers; ++i) sum += scene_.number(fmt::format("wall.layers[{}].fraction", i));
  constexpr double tolerance = 1e-6;
  if (std::abs(sum - 1) > tolerance)
    refuse(fmt::format("wall.layers[{}].fraction", layers - 1),
           fmt::format("wall.layers[].fraction of the {} layers add up to {:.7g}; change them to add up to 1",
                       layers, sum));
}

void SceneReader::check_law(const std::string& prefix, const wall::LawEntry& law) const {
  if (scene_.flag("wall.incompressible") && !wall::law_reads(law, "incompressible"))
    refuse("wall.incompressible",
           fmt::format(
               "wall.incompressible = true cannot be combined with {}law = {}, which has no isochoric part; "
               "write false or choose EXP1, EXP2, EXP1+EXP2-ZS, EXP1+EXP2-FS or neo-Hookean",
               prefix, scene::in_quotes(law.name)));
  if (law.matrix != wall::Matrix::neo_hookean_compressible) return;
  const double bulk = scene_.number(prefix + "bulk_modulus");
  const double shear = scene_.number(prefix + "shear_modulus");
  if (bulk <= 2 * shear / 3)
    refuse(prefix + "bulk_modulus",
           fmt::format(
               "{0}bulk_modulus = {1:g} dyn/cm2 must be > 2/3 of {0}shear_modulus = {2:g} dyn/cm2; increase "
               "it to more than {3:g}",
               prefix, bulk, shear, 2 * shear / 3));
}

std::vector<std::string> keys_with_sensitivity(const Scene& scene) {
  const bool layered = scene.count("wall.layers") > 0;
  // Keys whose values layers and families have taken over do nothing by themselves any more. A layer's
  // fraction counts relative to their sum.
  const auto is_tied = [&](std::string_view key) {
    const std::size_t end_of_tissue = key.rfind('.') + 1;
    const std::string tissue(key.substr(0, end_of_tissue));
    const std::string_view name = key.substr(end_of_tissue);
    if (!tissue.starts_with("wall.")) return false;
    if (layered && !tissue.starts_with("wall.layers")) return name != "density";
    if (tissue.find("families") != std::string::npos) return false;
    if (name == "sharpness") return scene.text(tissue + "recruitment") == "sharp";
    return scene.count(tissue + "families") > 0 &&
           (name.starts_with("fiber_") || name.starts_with("activation_"));
  };
  std::vector<std::string> keys;
  for (const auto& [key, value] : scene.values()) {
    if (!std::holds_alternative<double>(value)) continue;
    const bool of_method = key.starts_with("output.") || key.starts_with("accuracy.") ||
                           key.starts_with("time.") || key == "inlet.period";
    if (!of_method && !is_tied(key)) keys.push_back(key);
  }
  return keys;
}

void SceneReader::check_sensitivities() const {
  const std::string list = "sensitivity.parameters";
  const std::vector<std::string> keys = keys_with_sensitivity(scene_);
  std::set<std::string> seen;
  for (const std::string& key : scene_.texts(list)) {
    if (!seen.insert(key).second)
      refuse(list, fmt::format("{} names {} twice; leave one out", list, scene::in_quotes(key)));
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string near = scene::nearest(key, keys);
    if (near.empty()) near = same_name(key, keys);
    const char* why = !scene::find_parameter(key)
                          ? "is not a key"
                          : "is no number that sensitivities are offered for in this scene";
    refuse(list, fmt::format("{} has {}, which {}{}", list, scene::in_quotes(key), why,
                             near.empty() ? "; name a number key such as outlet.resistance"
                                          : scene::did_you_mean(scene::in_quotes(near))));
  }
}

}  // namespace tunica
