// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/scene_3d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "app/report/html.hpp"
#include "app/report/quantise.hpp"
#include "app/report/surface.hpp"
#include "core/units.hpp"

namespace tunica::embedded {
std::string_view viewer_template();
std::string_view viewer_camera();
std::string_view viewer_script();
std::string_view viewer_shaders();
std::string_view three_script();
}  // namespace tunica::embedded

namespace tunica::report {

namespace {

using namespace observables;
using Rows = std::vector<std::vector<float>>;  // [frame][place]

/// A scalar as the viewer speaks of it.
struct Shown {
  std::string name;
  std::string label;
  std::string unit;
  Rows rows;
};

struct ShownPart {
  std::string name;
  std::array<bool, 2> mirrored;
  double cut;
  Surface surface;
  std::vector<float> points;  // of the places, unloaded
  Rows displacement;          // [frame][component + 3 * place]
  std::vector<Shown> fields;
};

struct ShownRun {
  std::string label;
  double beat = none;    ///< s, start of the last whole beat
  double period = none;  ///< s, its length
  double peak = none;    ///< s, when its inflow is largest
  std::vector<double> times;
  std::vector<ShownPart> parts;
};

/// How much of the values goes into the page.
struct Detail {
  int bytes;
  std::size_t stride;
};

constexpr double stress_unit = 1e5;  // dyn/cm2

double display_unit(const PointField& field) {
  if (field.unit != "dyn/cm2") return 1;
  return field.name.find("pressure") != std::string::npos ? mmhg : stress_unit;
}

std::string display_unit_name(const PointField& field) {
  if (field.unit == "dyn/cm2") return display_unit(field) == mmhg ? "mmHg" : "10\u2075 dyn/cm²";
  return field.unit == "1" ? "" : field.unit;
}

/// "recruitment.2" as "Recruitment, family 2".
std::string label_of(const PointField& field) {
  const std::size_t dot = field.name.find('.');
  std::string label = field.name.substr(0, dot);
  std::replace(label.begin(), label.end(), '_', ' ');
  if (label == "von mises") label = "von Mises stress";
  if (!label.empty() && label[0] >= 'a' && label[0] <= 'z')
    label[0] = static_cast<char>(label[0] - 'a' + 'A');
  if (dot != std::string::npos) label += ", family " + field.name.substr(dot + 1);
  return label;
}

std::vector<float> scalars(const std::vector<float>& values, std::size_t components, double unit) {
  std::vector<float> made;
  made.reserve(values.size() / components);
  for (std::size_t at = 0; at < values.size(); at += components) {
    double value = values[at];
    if (components == 3) value = std::hypot(values[at], values[at + 1], values[at + 2]);
    made.push_back(static_cast<float>(value / unit));
  }
  return made;
}

/// Share of the surface that belongs to each of its places: a third of the triangles around it.
std::vector<double> areas(const Surface& surface, const std::vector<float>& points) {
  std::vector<double> areas(surface.places.size(), 0.0);
  for (const auto* triangles : {&surface.outer, &surface.section})
    for (const auto& triangle : *triangles) {
      std::array<std::array<double, 3>, 2> sides{};
      for (int s = 0; s < 2; ++s)
        for (int i = 0; i < 3; ++i)
          sides[s][i] = points[3 * surface.vertices[triangle[s + 1]] + i] -
                        points[3 * surface.vertices[triangle[0]] + i];
      const double area = std::hypot(sides[0][1] * sides[1][2] - sides[0][2] * sides[1][1],
                                     sides[0][2] * sides[1][0] - sides[0][0] * sides[1][2],
                                     sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]);
      for (const int vertex : triangle) areas[surface.vertices[vertex]] += area / 6;
    }
  return areas;
}

ShownPart shown_part(const FieldSeries& series, double cut) {
  ShownPart part{series.name, series.mesh.mirrored, cut, visible_surface(series.mesh, cut), {}, {}, {}};
  std::vector<float> coordinates;
  for (const auto& point : series.mesh.points)
    for (const double coordinate : point) coordinates.push_back(static_cast<float>(coordinate));
  part.points = at_places(part.surface, coordinates, 3);
  for (std::size_t f = 0; f < series.point_fields.size(); ++f) {
    const PointField& field = series.point_fields[f];
    Rows rows;
    for (const auto& frame : series.frames)
      rows.push_back(at_places(part.surface, frame.values[f], field.components));
    const bool is_displacement = field.name == "displacement" && field.components == 3;
    // Vectors without unit are directions: their length tells nothing.
    if (field.components == 3 && field.unit == "1") continue;
    Shown shown{field.name, label_of(field), display_unit_name(field), {}};
    for (const auto& row : rows) shown.rows.push_back(scalars(row, field.components, display_unit(field)));
    part.fields.push_back(std::move(shown));
    if (is_displacement) part.displacement = std::move(rows);
  }
  return part;
}

bool in_space(const FieldSeries& series) {
  return series.mesh.shape == CellShape::hexahedron || series.mesh.shape == CellShape::tetrahedron;
}

/// The height of the lengthwise section: the plane of symmetry, or the middle.
double height_of_cut(const std::vector<const FieldSeries*>& all) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const FieldSeries* series : all) {
    if (series->mesh.mirrored[1]) return 0;
    for (const auto& point : series->mesh.points) {
      lowest = std::min(lowest, point[1]);
      highest = std::max(highest, point[1]);
    }
  }
  const double middle = (lowest + highest) / 2;
  constexpr double negligible = 1e-3;
  return std::abs(middle) < negligible * (highest - lowest) ? 0 : middle;
}

