// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/element/gmsh_format.hpp"
#include "core/element/gmsh_reader.hpp"
#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/text.hpp"

namespace tunica::element {

namespace {

/// A million cells of a plane.
constexpr std::size_t largest_mesh = 200'000'000;

constexpr long most = std::numeric_limits<int>::max();
constexpr long most_tag = std::numeric_limits<long>::max();

using Width = GmshReader::Width;

constexpr const char* plane_types_remedy =
    "allowed are lines, triangles and quadrilaterals of order 1 or 2 (types 1, 8, 2, 9, 3, 16, 10) and "
    "points: mesh in two dimensions with Mesh.ElementOrder = 2 or 1";
constexpr const char* solid_types_remedy =
    "allowed are tetrahedra and hexahedra of order 1 or 2 (types 4, 11, 5, 17, 12), the faces and lines that "
    "bound them, and points: mesh in three dimensions with Mesh.ElementOrder = 2 or 1";
/// No more than two dimensions are of use, and the cells seem to have three.
constexpr const char* solid_in_plane =
    "a vessel in space, and the axisymmetric tier takes its half plane: use --tier full3d, or mesh in two "
    "dimensions (gmsh -2)";

class Parser {
 public:
  Parser(std::string_view text, const std::string& label, int dimensions)
      : all_(text), text_(text, label), dimensions_(dimensions) {
    file_.label = label;
  }

  GmshFile parse() {
    format_ = read_gmsh_format(text_);
    file_.is_old = format_.is_old;
    if (!format_.is_binary && all_.find('\0') != std::string_view::npos)
      text_.refuse("the file is said to be text but holds bytes that are none; save the mesh again");
    std::set<std::string, std::less<>> seen;
    while (!text_.at_end()) {
      const std::string_view word = text_.word();
      if (!word.starts_with('$'))
        text_.refuse(fmt::format("{} between two sections; save the mesh again", scene::in_quotes(word)));
      const std::string section(word.substr(1));
      const bool known =
          section == "PhysicalNames" || section == "Entities" || section == "Nodes" || section == "Elements";
      if (section == "PartitionedEntities") text_.refuse("the mesh is partitioned; save it in one piece");
      if (section == "ParametricNodes")
        text_.refuse("the nodes are parametric; save them as plain ones (Mesh.SaveParametric = 0)");
      if (known && !seen.insert(section).second)
        text_.refuse(fmt::format("a second section ${}; save the mesh again", section));
      text_.enter(section);
      if (!known) {
        text_.skip_section(section);
        continue;
      }
      if (section == "PhysicalNames") read_names();
      if (section == "Entities") read_entities();
      if (section == "Nodes") format_.is_old ? read_nodes() : read_node_blocks();
      if (section == "Elements") {
        if (!format_.is_old)
          read_element_blocks();
        else
          format_.is_binary ? read_elements_in_bytes() : read_elements();
      }
      text_.leave();
    }
    for (const char* needed : {"Nodes", "Elements"})
      if (!seen.contains(std::string_view(needed)))
        refuse(fmt::format("there is no section ${}; mesh the geometry before saving", needed));
    name_groups();
    resolve_nodes();
    return std::move(file_);
  }

 private:
  /// The physical tags of an element, by where they come from.
  using PhysicalTags = std::vector<long>;

  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", file_.label, why));
  }

  void read_names() {
    const long count = text_.count("the number of physical names");
    for (long k = 0; k < count; ++k) {
      const int dimension = static_cast<int>(text_.integer("the dimension of a physical name", 0, 3));
      const long tag = text_.integer("the tag of a physical name", -most, most);
      file_.physical_names.push_back({dimension, tag, text_.quoted("a physical name")});
    }
  }

  /// Sections of the new format have nothing but numbers.
  void begin_numbers() {
    if (format_.is_binary) text_.bytes_follow();
  }
  /// Tags of nodes and elements, and counts of what has them.
  long large(std::string_view what) { return text_.integer(what, 0, most_tag, Width::eight); }

