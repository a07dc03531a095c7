// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/gmsh_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

namespace tunica::test_support {

namespace {

int dimension_of(const GmshModel::Element& element) {
  if (element.type == 15) return 0;
  if (element.type == 1 || element.type == 8) return 1;
  const int solid[] = {4, 5, 6, 7, 11, 12, 13, 14, 17, 18, 19, 29};
  return std::find(std::begin(solid), std::end(solid), element.type) != std::end(solid) ? 3 : 2;
}

using Group = std::pair<int, std::string>;  // dimension and name

/// Physical tags, from 1, of all groups with a name.
std::map<Group, int> groups_of(const GmshModel& model) {
  std::map<Group, int> groups;
  for (const auto& element : model.elements)
    if (!element.name.empty()) groups.emplace(Group{dimension_of(element), element.name}, 0);
  int tag = 0;
  for (auto& [group, number] : groups) number = ++tag;
  return groups;
}

std::string names_section(const std::map<Group, int>& groups) {
  std::string text = fmt::format("$PhysicalNames\n{}\n", groups.size());
  for (const auto& [group, tag] : groups)
    text += fmt::format("{} {} \"{}\"\n", group.first, tag, group.second);
  return text + "$EndPhysicalNames\n";
}

std::string old_sections(const GmshModel& model, std::map<Group, int> groups) {
  std::string text = fmt::format("$Nodes\n{}\n", model.nodes.size());
  for (const auto& node : model.nodes)
    text += fmt::format("{} {:.10g} {:.10g} {:.10g}\n", node.tag, node.x, node.y, node.z);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", model.elements.size());
  for (const auto& element : model.elements) {
    const int tag = element.name.empty() ? 0 : groups[{dimension_of(element), element.name}];
    text += fmt::format("{} {} 2 {} {} {}\n", element.tag, element.type, tag, tag + 1,
                        fmt::join(element.nodes, " "));
  }
  return text + "$EndElements\n";
}

/// An entity of its own for each group, and one without; its tag is the physical tag, 100 without.
std::string new_sections(const GmshModel& model, const std::map<Group, int>& groups) {
  std::map<std::pair<int, int>, std::vector<const GmshModel::Element*>> by_type;  // group or -1, type
  std::map<int, std::pair<int, int>> entities;  // tag: dimension, physical tag
  for (const auto& element : model.elements) {
    const int dimension = dimension_of(element);
    const auto group = groups.find({dimension, element.name});
    const int tag = group == groups.end() ? 100 + dimension : group->second;
    entities[tag] = {dimension, group == groups.end() ? 0 : tag};
    by_type[{tag, element.type}].push_back(&element);
  }
  entities.try_emplace(102, 2, 0);  // where the nodes are
  int counts[4] = {};
  for (const auto& [tag, entity] : entities) ++counts[entity.first];
  std::string text = fmt::format("$Entities\n{}\n", fmt::join(counts, " "));
  for (int dimension = 0; dimension < 4; ++dimension)
    for (const auto& [tag, entity] : entities) {
      if (entity.first != dimension) continue;
      text += fmt::format("{} {} ", tag, dimension == 0 ? "0 0 0" : "0 0 0 1 1 0");
      text += entity.second == 0 ? "0" : fmt::format("1 {}", entity.second);
      text += dimension == 0 ? "\n" : " 0\n";
    }
  text += "$EndEntities\n";
  long least = 0, greatest = 0;
  if (!model.nodes.empty()) {
    const auto by_tag = [](const auto& a, const auto& b) { return a.tag < b.tag; };
    least = std::min_element(model.nodes.begin(), model.nodes.end(), by_tag)->tag;
    greatest = std::max_element(model.nodes.begin(), model.nodes.end(), by_tag)->tag;
  }
  text += fmt::format("$Nodes\n1 {0} {1} {2}\n2 102 {3} {0}\n", model.nodes.size(), least, greatest,
                      model.parametric ? 1 : 0);
  for (const auto& node : model.nodes) text += fmt::format("{}\n", node.tag);
  for (const auto& node : model.nodes)
    text += fmt::format("{:.10g} {:.10g} {:.10g}{}\n", node.x, node.y, node.z,
                        model.parametric ? " 0.1 1e22" : "");
  text += fmt::format("$EndNodes\n$Elements\n{} {} 1 {}\n", by_type.size(), model.elements.size(),
                      model.elements.size());
  for (const auto& [key, elements] : by_type) {
    text +=
        fmt::format("{} {} {} {}\n", dimension_of(*elements.front()), key.first, key.second, elements.size());
    for (const auto* element : elements)
      text += fmt::format("{} {}\n", element->tag, fmt::join(element->nodes, " "));
  }
  return text + "$EndElements\n";
}

/// Nodes on a grid of twice as many rows and columns as cells, made when an element first needs them.
class Mesher {
 public:
  explicit Mesher(const Stenosis& shape) : shape_(shape), columns_(shape.blood_cells + shape.wall_cells) {}