ShownRun shown_run(const RunSummary& summary) {
  const auto& own = summary.stored->result.fields;
  const auto stored = own.empty() ? read_space_fields(summary.stored->folder) : std::vector<FieldSeries>{};
  std::vector<const FieldSeries*> all;
  for (const FieldSeries& series : own.empty() ? stored : own)
    if (in_space(series) && !series.frames.empty() && !series.mesh.cells.empty()) all.push_back(&series);
  ShownRun run;
  run.label = summary.label;
  if (all.empty()) return run;
  if (!summary.is_state && summary.beat.whole) {
    run.beat = summary.beat.start;
    run.period = summary.beat.period;
    run.peak = run.beat + summary.systole;
  }
  const double cut = height_of_cut(all);
  std::size_t frames = all.front()->frames.size();
  for (const FieldSeries* series : all) frames = std::min(frames, series->frames.size());
  for (std::size_t k = 0; k < frames; ++k) run.times.push_back(all.front()->frames[k].time);
  for (const FieldSeries* series : all) run.parts.push_back(shown_part(*series, cut));
  return run;
}

/// Every stride-th time, the last among them and that of the peak flow.
std::vector<std::size_t> kept_times(const ShownRun& run, std::size_t stride) {
  const std::size_t count = run.times.size();
  std::size_t peak = count;
  for (std::size_t k = 0; k < count && !is_none(run.peak); ++k)
    if (peak == count || std::abs(run.times[k] - run.peak) < std::abs(run.times[peak] - run.peak)) peak = k;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < count; ++k)
    if (k % stride == (count - 1) % stride || k == peak) kept.push_back(k);
  return kept;
}

Rows thinned(const Rows& rows, const std::vector<std::size_t>& kept) {
  Rows some;
  for (const std::size_t k : kept) some.push_back(rows[k]);
  return some;
}

std::size_t size_of(const ShownRun& run, const Detail& detail) {
  const std::size_t frames = kept_times(run, detail.stride).size();
  std::size_t bytes = 0;
  for (const ShownPart& part : run.parts) {
    const Surface& surface = part.surface;
    bytes += 12 * surface.places.size() + 4 * surface.vertices.size() +
             12 * (surface.outer.size() + surface.section.size());
    bytes += frames * surface.places.size() *
             (detail.bytes * part.fields.size() + (part.displacement.empty() ? 0 : 6));
  }
  return bytes / 3 * 4;
}

nlohmann::ordered_json to_json(const Quantised& values, int bytes) {
  return {{"bytes", bytes}, {"lowest", values.lowest}, {"step", values.step}, {"data", base64(values.bytes)}};
}

std::vector<std::uint32_t> indices(const std::vector<Surface::Triangle>& triangles) {
  std::vector<std::uint32_t> made;
  for (const auto& triangle : triangles)
    for (const int vertex : triangle) made.push_back(static_cast<std::uint32_t>(vertex));
  return made;
}

bool has_gaps(const Rows& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const auto& row) {
    return std::any_of(row.begin(), row.end(), [](float value) { return !std::isfinite(value); });
  });
}

