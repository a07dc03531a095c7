// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/slips.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/scene/message.hpp"

namespace tunica::scene {

namespace {

/// Numbers that a parameter in CGS units hardly ever has, and the unit that they are usual in.
struct Slip {
  std::string_view key;  ///< as declared; with a dot in front the end of several
  double lower, upper;
  std::string_view unit;
  bool broken = false;  ///< only what is no whole number, as radians are
};

constexpr Slip slips[] = {
    {"geometry.radius", 0, 5e-4, "m"},
    {"geometry.radius", 2, 30, "mm"},
    {"geometry.radius", 30, 3e4, "um"},
    {"geometry.thickness", 0, 2e-5, "m"},
    {"geometry.thickness", 0.5, 20, "mm"},
    {"geometry.thickness", 20, 1e4, "um"},
    {"geometry.length", 200, 1e4, "mm"},
    {"geometry.bend_angle", 0, 6.3, "rad", true},
    {".fiber_angle", 0, 1.58, "rad", true},
    {".angle", 0, 1.58, "rad", true},
    {".stiffness", 0, 1, "MPa"},
    {".stiffness", 1, 1e3, "kPa"},
    {".fiber_stiffness", 0, 1, "MPa"},
    {".fiber_stiffness", 1, 1e3, "kPa"},
    {".shear_modulus", 0, 1, "MPa"},
    {".shear_modulus", 1, 1e3, "kPa"},
    {".young_modulus", 0, 1, "MPa"},
    {".young_modulus", 1, 1e3, "kPa"},
    {".bulk_modulus", 0, 10, "MPa"},
    {".bulk_modulus", 10, 1e4, "kPa"},
    {".fraction", 1.5, 100, "%"},
    {".density", 500, 3000, "kg/m3"},
    {"blood.viscosity", 2e-3, 6e-3, "Pa s"},
    {"blood.viscosity", 1, 50, "cP"},
    {"inlet.pressure", 1, 400, "mmHg"},
    {"inlet.period", 100, 1e4, "ms"},
    {"inlet.duration", 1, 1e4, "ms"},
    {"outlet.pressure", 1, 400, "mmHg"},
    {"time.ramp", 2, 1e4, "ms"},
    {"time.step", 0.5, 1e3, "ms"},
    {"output.interval", 0.5, 1e3, "ms"},
    {"output.field_interval", 5, 1e4, "ms"},
    {"accuracy.tolerance", 0.11, 10, "%"},
};

bool is_of(const Slip& slip, std::string_view key) {
  if (slip.key.front() != '.') return key == slip.key;
  // A tether's stiffness is no tissue's.
  const bool has_such = slip.key != ".stiffness" || key.starts_with("wall.");
  return has_such && key.ends_with(slip.key);
}

}  // namespace

std::string unit_meant(std::string_view key, double value) {
  const double size = std::abs(value);
  for (const Slip& slip : slips) {
    if (!is_of(slip, key) || !(size >= slip.lower && size < slip.upper)) continue;
    if (size == 0 || (slip.broken && value == std::round(value))) continue;
    return in_quotes(slip.unit == "%" ? fmt::format("{:g}%", value)
                                      : fmt::format("{:g} {}", value, slip.unit));
  }
  return {};
}

std::vector<std::string> remarks_on_units(const Scene& scene, const IsPlain& is_plain) {
  std::vector<std::string> lines;
  for (const auto& [key, stored] : scene.values()) {
    const double* value = std::get_if<double>(&stored);
    if (!value || !is_plain(key)) continue;
    const std::string meant = unit_meant(key, *value);
    if (meant.empty()) continue;
    const std::string as_it_is = with_unit(*value, find_parameter(key)->unit);
    lines.push_back(fmt::format("{} = {:g} is taken as {}{} If not, write it with its unit", key, *value,
                                as_it_is, did_you_mean(meant)));
  }
  return lines;
}

}  // namespace tunica::scene