  GmshModel build() {
    for (int j = 0; j < shape_.axial_cells; ++j)
      for (int i = 0; i < columns_; ++i) add_cell(2 * i, 2 * j);
    const int blood = shape_.blood_cells, rows = shape_.axial_cells;
    for (int i = 0; i < columns_; ++i) {
      const bool wall = i >= blood;
      add_line(wall ? "wall_inlet" : "inlet", 2 * i, 0, 1, 0);
      add_line(wall ? "wall_outlet" : "outlet", 2 * i, 2 * rows, 1, 0);
    }
    for (int j = 0; j < rows; ++j) {
      if (shape_.wall_cells > 0) add_line("outer", 2 * columns_, 2 * j, 0, 1);
      if (!shape_.name_inside) continue;
      if (blood > 0) add_line("axis", 0, 2 * j, 0, 1);
      add_line("interface", 2 * blood, 2 * j, 0, 1);
    }
    return std::move(model_);
  }

 private:
  long node(int i, int j) {
    const auto [found, added] = tags_.try_emplace({i, j}, static_cast<long>(model_.nodes.size()) + 1);
    if (added) {
      const double z = shape_.length * j / (2 * shape_.axial_cells), lumen = shape_.lumen(z);
      const int blood = 2 * shape_.blood_cells;
      const double r = i <= blood && blood > 0 ? lumen * i / blood
                                               : lumen + (shape_.radius + shape_.thickness - lumen) *
                                                             (i - blood) / (2 * shape_.wall_cells);
      model_.nodes.push_back({found->second, r, z, 0});
    }
    return found->second;
  }

  /// Nodes at offsets from (i, j).
  std::vector<long> nodes(int i, int j, const std::vector<std::pair<int, int>>& offsets) {
    std::vector<long> tags;
    for (const auto& [di, dj] : offsets) tags.push_back(node(i + di, j + dj));
    return tags;
  }

  void add(int type, const std::string& name, std::vector<long> tags) {
    model_.elements.push_back({static_cast<long>(model_.elements.size()) + 1, type, name, std::move(tags)});
  }

  void add_cell(int i, int j) {
    const int column = i / 2 - shape_.blood_cells;
    const std::string name = column < 0       ? "blood"
                             : shape_.layered ? fmt::format("wall:{}", column + 1)
                                              : "wall";
    using Offsets = std::vector<std::pair<int, int>>;
    if (shape_.type != triangle3 && shape_.type != triangle6) {
      Offsets offsets = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
      offsets.resize(shape_.type == quadrilateral4 ? 4 : shape_.type == quadrilateral8 ? 8 : 9);
      add(shape_.type, name, nodes(i, j, offsets));
      return;
    }
    std::vector<Offsets> halves = {{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {2, 1}, {1, 1}},
                                   {{0, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 2}, {0, 1}}};
    if ((column + j / 2) % 2 != 0)
      halves = {{{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}},
                {{2, 0}, {2, 2}, {0, 2}, {2, 1}, {1, 2}, {1, 1}}};
    for (Offsets& half : halves) {
      half.resize(shape_.type == triangle3 ? 3 : 6);
      add(shape_.type, name, nodes(i, j, half));
    }
  }

  void add_line(const std::string& name, int i, int j, int di, int dj) {
    const bool linear = shape_.type == triangle3 || shape_.type == quadrilateral4;
    std::vector<std::pair<int, int>> offsets = {{0, 0}, {2 * di, 2 * dj}, {di, dj}};
    offsets.resize(linear ? 2 : 3);
    add(linear ? 1 : 8, name, nodes(i, j, offsets));
  }

  const Stenosis& shape_;
  int columns_;
  GmshModel model_;
  std::map<std::pair<int, int>, long> tags_;
};

}  // namespace

std::string GmshModel::text(const std::string& version) const {
  const auto groups = groups_of(*this);
  std::string file = fmt::format("$MeshFormat\n{} 0 8\n$EndMeshFormat\n", version);
  if (!comment.empty()) file += fmt::format("$Comments\n{}\n$EndComments\n", comment);
  return file + names_section(groups) +
         (version == "2.2" ? old_sections(*this, groups) : new_sections(*this, groups));
}

double Stenosis::lumen(double z) const {
  const double x = (z - 0.5 * length) / width;
  return std::abs(x) < 0.5 ? radius * (1 - severity * std::pow(std::cos(std::numbers::pi * x), 2)) : radius;
}

GmshModel stenosis_mesh(const Stenosis& shape) {
  return Mesher(shape).build();
}

}  // namespace tunica::test_support
