// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/gmsh_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica::coupled {

using element::GmshFile;

namespace {

constexpr int no_layers = -1;  // a wall that is not divided

/// What Gmsh calls a group of cells of a dimension.
const char* noun(int dimension) {
  return dimension == 1 ? "curve" : dimension == 2 ? "surface" : "volume";
}

[[noreturn]] void refuse(const GmshFile& file, const std::string& why) {
  throw InvalidInput(fmt::format("{}: {}", file.label, why));
}

std::optional<Membership> part_named(std::string_view text) {
  if (text == "blood") return Membership{Part::blood, 0};
  if (text == "wall") return Membership{Part::wall, no_layers};
  constexpr std::string_view prefix = "wall:";
  if (!text.starts_with(prefix)) return {};
  text.remove_prefix(prefix.size());
  constexpr int most_layers = 100;
  int layer = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), layer);
  if (error != std::errc{} || end != text.data() + text.size() || layer < 1 || layer > most_layers) return {};
  return Membership{Part::wall, layer - 1};
}

std::optional<Boundary> boundary_named(std::string_view text) {
  for (const Boundary each : {Boundary::axis, Boundary::inlet, Boundary::outlet, Boundary::interface,
                              Boundary::outer, Boundary::wall_inlet, Boundary::wall_outlet})
    if (name(each) == text) return each;
  return {};
}

/// Physical groups of a dimension that elements are in, as "physical surfaces 3, 4, 5"; empty if there are
/// none.
std::string groups_in_use(const GmshFile& file, int dimension) {
  std::set<long> tags;
  for (const GmshFile::Group& group : file.groups)
    if (group.dimension == dimension) tags.insert(group.tags.begin(), group.tags.end());
  if (tags.empty()) return {};
  constexpr std::size_t most = 12;
  std::vector<long> shown(tags.begin(), tags.end());
  shown.resize(std::min(shown.size(), most));
  return fmt::format("physical {}{} {}{}", noun(dimension), tags.size() > 1 ? "s" : "",
                     fmt::join(shown, ", "), tags.size() > most ? ", ..." : "");
}

/// What a file that names no cells has instead.
std::string found_instead(const GmshFile& file, int dimension) {
  std::vector<std::string> groups;
  for (const int each : {dimension, dimension - 1})
    if (std::string text = groups_in_use(file, each); !text.empty()) groups.push_back(std::move(text));
  const std::string found =
      groups.empty() ? "no physical groups" : fmt::format("{}", fmt::join(groups, " and "));
  constexpr std::size_t most = 12;
  std::vector<std::string> names;
  for (const GmshFile::Name& name : file.physical_names)
    if (names.size() < most) names.push_back(scene::in_quotes(name.text));
  if (names.empty()) return fmt::format("{}, and no names", found);
  return fmt::format("{}, and the names {}{}", found, fmt::join(names, ", "),
                     file.physical_names.size() > most ? ", ..." : "");
}

}  // namespace

void check_named(const GmshFile& file, int dimension) {
  bool any_tags = false;
  for (const GmshFile::Group& group : file.groups) {
    if (group.dimension == dimension && !group.names.empty()) return;
    any_tags = any_tags || !group.tags.empty();
  }
  const std::string found = found_instead(file, dimension);
  if (!file.names(dimension).empty() && !any_tags && file.is_old)
    refuse(file, fmt::format(
                     "the file has {}, but no element is in a group: Gmsh leaves them out of format 2.2 with "
                     "Mesh.SaveAll = 1; save it with Mesh.SaveAll = 0, or with Mesh.MshFileVersion = 4.1",
                     found));
  refuse(
      file,
      fmt::format("no physical {0} that has cells has a name; the file has {1}: name the {0}s \"blood\" and "
                  "\"wall\" (or \"wall:1\", \"wall:2\", ...), as in Physical {2}(\"wall\") = {{2}};, and the "
                  "{3}s \"inlet\" and \"outlet\" of the blood, \"outer\", \"wall_inlet\" and "
                  "\"wall_outlet\" of the wall",
                  noun(dimension), found, dimension == 3 ? "Volume" : "Surface", noun(dimension - 1)));
}

