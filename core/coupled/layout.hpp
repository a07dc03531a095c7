// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tunica::coupled {

/// What a layout is made of.
struct LayoutSpec {
  int components = 0;                                ///< of vectors
  std::vector<bool> has_displacement, has_velocity;  ///< by node
  std::vector<bool> on_wall;  ///< nodes on the wall and on its surfaces, that of a rigid pipe included
  std::vector<bool> has_pressure;
  bool inlet_pressure = false, outlet_pressure = false, windkessel_pressure = false;
  bool mesh_follows = false;  ///< the displacement off the wall is no unknown
  bool mesh_couples = false;  ///< the equations of its components have each other's displacements
  /// A displacement in the blood that follows from that of a node on the wall: `share` times it in the same
  /// component, and `lean` times it in the first. All components of the node follow the same one on the wall.
  struct Share {
    int node;
    int component;
    int of;  ///< node on the wall
    double share;
    double lean = 0;
  };
  std::vector<Share> shares;
  /// Values that are prescribed, if they are unknowns at all; later ones that repeat earlier ones are
  /// ignored.
  struct Fixed {
    int node;
    int component;
    bool is_velocity;
  };
  std::vector<Fixed> fixed;
  /// Nodes in the order in which their unknowns are numbered; scalars come last.
  std::vector<int> order;
};

/// Where everything stands in the state, a flat vector y, and which of its entries are unknowns.
///
/// y = (displacement of all nodes, velocity of all nodes, blood pressure at corners, scalars). The
/// displacement is one field: that of the wall, continued into the blood as the motion of the mesh. On the
/// wall, its surface towards the blood included, the velocity is the rate of the displacement and no unknown,
/// so that blood adheres to it by construction.
class Layout {
 public:
  explicit Layout(const LayoutSpec& spec);

  int components() const { return components_; }
  int nodes() const { return static_cast<int>(on_wall_.size()); }
  std::size_t size() const { return size_; }
  int unknowns() const { return static_cast<int>(entries_.size()); }

  std::size_t displacement(int node, int component) const { return components_ * node + component; }
  std::size_t velocity(int node, int component) const { return velocity_ + components_ * node + component; }
  std::size_t pressure(int node) const { return pressure_ + pressure_index_[node]; }
  bool has_pressure(int node) const { return pressure_index_[node] >= 0; }
  std::size_t pressures() const { return scalar_ - pressure_; }
  std::size_t velocity_begin() const { return velocity_; }
  std::size_t pressure_begin() const { return pressure_; }
  std::size_t scalar_begin() const { return scalar_; }

  /// Node of an entry of the displacement, the velocity or the pressure.
  int node_of(std::size_t entry) const;

  /// Scalars: pressure that drives a given flow in, pressure at the outlet, pressure in the Windkessel.
  std::optional<std::size_t> inlet_pressure, outlet_pressure, windkessel_pressure;

  /// The displacement off the wall is none of the unknowns, but found from that of the wall.
  bool mesh_follows() const { return mesh_follows_; }
  /// The equations of its components have each other's displacements.
  bool mesh_couples() const { return mesh_couples_; }
  /// Its entries of y that are not prescribed, and the number of an entry among them, or -1.
  const std::vector<std::size_t>& followers() const { return followers_; }
  int follower(std::size_t entry) const { return follower_.empty() ? -1 : follower_[entry]; }

  /// Sets the entries of y, or of its rate or derivative, that are shares of others (LayoutSpec::shares).
  void share_out(std::span<double> y) const;

  /// What an entry's column of a derivative adds to: `share` times the column of `unknown`, -1 for none, and
  /// `lean` times that of the first component of the same node. An unknown's own is itself, once; a share of
  /// an unknown is that of its unknown.
  struct Column {
    int unknown;
    double share;
    double lean;
  };
  Column column(std::size_t entry) const;

  /// Number of the unknown at an entry of y, or -1.
  int unknown(std::size_t entry) const { return unknown_[entry]; }
  /// Entry of y of an unknown.
  std::size_t entry(int unknown) const { return entries_[unknown]; }

  /// True on the wall and on its surfaces: the velocity is the rate of the displacement.
  bool on_wall(int node) const { return on_wall_[node]; }
  bool has_displacement(int node) const { return has_displacement_[node]; }
  bool has_velocity(int node) const { return has_velocity_[node]; }
  const std::vector<int>& wall_nodes() const { return wall_nodes_; }

  /// Entries whose values are prescribed: the node's place gives the value.
  struct PrescribedEntry {
    std::size_t entry;
    int node;
    int component;
    bool is_velocity;
  };
  const std::vector<PrescribedEntry>& prescribed() const { return prescribed_; }

 private:
  void number(const LayoutSpec& spec);

  int components_;
  bool mesh_follows_, mesh_couples_;
  std::size_t velocity_ = 0, pressure_ = 0, scalar_ = 0, size_ = 0;
  std::vector<int> pressure_index_, unknown_;
  std::vector<std::size_t> entries_, followers_;
  struct SharedEntry {
    std::size_t entry, of, first;
    double share, lean;
  };
  std::vector<SharedEntry> shared_;
  std::vector<int> shared_index_;  ///< by entry of the displacement, -1 for none; empty without shares
  std::vector<int> follower_;      ///< by entry of the displacement
  std::vector<bool> on_wall_, has_displacement_, has_velocity_;
  std::vector<int> wall_nodes_;
  std::vector<PrescribedEntry> prescribed_;
};

}  // namespace tunica::coupled
