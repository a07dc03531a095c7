// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "core/element/gmsh_text.hpp"
#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/text.hpp"

namespace tunica::element {

namespace {

/// A million cells of a plane.
constexpr std::size_t largest_mesh = 200'000'000;

constexpr long most = std::numeric_limits<int>::max();
constexpr long most_tag = std::numeric_limits<long>::max();

/// Gmsh's types that can be read, and those that meshes of other orders or dimensions are likely to hold.
struct Type {
  int number, dimension, corners, nodes;
};
constexpr Type types[] = {{15, 0, 1, 1}, {1, 1, 2, 2},   {8, 1, 2, 3},  {2, 2, 3, 3}, {9, 2, 3, 6},
                          {3, 2, 4, 4},  {16, 2, 4, 8},  {10, 2, 4, 9}, {4, 3, 4, 4}, {11, 3, 4, 10},
                          {5, 3, 8, 8},  {17, 3, 8, 20}, {12, 3, 8, 27}};
constexpr const char* plane_types_remedy =
    "allowed are lines, triangles and quadrilaterals of order 1 or 2 (types 1, 8, 2, 9, 3, 16, 10) and "
    "points: mesh in two dimensions with Mesh.ElementOrder = 2 or 1";
constexpr const char* solid_types_remedy =
    "allowed are tetrahedra and hexahedra of order 1 or 2 (types 4, 11, 5, 17, 12), the faces and lines that "
    "bound them, and points: mesh in three dimensions with Mesh.ElementOrder = 2 or 1";

class Parser {
 public:
  Parser(std::string_view text, const std::string& label, int dimensions)
      : text_(text, label), dimensions_(dimensions) {
    file_.label = label;
  }

  GmshFile parse() {
    if (text_.word() != "$MeshFormat")
      text_.refuse("does not begin with $MeshFormat; it is no Gmsh mesh: save one as *.msh");
    text_.enter("MeshFormat");
    read_format();
    text_.leave();
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
      if (section == "Nodes") version_four_ ? read_node_blocks() : read_nodes();
      if (section == "Elements") version_four_ ? read_element_blocks() : read_elements();
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

  void read_format() {
    const std::string version(text_.word());
    if (version != "2.2" && version != "4.1")
      text_.refuse(fmt::format("format {}; allowed are 2.2 and 4.1: save with Mesh.MshFileVersion = 4.1",
                               scene::in_quotes(version)));
    version_four_ = version == "4.1";
    if (text_.integer("the file type", 0, most) != 0)
      text_.refuse("the mesh is binary; save it as ASCII (Mesh.Binary = 0)");
    text_.integer("the size of a number", 1, most);
  }

  void read_names() {
    const long count = text_.count("the number of physical names");
    for (long k = 0; k < count; ++k) {
      const int dimension = static_cast<int>(text_.integer("the dimension of a physical name", 0, 3));
      const long tag = text_.integer("the tag of a physical name", -most, most);
      file_.physical_names.push_back({dimension, tag, text_.quoted("a physical name")});
    }
  }

  void read_entities() {
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
    for (long k = 0; k < count; ++k) {
      const long tag = text_.integer("the tag of a node", 0, most_tag);
      add_node(tag, read_position());
    }
  }

  void read_node_blocks() {
    const long blocks = text_.count("the number of blocks");
    const long count = text_.count("the number of nodes");
    for (const char* end : {"the least tag", "the greatest tag"}) text_.integer(end, 0, most_tag);
    for (long k = 0; k < blocks; ++k) {
      const int dimension = static_cast<int>(text_.integer("the dimension of a block", 0, 3));
      text_.integer("the entity of a block", -most, most);
      const bool parametric = text_.integer("whether a block is parametric", 0, 1) == 1;
      const long nodes = text_.count("the number of nodes in a block");
      std::vector<long> tags;
      for (long i = 0; i < nodes; ++i) tags.push_back(text_.integer("the tag of a node", 0, most_tag));
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

  const Type& type(long tag, long number) {
    const auto found = std::find_if(std::begin(types), std::end(types), [&](const Type& t) {
      return t.number == number && t.dimension <= dimensions_;
    });
    if (found == std::end(types))
      text_.refuse(fmt::format("element {} has the type {}; {}", tag, number,
                               dimensions_ == 2 ? plane_types_remedy : solid_types_remedy));
    return *found;
  }

  /// Node tags, which become places once all nodes are known, follow those of the elements before.
  void read_element(long tag, const Type& type, int group) {
    for (int i = 0; i < type.nodes; ++i) {
      const long node = text_.integer("a node of an element", 0, most_tag);
      if (is_kept(type)) node_tags_.push_back(node);
    }
    if (is_kept(type)) file_.elements.push_back({tag, type.dimension, type.corners, type.nodes, {}, group});
  }

  /// Cells and what bounds them.
  bool is_kept(const Type& type) const { return type.dimension >= dimensions_ - 1; }

  int group_of(int dimension, const PhysicalTags& tags) {
    const auto next = static_cast<int>(tags_of_group_.size());
    const auto [found, added] = groups_.try_emplace({dimension, tags}, next);
    if (added) tags_of_group_.emplace_back(dimension, tags);
    return found->second;
  }

  void read_elements() {
    const long count = text_.count("the number of elements");
    for (long k = 0; k < count; ++k) {
      const long tag = text_.integer("the tag of an element", 0, most_tag);
      const Type& kind = type(tag, text_.integer("the type of an element", 0, most));
      const long tags = text_.count("the number of tags of an element");
      PhysicalTags physical;
      for (long i = 0; i < tags; ++i) {
        const long each = text_.integer("a tag of an element", -most, most);
        if (i == 0 && each != 0) physical.push_back(std::abs(each));
      }
      read_element(tag, kind, group_of(kind.dimension, physical));
    }
  }

  void read_element_blocks() {
    const long blocks = text_.count("the number of blocks");
    const long count = text_.count("the number of elements");
    for (const char* end : {"the least tag", "the greatest tag"}) text_.integer(end, 0, most_tag);
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
        const long tag = text_.integer("the tag of an element", 0, most_tag);
        const Type& kind = type(tag, number);
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
      std::vector<std::string> group;
      for (const long tag : tags)
        if (const auto found = names.find({dimension, tag}); found != names.end())
          group.push_back(found->second);
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

  GmshText text_;
  int dimensions_;
  GmshFile file_;
  bool version_four_ = false;
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
  if (text.find('\0') != std::string_view::npos)
    throw InvalidInput(fmt::format("{}: the mesh is binary; save it as ASCII (Mesh.Binary = 0)", label));
  return Parser(text, label, dimensions).parse();
}

std::string load_gmsh(const std::filesystem::path& file) {
  return scene::load_text(file, "mesh", ".msh", largest_mesh);
}

std::string gmsh_label(const std::filesystem::path& file) {
  return fmt::format("mesh file {}", scene::one_line(file.string(), 400));
}

int gmsh_dimensions(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line) && !line.starts_with("$PhysicalNames"))
    if (line.starts_with("$Nodes") || line.starts_with("$Elements")) return 0;
  int most = 0, dimension = 0;
  while (std::getline(stream, line) && !line.starts_with('$'))
    if (std::string name; std::istringstream(line) >> dimension >> name >> name)
      most = std::max(most, dimension);
  return most;
}

}  // namespace tunica::element
