// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/radial/ring.hpp"

namespace tunica::radial {

/// Where the excess I4bar - a^2 of a collagen family passes a level that an element has to end at.
/// For a kink that is level 0: the fibre stress bends there. A step of finite width (low sharpness,
/// or exponent 1, whose stress jumps) is followed by the levels 0, +-1, +-4, +-16, ... of
/// epsilon (I4bar - a^2). Levels, not distances, because with exponent 1 the tissue can linger at
/// the threshold: over a finite depth I4bar = a^2 and the fibres are partly recruited.
struct Front {
  double xi;
  double tolerance;  ///< how far the element boundary may lie from the front
};

/// xi of the inner surface, the boundaries between layers and the outer surface. Instantiated for
/// double and Dual<double, 1>.
template <class P>
std::vector<P> layer_boundaries(const Ring<P>& ring);

/// The layer that a place lies in; a boundary belongs to the inner of its layers.
std::size_t layer_at(const std::vector<double>& boundaries, double xi);

/// I4bar - a^2 of a family at a place with displacement u and slope du/dR.
double fiber_excess(const wall::CollagenFamily<double>& family, const Ring<double>& ring, double xi,
                    double displacement, double slope);

/// Displacement and slope as functions of xi inside a layer.
using Field = std::function<std::pair<double, double>(double xi)>;

/// How closely an element has to end at a kink, in xi: its square is what the stress is wrong by there.
inline constexpr double finest_kink = 1e-7;

/// The fronts inside the layers, sorted. Families that are mirror images share theirs. `kink` as finest_kink,
/// or wider.
std::vector<Front> find_fronts(const Ring<double>& ring, const std::vector<double>& boundaries,
                               const Field& field, double kink = finest_kink);

/// An element of the radial mesh and the layer that it lies in.
struct Interval {
  double lower, upper;
  std::size_t layer;
};

/// An interval whose ends depend on what derivatives are taken with respect to.
template <class S>
struct MovingInterval {
  S lower, upper;
};

/// Where an element comes to lie when the layers' shares change: it keeps its place within its layer.
/// `boundaries` are the plain ones that the element was made with.
template <class P>
MovingInterval<P> moved_with_layers(const Ring<P>& ring, const std::vector<double>& boundaries,
                                    const Interval& cell);

/// Elements that end at the layer boundaries and at the fronts.
std::vector<Interval> radial_mesh(const std::vector<double>& boundaries, const std::vector<Front>& fronts);

/// Elements of the same ends and so many more that none spans radii of a greater ratio than elements resolve
/// fields in 1/R with. Their layers are kept.
std::vector<Interval> refined_for(const Ring<double>& ring, const std::vector<Interval>& mesh);

/// Where elements are to end so that fronts are found where they end. A front is found in a solution on a
/// mesh that ends at a guess of it; the slopes on both sides of that end differ by the error of the
/// discretisation, so that a front can be found before the end where it is put behind and behind where it is
/// put before. It is then closed in upon between the two.
class FrontSearch {
 public:
  /// What is found where the elements end at `put`, to where they are to end next.
  std::vector<Front> next(const std::vector<Front>& put, const std::vector<Front>& found);
  /// All fronts are enclosed more closely than they have to be known.
  bool is_closed() const { return is_closed_; }

 private:
  struct Bracket {
    double lower, upper;
  };
  std::vector<Bracket> brackets_;
  bool is_closed_ = false;
};

/// True when an element of the mesh ends at the front, as closely as it has to.
bool has_end_near(const std::vector<Interval>& mesh, const Front& front);

}  // namespace tunica::radial