Membership membership_of(const GmshFile& file, const GmshFile::Element& element, const std::string& cell) {
  const std::vector<std::string>& group = file.groups[element.group].names;
  const char* const kind = noun(element.dimension);
  const std::string remedy = fmt::format(
      "put each {0} into one physical {0} \"blood\", \"wall\" or \"wall:1\", \"wall:2\", ... from "
      "the lumen outwards",
      kind);
  if (group.empty()) refuse(file, fmt::format("{} is in no named part; {}", cell, remedy));
  if (group.size() > 1)
    refuse(file, fmt::format("{} is in {} parts, {} and {}; {}", cell, group.size(),
                             scene::in_quotes(group[0]), scene::in_quotes(group[1]), remedy));
  const auto found = part_named(group.front());
  if (!found) {
    const std::vector<std::string> known = {"blood", "wall", "wall:1", "wall:2"};
    refuse(file, fmt::format("the physical {} {} is unknown; {}{}", kind, scene::in_quotes(group.front()),
                             remedy, scene::did_you_mean(scene::nearest(group.front(), known))));
  }
  return *found;
}

void check_parts(const GmshFile& file, int dimension, std::span<Membership> cells) {
  bool whole = false;
  std::vector<bool> layers;
  for (const Membership& cell : cells) {
    if (cell.part == Part::blood) continue;
    whole = whole || cell.layer == no_layers;
    if (cell.layer >= static_cast<int>(layers.size())) layers.resize(cell.layer + 1);
    if (cell.layer >= 0) layers[cell.layer] = true;
  }
  if (whole && !layers.empty())
    refuse(file, "the wall is partly \"wall\" and partly \"wall:1\", ...; name all of its layers, or none");
  const auto missing = std::find(layers.begin(), layers.end(), false);
  if (missing != layers.end())
    refuse(file, fmt::format(
                     "the wall has {} layers but no cell in \"wall:{}\"; number the layers from 1, from the "
                     "lumen outwards",
                     layers.size(), missing - layers.begin() + 1));
  for (Membership& cell : cells) cell.layer = std::max(cell.layer, 0);
  for (const std::string& name : file.names(dimension)) {
    const auto found = part_named(name);
    if (found && std::none_of(cells.begin(), cells.end(),
                              [&](const Membership& cell) { return cell.part == found->part; }))
      refuse(file, fmt::format("the physical {0} \"{1}\" has no cells; mesh its {0}, or remove the name",
                               noun(dimension), name));
  }
}

std::optional<Boundary> boundary_of(const GmshFile& file, const GmshFile::Element& element) {
  std::optional<Boundary> boundary;
  for (const std::string& each : file.groups[element.group].names) {
    const auto found = boundary_named(each);
    if (!found) continue;
    if (boundary && boundary != found)
      refuse(file, fmt::format("{} {} is both \"{}\" and \"{}\"; give each {} one of these names",
                               element.dimension == 1 ? "line" : "face", element.tag, name(*boundary),
                               name(*found), noun(element.dimension)));
    boundary = found;
  }
  return boundary;
}

void check_boundaries_named(const GmshFile& file, int dimension, bool blood, bool wall) {
  std::set<std::string, std::less<>> used;
  for (const GmshFile::Element& element : file.elements)
    if (element.dimension == dimension)
      used.insert(file.groups[element.group].names.begin(), file.groups[element.group].names.end());
  const auto need = [&](Boundary boundary, const char* what) {
    const std::string_view wanted = name(boundary);
    if (used.contains(wanted)) return;
    std::vector<std::string> others;
    for (const std::string& each : used)
      if (!boundary_named(each)) others.push_back(each);
    const std::string near = scene::nearest(wanted, others);
    refuse(file,
           fmt::format("there is no physical {} \"{}\"; give this name to {}{}", noun(dimension), wanted,
                       what, near.empty() ? "" : fmt::format(" (now {}?)", scene::in_quotes(near))));
  };
  const bool plane = dimension == 1;
  if (blood) {
    need(Boundary::inlet, plane ? "the lower end of the blood" : "the end where blood comes in");
    need(Boundary::outlet, plane ? "the upper end of the blood" : "the end where blood goes out");
  }
  if (wall) {
    need(Boundary::outer, "the outer surface of the wall");
    need(Boundary::wall_inlet, plane ? "the lower end of the wall" : "the end of the wall around the inlet");
    need(Boundary::wall_outlet,
         plane ? "the upper end of the wall" : "the end of the wall around the outlet");
  }
}