nlohmann::ordered_json to_json(const ShownPart& part, const std::vector<std::size_t>& kept, int bytes) {
  nlohmann::ordered_json json{{"name", part.name},
                              {"mirrored", part.mirrored},
                              {"cut", part.cut},
                              {"points", base64_of(part.points)},
                              {"vertices", base64_of(part.surface.vertices)},
                              {"outer", base64_of(indices(part.surface.outer))},
                              {"section", base64_of(indices(part.surface.section))}};
  if (!part.displacement.empty()) {
    const Rows rows = thinned(part.displacement, kept);
    json["displacement"] = to_json(quantise(rows, span_of(rows), 2), 2);
  }
  json["fields"] = nlohmann::ordered_json::array();
  const auto weights = areas(part.surface, part.points);
  for (const Shown& field : part.fields) {
    const Rows rows = thinned(field.rows, kept);
    // With 8 bits all of them serve the colours; values beyond take the last one.
    const Span colours = telling_span(rows, weights), whole = span_of(rows);
    auto values = to_json(quantise(rows, bytes == 1 ? colours : whole, bytes), bytes);
    values["name"] = field.name;
    values["label"] = field.label;
    values["unit"] = field.unit;
    values["has_gaps"] = has_gaps(rows);
    values["colours"] = {colours.lowest, colours.highest};
    values["range"] = {whole.lowest, whole.highest};
    json["fields"].push_back(std::move(values));
  }
  return json;
}

std::string notes_on(const Detail& detail) {
  std::string notes;
  if (detail.stride > 1)
    notes += fmt::format("To keep this file small, only one in {} of the times of fields/ is shown. ",
                         detail.stride);
  if (detail.bytes == 1) notes += "To keep this file small, values are shown in 254 steps. ";
  return notes;
}

}  // namespace

Scene3d scene_3d(const std::vector<RunSummary>& runs, std::size_t budget) {
  std::vector<ShownRun> all;
  for (const RunSummary& summary : runs) {
    ShownRun run = shown_run(summary);
    if (!run.parts.empty()) all.push_back(std::move(run));
  }
  if (all.empty()) return {};
  std::size_t most = 0;
  for (const ShownRun& run : all) most = std::max(most, run.times.size());
  Detail detail{2, 1};
  const auto total = [&] {
    std::size_t sum = 0;
    for (const ShownRun& run : all) sum += size_of(run, detail);
    return sum;
  };
  if (total() > budget) detail.bytes = 1;
  while (total() > budget && detail.stride < most) ++detail.stride;
  if (total() > budget)
    return {
        "",
        "<p class=\"note\">The fields have too many cells to be shown here; fields/ is for ParaView.</p>\n"};
  nlohmann::ordered_json json;
  for (const ShownRun& run : all) {
    const std::vector<std::size_t> kept = kept_times(run, detail.stride);
    nlohmann::ordered_json times = nlohmann::ordered_json::array(), parts = times;
    for (const std::size_t k : kept) times.push_back(run.times[k]);
    for (const ShownPart& part : run.parts) parts.push_back(to_json(part, kept, detail.bytes));
    nlohmann::ordered_json one{{"label", run.label}, {"times", times}, {"parts", parts}};
    if (!is_none(run.beat)) one["beat"] = {run.beat, run.period};
    if (!is_none(run.peak)) one["peak"] = run.peak;
    json["runs"].push_back(std::move(one));
  }
  return {script_json(json), notes_on(detail)};
}

std::string viewer_section(const Scene3d& scene) {
  if (scene.json.empty()) return scene.notes;
  return fill(embedded::viewer_template(), {{"notes", scene.notes}});
}

std::string viewer_scripts(const Scene3d& scene) {
  if (scene.json.empty()) return {};
  return fmt::format(
      "<script type=\"application/json\" id=\"scene\">{}</script>\n<script>{}</script>\n"
      "<script>\n{}{}{}</script>\n",
      scene.json, embedded::three_script(), embedded::viewer_shaders(), embedded::viewer_camera(),
      embedded::viewer_script());
}

std::string viewer_credit(const Scene3d& scene) {
  if (scene.json.empty()) return {};
  return " Pictures in space by three.js 0.187.0 © three.js authors, MIT licence.";
}

}  // namespace tunica::report
