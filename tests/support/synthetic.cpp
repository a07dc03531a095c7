// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/synthetic.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace tunica::test_support {

namespace {

using namespace observables;

constexpr double period = 0.8;
constexpr double peak = 0.2112;

double shape(double time) {
  return 0.5 * (1 - std::cos(2 * std::numbers::pi * (time - peak + period / 2) / period));
}

struct Angles {
  double reference, drop;
};

Sample sample_at(double time, const SyntheticRun& wanted, bool fibers) {
  const double s = shape(time);
  // The first beat grows from rest, as a run does.
  const double start = std::fmin(1.0, time / 0.05);
  const Angles angles = wanted.law == "EXP1+EXP2-ZS" ? Angles{56.52, 10} : Angles{42.82, 9.5};
  Sample sample;
  sample.time = time;
  sample.inflow = start * (0.08 + 0.13 * s);
  sample.outflow = start * (0.08 + 0.13 * shape(time - 0.012));
  sample.pressure =
      start * mmhg * (wanted.lowest_pressure + (wanted.highest_pressure - wanted.lowest_pressure) * s);
  sample.outlet_pressure = 0.99 * sample.pressure;
  sample.transmural_pressure = start * mmhg * (3 + 12 * s);
  for (int index = 0; index < wall_points; ++index) {
    WallPoint& point = sample.wall[index];
    const double depth = index / 3.0;
    point.radial_displacement = start * wanted.displacement_scale * (0.6 + 0.4 * s) * (1 - 0.2 * depth);
    point.von_mises = start * (4e5 + 4e5 * s) * (1 - 0.3 * depth) * (fibers ? 0.8 : 1.0);
    if (!fibers) continue;
    const double strain = start * (0.7 + 0.3 * s) * (1 - 0.25 * depth);
    point.fiber_angle = angles.reference - angles.drop * strain;
    point.fiber_stretch = 1 + 0.3 * strain;
    point.recruitment = std::atan(5e5 * (start * s - synthetic_thresholds[index])) / std::numbers::pi + 0.5;
  }
  return sample;
}

void add_profiles(Result& result, const SyntheticRun& wanted, bool fibers) {
  result.profiles = profile_table();
  for (const double in_beat : {0.2112, 0.6}) {
    const double time = (wanted.beats - 1) * period + in_beat;
    for (int index = 0; index <= 40; ++index) {
      const double depth = index / 40.0;
      ProfilePoint point;
      point.time = time;
      point.reference_radius = 0.033 + 0.01 * depth;
      point.radial_displacement = wanted.displacement_scale * (0.6 + 0.4 * shape(time)) * (1 - 0.2 * depth);
      point.circumferential_stretch = 1 + point.radial_displacement / point.reference_radius;
      point.volume_change = -0.01 * (1 - depth);
      point.von_mises = (4e5 + 4e5 * shape(time)) * (1 - 0.3 * depth) * (fibers ? 0.8 : 1.0);
      if (fibers) {
        point.fiber_stretch = 1 + 0.25 * (1 - 0.3 * depth);
        point.recruitment = depth < 0.5 ? 1 : 0;
        point.fiber_angle = 36 + 2 * depth;
      }
      append(result.profiles, point);
    }
  }
}

/// A parabola of the radius, and pressure that falls in a straight line from 100 to 90 mmHg.
void add_along(Result& result) {
  Table& along = result.along;
  for (const auto& [name, unit] : {std::pair{"time", "s"},
                                   {"z", "cm"},
                                   {"lumen_radius", "cm"},
                                   {"pressure", "dyn/cm2"},
                                   {"wall_shear_stress", "dyn/cm2"},
                                   {"radial_displacement", "cm"},
                                   {"von_mises.inner", "dyn/cm2"}})
    along.add(name, unit);
  for (const double time : {0.8, 1.0112})
    for (int index = 0; index <= 20; ++index) {
      const double s = index / 20.0, opened = 0.04 * s * (1 - s) * time;
      std::size_t column = 0;
      for (const double value : {time, 0.66 * s, 0.033 + opened, (100 - 10 * s) * mmhg, 20 * time + 5 * s,
                                 opened, 4e5 * time * (1 + s)})
        along[column++].values.push_back(value);
    }
}

void add_events(Result& result, const SyntheticRun& wanted) {
  for (int index = 0; index < wall_points; ++index) {
    const double half = period / (2 * std::numbers::pi) * std::acos(2 * synthetic_thresholds[index] - 1);
    const auto add = [&](double time, bool recruited) {
      if (time < wanted.beats * period)
        append(result.events, Event{std::fmax(time, 1e-4), index + 1, 1, recruited});
    };
    for (int beat = 0; beat <= wanted.beats; ++beat) {
      add(beat * period + peak - half, true);
      add(beat * period + peak + half, false);
    }
  }
}

void add_sensitivities(Result& result) {
  Table& table = result.sensitivities;
  table.add("time", "s");
  const struct {
    const char *quantity, *unit;
    double scale;
  } quantities[] = {{"pressure", "dyn/cm2", 1e5}, {"radial_displacement.P1", "cm", 0.01}};
  const struct {
    const char *key, *unit;
    double value;
  } parameters[] = {{"outlet.resistance", "dyn s/cm5", 1.032e6}, {"tether.stiffness", "dyn/cm3", 1e7}};
  for (const auto& quantity : quantities)
    for (const auto& parameter : parameters) {
      const ColumnHead head =
          sensitivity_column(quantity.quantity, quantity.unit, parameter.key, parameter.unit);
      const std::size_t column = table.add(head.name, head.unit);
      for (const double time : result.observables[0].values)
        table[column].values.push_back(quantity.scale / parameter.value * shape(time) *
                                       (parameter.value > 5e6 ? -1 : 1));
    }
  table[0].values = result.observables[0].values;
  Table& events = result.event_sensitivities;
  events = result.events;
  const ColumnHead head = sensitivity_column("time", "s", "outlet.resistance", "dyn s/cm5");
  const std::size_t column = events.add(head.name, head.unit);
  events[column].values.assign(result.events.rows(), -1e-7);
}

nlohmann::ordered_json record_of(const SyntheticRun& wanted) {
  const bool fs = wanted.law == "EXP1+EXP2-FS";
  nlohmann::ordered_json record = {{"program", "tunica"},
                                   {"version", "0.0.0"},
                                   {"commit", ""},
                                   {"name", wanted.name},
                                   {"tier", "lumped"},
                                   {"resolution", {{"compartments", 1}}},
                                   {"unknowns", 2},
                                   {"steps", 1234},
                                   {"newton_iterations", 2345},
                                   {"linear_iterations", 0},
                                   {"rejected_steps", 3},
                                   {"seconds", {{"setup", 0.004}, {"solve", 0.006}}},
                                   {"peak_memory_bytes", 12345678},
                                   {"converged", true},
                                   {"interrupted", false},
                                   {"failure", ""},
                                   {"remarks", {"made-up curves for tests"}},
                                   {"scene",
                                    {{"geometry.kind", "cylinder"},
                                     {"geometry.radius", 0.033},
                                     {"geometry.thickness", 0.01},
                                     {"wall.law", wanted.law},
                                     {"tether.traction", wanted.tether},
                                     {"tether.stiffness", 1e7},
                                     {"outlet.resistance", 1.032e6},
                                     {"inlet.period", period},
                                     {"time.beats", static_cast<long>(wanted.beats)}}},
                                   {"scene_set", {"wall.law"}},
                                   {"scene_toml", "# made-up\n[wall]\nlaw = \"" + wanted.law + "\"\n"}};
  if (wanted.law.find('+') != std::string::npos) {
    record["scene"]["wall.fiber_angle"] = fs ? 42.82 : 56.52;
    record["scene"]["wall.exponent"] = 2;
    record["scene"]["wall.activation_stretch"] = fs ? 1.5009 : 1.0;
  }
  return record;
}

}  // namespace

