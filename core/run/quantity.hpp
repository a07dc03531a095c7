// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/observables/beat.hpp"
#include "core/observables/result.hpp"

namespace tunica::run {

/// What is made of an observable over the last beat of a run.
enum class Statistic {
  max,
  min,
  mean,
  change,       ///< max - min
  time_of_max,  ///< s in the beat
  time_of_min,
  drift,      ///< value at the end of the beat less that at its beginning
  share,      ///< of recruitment: share of the beat with H > 1/2
  on,         ///< of recruitment: s in the beat at which fibres are first recruited; none where they are not
  off,        ///< of recruitment: s in the beat at which that first interval ends
  max_place,  ///< of von_mises: where its greatest maximum is, 1 to wall_points for P1..P4
  /// Of beat: 1 where pressure, outflow and radial_displacement.P1 end it within 1 % of their largest
  /// magnitude of where they began it (observables::unrepeated), else 0.
  periodic
};

/// A number of a run, named OBSERVABLE.STATISTIC: "pressure.max", "fiber_angle.P1.change",
/// "recruitment.P1.share"; "von_mises.max" and "von_mises.max_place" over all points, "beat.periodic".
struct Quantity {
  std::string observable;
  Statistic statistic;

  std::string name() const;
  std::string unit() const;  ///< UDUNITS text: "dyn/cm2", "1"
};

/// Throws InvalidInput naming what is allowed and the nearest name.
Quantity parse_quantity(std::string_view name);

/// All of the standard observables, in the order of observables.csv.
const std::vector<Quantity>& known_quantities();

/// What is asked of a run: quantities, and the scene keys by which they are differentiated.
struct Question {
  std::vector<Quantity> quantities;
  std::vector<std::string> keys;
};

/// What a run answers; observables::none where law or tier have no such thing.
struct Answer {
  std::vector<double> values;                  ///< by quantity
  std::vector<std::vector<double>> gradients;  ///< by quantity and key, in the units of both
};

/// The answer that a result's tables hold over a beat. Extremes are those of the parabola through the rows
/// next to them. Gradients come from the result's sensitivities: an extreme moves as the observable does at
/// its time (its own time moves to first order without effect), the time of an extreme by
/// -(d2y/dt dkey) / (d2y/dt2), a first interval of recruitment with its events. `none` where there are no
/// sensitivities by a key. Throws InvalidInput when there are no rows.
Answer answer_of(const Result& result, const observables::Beat& beat, const Question& question);

/// The same over the last whole beat of a result that was read back.
Answer answer_of(const StoredResult& stored, const Question& question);

}  // namespace tunica::run