  void read_entities() {
    begin_numbers();
    long counts[4];
    for (long& count : counts) count = text_.count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (long k = 0; k < counts[dimension]; ++k) {
        const long entity = text_.integer("the tag of an entity", -most, most);
        // A point's position, or a bounding box, which can be anything where it is not known.
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) text_.skip("a coordinate of an entity");
        PhysicalTags tags;
        const long physical = text_.count("the number of physical tags");
        for (long i = 0; i < physical; ++i)
          // A reversed curve is listed with a minus.
          tags.push_back(std::abs(text_.integer("a physical tag", -most, most)));
        const long bounding = dimension == 0 ? 0 : text_.count("the number of bounding entities");
        for (long i = 0; i < bounding; ++i) text_.integer("a bounding entity", -most, most);
        tags_of_entity_[{dimension, entity}] = std::move(tags);
      }
    }
  }

  void add_node(long tag, const std::array<double, 3>& position) {
    const auto place = static_cast<int>(file_.nodes.size());
    if (!place_of_node_.emplace(tag, place).second)
      text_.refuse(fmt::format("node {} is defined twice; save the mesh again", tag));
    file_.nodes.push_back({tag, position});
  }

  std::array<double, 3> read_position() {
    const bool plane = dimensions_ == 2;
    const double x = text_.real(plane ? "x (the radius)" : "x"),
                 y = text_.real(plane ? "y (the height)" : "y"), z = text_.real("z");
    return {x, y, z};
  }

  void read_nodes() {
    const long count = text_.count("the number of nodes");
    begin_numbers();
    for (long k = 0; k < count; ++k) {
      const long tag = text_.integer("the tag of a node", 0, most_tag);
      add_node(tag, read_position());
    }
  }

  void read_node_blocks() {
    begin_numbers();
    const long blocks = text_.count("the number of blocks");
    const long count = text_.count("the number of nodes");
    for (const char* end : {"the least tag", "the greatest tag"}) large(end);
    for (long k = 0; k < blocks; ++k) {
      const int dimension = static_cast<int>(text_.integer("the dimension of a block", 0, 3));
      text_.integer("the entity of a block", -most, most);
      const bool parametric = text_.integer("whether a block is parametric", 0, 1) == 1;
      const long nodes = text_.count("the number of nodes in a block");
      std::vector<long> tags;
      for (long i = 0; i < nodes; ++i) tags.push_back(large("the tag of a node"));
      for (const long tag : tags) {
        add_node(tag, read_position());
        for (int i = 0; parametric && i < dimension; ++i) text_.skip("a parameter of a node");
      }
    }
    expect_total("nodes", count, static_cast<long>(file_.nodes.size()));
  }

  void expect_total(const char* what, long announced, long found) {
    if (announced != found)
      text_.refuse(fmt::format("{} {} are announced but the blocks hold {}; save the mesh again", announced,
                               what, found));
  }

  const GmshType& type(long tag, long number) {
    const GmshType* const found = gmsh_type(number);
    constexpr int highest = 2;  // order
    if (!found || found->order > highest || found->dimension > dimensions_)
      text_.refuse(
          fmt::format("element {} has the type {}{}; {}", tag, number,
                      found && found->order > highest ? fmt::format(" of order {}", found->order) : "",
                      found && found->dimension > dimensions_ ? solid_in_plane
                      : dimensions_ == 2                      ? plane_types_remedy
                                                              : solid_types_remedy));
    return *found;
  }

  /// Node tags, which become places once all nodes are known, follow those of the elements before.
  void read_element(long tag, const GmshType& type, int group) {
    for (int i = 0; i < type.nodes; ++i) {
      const long node = text_.integer("a node of an element", 0, most_tag, node_width());
      if (is_kept(type)) node_tags_.push_back(node);
    }
    if (is_kept(type)) file_.elements.push_back({tag, type.dimension, type.corners, type.nodes, {}, group});
  }
  Width node_width() const { return format_.is_old ? Width::four : Width::eight; }

  /// Cells and what bounds them.
  bool is_kept(const GmshType& type) const { return type.dimension >= dimensions_ - 1; }

  int group_of(int dimension, const PhysicalTags& tags) {
    const auto next = static_cast<int>(tags_of_group_.size());
    const auto [found, added] = groups_.try_emplace({dimension, tags}, next);
    if (added) tags_of_group_.emplace_back(dimension, tags);
    return found->second;
  }

  /// Of format 2.2: the first is the physical one, the others are none of a physical group.
  PhysicalTags read_tags(long count) {
    PhysicalTags physical;
    for (long i = 0; i < count; ++i) {
      const long each = text_.integer("a tag of an element", -most, most);
      if (i == 0 && each != 0) physical.push_back(std::abs(each));
    }
    return physical;
  }

  void read_elements() {
    const long count = text_.count("the number of elements");
    for (long k = 0; k < count; ++k) {
      const long tag = text_.integer("the tag of an element", 0, most_tag);
      const GmshType& kind = type(tag, text_.integer("the type of an element", 0, most));
      const PhysicalTags physical = read_tags(text_.count("the number of tags of an element"));
      read_element(tag, kind, group_of(kind.dimension, physical));
    }
  }

  /// In bytes elements of a type and number of tags follow each other.
  void read_elements_in_bytes() {
    const long count = text_.count("the number of elements");
    begin_numbers();
    long found = 0;
    while (found < count) {
      const long number = text_.integer("the type of the elements of a block", 0, most);
      const long elements = text_.count("the number of elements in a block", Width::four);
      const long tags = text_.count("the number of tags of an element", Width::four);
      if (elements == 0) text_.refuse("a block of no elements; the file is damaged: save the mesh again");
      for (long i = 0; i < elements; ++i) {
        const long tag = text_.integer("the tag of an element", 0, most_tag);
        const GmshType& kind = type(tag, number);
        const PhysicalTags physical = read_tags(tags);
        read_element(tag, kind, group_of(kind.dimension, physical));
      }
      found += elements;
    }
    expect_total("elements", count, found);
  }

  void read_element_blocks() {
    begin_numbers();
    const long blocks = text_.count("the number of blocks");
    const long count = text_.count("the number of elements");
    for (const char* end : {"the least tag", "the greatest tag"}) large(end);
    long found = 0;
    for (long k = 0; k < blocks; ++k) {
      const int dimension = static_cast<int>(text_.integer("the dimension of a block", 0, 3));
      const long entity = text_.integer("the entity of a block", -most, most);
      const long number = text_.integer("the type of the elements of a block", 0, most);
      const long elements = text_.count("the number of elements in a block");
      const auto physical = tags_of_entity_.find({dimension, entity});
      const int group =
          group_of(dimension, physical == tags_of_entity_.end() ? PhysicalTags{} : physical->second);
      for (long i = 0; i < elements; ++i) {
        const long tag = large("the tag of an element");
        const GmshType& kind = type(tag, number);
        if (kind.dimension != dimension)
          text_.refuse(fmt::format("element {} of type {} in a block of dimension {}; save the mesh again",
                                   tag, number, dimension));
        read_element(tag, kind, group);
      }
      found += elements;
    }
    expect_total("elements", count, found);
  }

  void name_groups() {
    std::map<std::pair<int, long>, std::string> names;
    for (const auto& [dimension, tag, text] : file_.physical_names) names[{dimension, std::abs(tag)}] = text;
    for (const auto& [dimension, tags] : tags_of_group_) {
      GmshFile::Group group{dimension, tags, {}};
      for (const long tag : tags)
        if (const auto found = names.find({dimension, tag}); found != names.end())
          group.names.push_back(found->second);
      file_.groups.push_back(std::move(group));
    }
  }

  void resolve_nodes() {
    std::size_t next = 0;
    for (GmshFile::Element& element : file_.elements) {
      for (int i = 0; i < element.count; ++i) {
        const long tag = node_tags_[next++];
        const auto found = place_of_node_.find(tag);
        if (found == place_of_node_.end())
          refuse(
              fmt::format("element {} has the node {}, which the file does not define; save the mesh again",
                          element.tag, tag));
        element.nodes[i] = found->second;
      }
    }
  }

  std::string_view all_;
  GmshReader text_;
  int dimensions_;
  GmshFile file_;
  GmshFormat format_;
  std::map<std::pair<int, long>, PhysicalTags> tags_of_entity_;  ///< by dimension and entity
  std::map<std::pair<int, PhysicalTags>, int> groups_;
  std::vector<std::pair<int, PhysicalTags>> tags_of_group_;
  std::unordered_map<long, int> place_of_node_;
  std::vector<long> node_tags_;
};

}  // namespace

std::vector<std::string> GmshFile::names(int dimension) const {
  std::vector<std::string> found;
  for (const Name& each : physical_names)
    if (each.dimension == dimension) found.push_back(each.text);
  return found;
}

GmshFile parse_gmsh_file(std::string_view text, const std::string& label, int dimensions) {
  return Parser(text, label, dimensions).parse();
}

std::string load_gmsh(const std::filesystem::path& file) {
  return scene::load_text(file, "mesh", ".msh", largest_mesh);
}

std::string gmsh_label(const std::filesystem::path& file) {
  return fmt::format("mesh file {}", scene::one_line(file.string(), 400));
}

}  // namespace tunica::element