void check_layers(int of_mesh, std::size_t of_scene) {
  if (of_mesh == static_cast<int>(of_scene)) return;
  throw InvalidInput(fmt::format(
      "geometry.file has {} layer{} of the wall, the scene describes {}; give each layer of the mesh its "
      "[[wall.layers]], and no more",
      of_mesh, of_mesh == 1 ? "" : "s", of_scene));
}

void check_sliding(Boundary boundary, double inclination, double tolerance) {
  if (!(inclination > tolerance)) return;
  throw InvalidInput(
      fmt::format("geometry.ends = \"sliding\" lets the {} slide in its plane, but it is inclined to that by "
                  "{:.3g} (root mean square), and accuracy.tolerance allows {:g}; draw it flat, write "
                  "\"clamped\", or a larger tolerance",
                  name(boundary), inclination, tolerance));
}

void require_pressure(bool is_pressure) {
  if (is_pressure) return;
  throw InvalidInput(
      "geometry.file has a wall without blood, which takes a pressure and no flow; write inlet.waveform = "
      "\"pressure\", \"pulse\" or a .csv file with a pressure");
}

void check_unit(double inlet_radius, const Expected& expected) {
  struct Unit {
    double per_cm;
    const char* text;
  };
  constexpr Unit units[] = {{10, "millimetres"}, {0.01, "metres"}, {1e4, "micrometres"}};
  // A radius is measured at one end of the mesh and given for all of it: a quarter more or less is no other
  // unit.
  constexpr double most = 50, about = 0.25;
  const double ratio = inlet_radius / expected.radius;
  const bool in_mm = std::abs(std::log(ratio / 10)) < std::log1p(about);
  if (ratio <= most && ratio >= 1 / most && !in_mm) return;
  // The unit that brings the two radii closest together, if any does.
  const Unit* likely = nullptr;
  double distance = std::log(3.0);
  for (const Unit& unit : units) {
    const double off = std::abs(std::log(ratio / unit.per_cm));
    if (off >= distance) continue;
    distance = off;
    likely = &unit;
  }
  const std::string remedy =
      likely ? fmt::format("it is probably in {}: scale it by {:g} (Mesh.ScalingFactor)", likely->text,
                           1 / likely->per_cm)
             : fmt::format("meshes are in cm: scale it by {:.3g} (Mesh.ScalingFactor)", 1 / ratio);
  throw InvalidInput(
      fmt::format("{}: the radius at the inlet is {:.4g} cm, {:.4g} times geometry.radius = {:g} cm; {}, "
                  "or set geometry.radius to the radius meant",
                  expected.label, inlet_radius, ratio, expected.radius, remedy));
}

std::optional<std::string> radius_remark(double inlet_radius, const Scene& scene) {
  const double given = scene.number("geometry.radius");
  constexpr double near = 2, mm_per_cm = 10, about = 1.25;
  const double ratio = inlet_radius / given;
  if (ratio <= near && ratio >= 1 / near) return std::nullopt;
  const double in_mm = ratio * mm_per_cm;
  const bool typed_in_mm = in_mm < about && in_mm > 1 / about;
  return fmt::format(
      "geometry.radius = {:g} cm, which the default of inlet.flow is made of, is not that of the mesh, "
      "{:.4g} cm at "
      "the inlet{}",
      given, inlet_radius,
      scene::did_you_mean(typed_in_mm ? scene::in_quotes(fmt::format("{:g} mm", given)) : ""));
}

}  // namespace tunica::coupled
