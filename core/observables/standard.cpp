// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <initializer_list>
#include <stdexcept>

#include "core/observables/result.hpp"

namespace tunica::observables {

namespace {

/// Column names and the order of values in append() stand side by side in each pair of functions
/// below, and a table of another shape is refused.
void append_numbers(Table& table, std::size_t first, std::initializer_list<double> values) {
  for (const double value : values) table[first++].values.push_back(value);
}

void expect_columns(const Table& table, std::size_t count) {
  if (table.columns().size() < count) throw std::logic_error("append: the table has other columns");
}

constexpr std::size_t columns_before_points = 6;
constexpr std::size_t columns_per_point = 5;

}  // namespace

Table standard_table() {
  Table table;
  table.add("time", "s");
  table.add("inflow", "cm3/s");
  table.add("outflow", "cm3/s");
  table.add("pressure", "dyn/cm2");
  table.add("outlet_pressure", "dyn/cm2");
  table.add("transmural_pressure", "dyn/cm2");
  for (int point = 1; point <= wall_points; ++point) {
    table.add(fmt::format("radial_displacement.P{}", point), "cm");
    table.add(fmt::format("fiber_angle.P{}", point), "deg");
    table.add(fmt::format("fiber_stretch.P{}", point), "1");
    table.add(fmt::format("recruitment.P{}", point), "1");
    table.add(fmt::format("von_mises.P{}", point), "dyn/cm2");
  }
  return table;
}

void append(Table& table, const Sample& sample) {
  expect_columns(table, columns_before_points + columns_per_point * wall_points);
  append_numbers(table, 0,
                 {sample.time, sample.inflow, sample.outflow, sample.pressure, sample.outlet_pressure,
                  sample.transmural_pressure});
  std::size_t column = columns_before_points;
  for (const WallPoint& point : sample.wall) {
    append_numbers(table, column,
                   {point.radial_displacement, point.fiber_angle, point.fiber_stretch, point.recruitment,
                    point.von_mises});
    column += columns_per_point;
  }
}

Table profile_table() {
  Table table;
  table.add("time", "s");
  table.add("reference_radius", "cm");
  table.add("radial_displacement", "cm");
  table.add("radial_stretch", "1");
  table.add("circumferential_stretch", "1");
  table.add("volume_change", "1");
  table.add("fiber_stretch", "1");
  table.add("fiber_angle", "deg");
  table.add("recruitment", "1");
  table.add("radial_stress", "dyn/cm2");
  table.add("circumferential_stress", "dyn/cm2");
  table.add("axial_stress", "dyn/cm2");
  table.add("von_mises", "dyn/cm2");
  return table;
}

void append(Table& table, const ProfilePoint& point) {
  expect_columns(table, 13);
  append_numbers(table, 0,
                 {point.time, point.reference_radius, point.radial_displacement, point.radial_stretch,
                  point.circumferential_stretch, point.volume_change, point.fiber_stretch, point.fiber_angle,
                  point.recruitment, point.radial_stress, point.circumferential_stress, point.axial_stress,
                  point.von_mises});
}

Table along_table() {
  Table table;
  table.add("time", "s");
  table.add("z", "cm");
  table.add("lumen_radius", "cm");
  table.add("pressure", "dyn/cm2");
  table.add("wall_shear_stress", "dyn/cm2");
  table.add("radial_displacement", "cm");
  table.add("von_mises.inner", "dyn/cm2");
  return table;
}

Table event_table() {
  Table table;
  table.add("time", "s");
  table.add("point", "");
  table.add("family", "1");
  table.add("change", "");
  return table;
}

void append(Table& table, const Event& event) {
  const auto& columns = table.columns();
  if (columns.size() < 4 || columns[1].name != "point" || columns[2].name != "family" ||
      columns[3].name != "change")
    throw std::logic_error("append: the table has other columns");
  table[0].values.push_back(event.time);
  table[1].labels.push_back(fmt::format("P{}", event.point));
  table[2].values.push_back(event.family);
  table[3].labels.emplace_back(event.recruited ? "recruited" : "released");
}

ColumnHead sensitivity_column(std::string_view quantity, std::string_view quantity_unit, std::string_view key,
                              std::string_view key_unit) {
  return {fmt::format("d({})/d({})", quantity, key),
          key_unit == "1" ? std::string(quantity_unit) : fmt::format("({})/({})", quantity_unit, key_unit)};
}

void add_sensitivity_columns(Table& table, std::string_view quantity, std::string_view quantity_unit,
                             const std::vector<std::string>& keys) {
  for (const auto& key : keys) {
    auto head = sensitivity_column(quantity, quantity_unit, key, scene::find_parameter(key)->unit);
    table.add(std::move(head.name), std::move(head.unit));
  }
}

namespace {

/// What has sensitivities, in the order of their columns.
struct SectionQuantity {
  const char* name;
  const char* unit;
  double Sample::*value;
};
constexpr SectionQuantity section_quantities[] = {
    {"pressure", "dyn/cm2", &Sample::pressure},
    {"outlet_pressure", "dyn/cm2", &Sample::outlet_pressure},
    {"transmural_pressure", "dyn/cm2", &Sample::transmural_pressure},
    {"inflow", "cm3/s", &Sample::inflow},
    {"outflow", "cm3/s", &Sample::outflow}};
struct PointQuantity {
  const char* name;
  const char* unit;
  double WallPoint::*value;
};
constexpr PointQuantity point_quantities[] = {{"radial_displacement", "cm", &WallPoint::radial_displacement},
                                              {"fiber_angle", "deg", &WallPoint::fiber_angle},
                                              {"fiber_stretch", "1", &WallPoint::fiber_stretch},
                                              {"recruitment", "1", &WallPoint::recruitment},
                                              {"von_mises", "dyn/cm2", &WallPoint::von_mises}};

}  // namespace

Sample difference_quotient(const Sample& upper, const Sample& lower, double step) {
  Sample quotient;
  quotient.time = upper.time;
  for (const auto& quantity : section_quantities)
    quotient.*quantity.value = (upper.*quantity.value - lower.*quantity.value) / step;
  for (int p = 0; p < wall_points; ++p)
    for (const auto& quantity : point_quantities)
      quotient.wall[p].*quantity.value =
          (upper.wall[p].*quantity.value - lower.wall[p].*quantity.value) / step;
  return quotient;
}

Table sensitivity_table(const std::vector<std::string>& keys) {
  Table table;
  if (keys.empty()) return table;
  table.add("time", "s");
  for (const auto& key : keys) {
    for (const auto& quantity : section_quantities)
      add_sensitivity_columns(table, quantity.name, quantity.unit, {key});
    for (const auto& quantity : point_quantities)
      for (int p = 1; p <= wall_points; ++p)
        add_sensitivity_columns(table, fmt::format("{}.P{}", quantity.name, p), quantity.unit, {key});
  }
  return table;
}

void append_sensitivities(Table& table, double time, const std::vector<Sample>& derivatives) {
  std::size_t column = 0;
  const auto put = [&](double value) { table[column++].values.push_back(value); };
  put(time);
  for (const Sample& derivative : derivatives) {
    for (const auto& quantity : section_quantities) put(derivative.*quantity.value);
    for (const auto& quantity : point_quantities)
      for (const WallPoint& point : derivative.wall) put(point.*quantity.value);
  }
}

}  // namespace tunica::observables