StoredResult synthetic_run(const SyntheticRun& wanted) {
  const bool fibers = wanted.law.find("+EXP2") != std::string::npos;
  StoredResult stored;
  stored.folder = fmt::format("results/{}-{}", wanted.name, wanted.law);
  stored.record = record_of(wanted);
  Result& result = stored.result;
  result.observables = standard_table();
  const long rows = std::lround(wanted.beats * period / wanted.interval);
  for (long row = 0; row <= rows; ++row)
    append(result.observables, sample_at(static_cast<double>(row) * wanted.interval, wanted, fibers));
  add_profiles(result, wanted, fibers);
  result.events = event_table();
  if (fibers) add_events(result, wanted);
  if (wanted.with_length) add_along(result);
  if (wanted.with_sensitivities) add_sensitivities(result);
  return stored;
}

StoredResult synthetic_state(const SyntheticRun& wanted) {
  StoredResult stored = synthetic_run(wanted);
  const bool fibers = wanted.law.find("+EXP2") != std::string::npos;
  Result& result = stored.result;
  result.observables = standard_table();
  Sample sample = sample_at((wanted.beats - 1) * period + peak, wanted, fibers);
  sample.time = 0;
  sample.inflow = sample.outflow = none;
  append(result.observables, sample);
  const std::size_t kept = 41;
  for (std::size_t column = 0; column < result.profiles.columns().size(); ++column)
    result.profiles[column].values.resize(kept);
  result.profiles[0].values.assign(kept, 0.0);
  result.events = event_table();
  stored.record["scene"]["time.mode"] = "static";
  stored.record["scene"]["inlet.waveform"] = "pressure";
  stored.record["scene"]["inlet.pressure"] = wanted.highest_pressure * mmhg;
  stored.record["scene_set"] = {"wall.law", "time.mode", "inlet.waveform", "inlet.pressure"};
  return stored;
}

}  // namespace tunica::test_support
