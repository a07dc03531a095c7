// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene's loads amount to, beside what arteries live with.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/inlet.hpp"
#include "core/scene/living.hpp"
#include "core/scene/message.hpp"
#include "core/scene/slips.hpp"
#include "core/units.hpp"

namespace tunica::scene {

namespace {

/// A prescribed flow on its way through the outlet.
struct Load {
  double flow;               ///< mean, cm3/s
  double distal, proximal;   ///< resistances, dyn s/cm5
  double beyond;             ///< pressure beyond them, dyn/cm2
  double radius;             ///< cm
  bool flow_follows_radius;  ///< by the default of inlet.flow

  double resistance() const { return distal + proximal; }
  double pressure() const { return beyond + resistance() * flow; }
  double velocity() const { return flow / (std::numbers::pi * radius * radius); }
  bool lives() const {
    return (resistance() == 0 || living::mean_pressure.contains(pressure() / mmhg)) &&
           living::mean_velocity.contains(velocity());
  }
};

Load load_of(const Scene& scene, const Inlet& inlet) {
  const bool is_static = scene.text("time.mode") == "static";
  const double scale = inlet.scale_key.empty() ? 1.0 : scene.number(inlet.scale_key);
  return {scale * (is_static ? inlet.shape->at(0) : inlet.mean_shape()),
          scene.number("outlet.resistance"),
          scene.text("outlet.kind") == "rcr" ? scene.number("outlet.proximal_resistance") : 0.0,
          scene.number("outlet.pressure"),
          scene.number("geometry.radius"),
          !inlet.scale_key.empty() && !scene.was_set(inlet.scale_key)};
}

/// The load with one of its numbers `factor` times as large.
Load with(Load load, std::string_view key, double factor) {
  if (key == "geometry.radius") {
    load.radius *= factor;
    if (load.flow_follows_radius) load.flow *= factor * factor;
  } else if (key == "inlet.flow") {
    load.flow *= factor;
  } else {
    load.distal *= factor;
    load.proximal *= factor;
  }
  return load;
}

/// `; did you mean ...?` for the number without a unit that in another makes the load one of the living.
std::string unit_slip(const Load& load, const Scene& scene, const IsPlain& is_plain) {
  constexpr std::pair<std::string_view, std::string_view> usual[] = {
      {"inlet.flow", "ml/min"},           {"inlet.flow", "l/min"},
      {"geometry.radius", "mm"},          {"geometry.radius", "um"},
      {"outlet.resistance", "mmHg s/ml"}, {"outlet.resistance", "mmHg min/l"},
      {"outlet.resistance", "Pa s/m3"}};
  for (const auto& [key, unit] : usual) {
    if (!scene.has(key) || !is_plain(key)) continue;
    const double factor = unit_factor(std::string(unit), find_parameter(key)->unit, std::string(key), "");
    if (with(load, key, factor).lives())
      return did_you_mean(
          fmt::format("{} = {}", key, in_quotes(fmt::format("{:g} {}", scene.number(key), unit))));
  }
  return {};
}

std::string pressure_remark(const Load& load, const Scene& scene, const IsPlain& is_plain) {
  std::string remedy;
  constexpr double usual = 100 * mmhg;
  if (const double needed = (usual - load.beyond) / load.flow; needed > 0) {
    const double share = needed / load.resistance();
    remedy = fmt::format("; 100 mmHg would take {:.3g} dyn s/cm5", load.distal * share);
    if (load.proximal > 0) remedy += fmt::format(" beyond a proximal {:.3g}", load.proximal * share);
    if (!scene.was_set("outlet.resistance"))
      remedy += ", not the default, which suits an artery of 0.033 cm radius";
  }
  return fmt::format(
      "outlet.resistance{} = {:.4g} dyn s/cm5 and a mean flow of {:.4g} cm3/s make a mean pressure of {:.4g} "
      "mmHg{}, where arteries have {:g} to {:g} mmHg{}{}",
      load.proximal > 0 ? " and outlet.proximal_resistance" : "", load.resistance(), load.flow,
      load.pressure() / mmhg,
      load.beyond != 0 ? fmt::format(" with an outlet.pressure of {:.3g} mmHg", load.beyond / mmhg) : "",
      living::mean_pressure.lowest, living::mean_pressure.highest, remedy, unit_slip(load, scene, is_plain));
}

void remark_on_flow(const Load& load, const Scene& scene, const IsPlain& is_plain,
                    std::vector<std::string>& lines) {
  if (load.flow == 0) return;
  if (load.flow < 0) {
    lines.push_back(
        fmt::format("the mean flow at the inlet is {:.4g} cm3/s: blood leaves through the inlet; is the sign "
                    "of {} meant?",
                    load.flow, scene.has("inlet.flow") ? "inlet.flow" : "inlet.waveform"));
    return;
  }
  if (load.resistance() > 0 && !living::mean_pressure.contains(load.pressure() / mmhg)) {
    lines.push_back(pressure_remark(load, scene, is_plain));
    return;
  }
  const double velocity = load.velocity();
  const std::string slip = living::mean_velocity.contains(velocity) ? "" : unit_slip(load, scene, is_plain);
  if (velocity > 2 * living::mean_velocity.highest || !slip.empty())
    lines.push_back(fmt::format(
        "a mean flow of {:.4g} cm3/s in a radius of {:g} cm is a mean velocity of {:.4g} cm/s, where "
        "arteries have {:g} to {:g} cm/s{}",
        load.flow, load.radius, velocity, living::mean_velocity.lowest, living::mean_velocity.highest, slip));
}

void remark_on_times(const Scene& scene, const IsPlain& is_plain, std::vector<std::string>& lines) {
  const double period = scene.number("inlet.period");
  constexpr double fewest_beats = 40, minute = 60;
  if (is_plain("inlet.period") && period >= fewest_beats)
    lines.push_back(
        fmt::format("inlet.period = {0:g} is a beat of {0:g} s; {0:g} beats a minute are {1:.4g} s", period,
                    minute / period));
  if (scene.text("time.mode") == "static" || !scene.has("time.ramp")) return;
  const double ramp = scene.number("time.ramp");
  if (scene.has("inlet.duration") && ramp > scene.number("inlet.duration")) {
    const double duration = scene.number("inlet.duration");
    lines.push_back(
        fmt::format("time.ramp = {:g} s is longer than the pulse, inlet.duration = {:g} s, whose first "
                    "reaches {:.2g} % of inlet.pressure only; write time.ramp = 0",
                    ramp, duration, 50 * (1 - std::cos(std::numbers::pi * duration / ramp))));
  } else if (ramp > period) {
    lines.push_back(
        fmt::format("time.ramp = {:g} s is longer than a beat of {:g} s: the loads grow for {:.2g} of the {} "
                    "beats",
                    ramp, period, ramp / period, scene.integer("time.beats")));
  }
}

void remark_on_storage(const Scene& scene, const IsPlain& is_plain, std::vector<std::string>& lines) {
  if (!scene.has("outlet.compliance")) return;
  const double compliance = scene.number("outlet.compliance");
  const double time = scene.number("outlet.resistance") * compliance;
  constexpr double longest = 30, usual = 10;
  if (!(time > longest)) return;
  const double in_clinical = time / mmhg;
  const std::string slip = is_plain("outlet.compliance") && in_clinical < usual
                               ? did_you_mean(in_quotes(fmt::format("{:g} ml/mmHg", compliance)))
                               : "";
  lines.push_back(
      fmt::format("outlet.resistance times outlet.compliance = {:g} cm5/dyn is {:.3g} s: the pressure takes "
                  "several times as long to settle{}",
                  compliance, time, slip));
}

void remark_on_thickness(const Scene& scene, const IsPlain& is_plain, std::vector<std::string>& lines) {
  if (scene.text("geometry.kind") == "mesh" || !is_plain("geometry.thickness")) return;
  const double thickness = scene.number("geometry.thickness"), radius = scene.number("geometry.radius");
  constexpr double thickest = 2, usual = 0.6, mm_per_cm = 10;
  if (thickness / radius < thickest || thickness / mm_per_cm / radius > usual) return;
  if (!unit_meant("geometry.thickness", thickness).empty()) return;
  lines.push_back(fmt::format("geometry.thickness = {:g} cm is {:.3g} times geometry.radius{}", thickness,
                              thickness / radius,
                              did_you_mean(in_quotes(fmt::format("{:g} mm", thickness)))));
}

}  // namespace

std::vector<std::string> remarks_on_loads(const Scene& scene, const IsPlain& is_plain) {
  std::vector<std::string> lines;
  const Inlet inlet = inlet_from_scene(scene);
  if (!inlet.is_pressure) remark_on_flow(load_of(scene, inlet), scene, is_plain, lines);
  remark_on_times(scene, is_plain, lines);
  remark_on_storage(scene, is_plain, lines);
  remark_on_thickness(scene, is_plain, lines);
  return lines;
}

}  // namespace tunica::scene
