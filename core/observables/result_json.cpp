// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/result_json.hpp"

#include <array>

namespace tunica::json {

namespace {

using Json = nlohmann::json;
using namespace observables;

constexpr std::pair<const char*, Table Result::*> tables[] = {
    {"observables", &Result::observables},
    {"profiles", &Result::profiles},
    {"events", &Result::events},
    {"sensitivities", &Result::sensitivities},
    {"event_sensitivities", &Result::event_sensitivities},
    {"recruited_time", &Result::recruited_time},
    {"compartments", &Result::compartments},
    {"along", &Result::along}};

constexpr std::pair<const char*, long RunRecord::*> counts[] = {
    {"unknowns", &RunRecord::unknowns},
    {"steps", &RunRecord::steps},
    {"newton_iterations", &RunRecord::newton_iterations},
    {"linear_iterations", &RunRecord::linear_iterations},
    {"rejected_steps", &RunRecord::rejected_steps}};

Json from_table(const Table& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns())
    columns.push_back({{"name", column.name},
                       {"unit", column.unit},
                       {"values", binary(column.values)},
                       {"labels", column.labels}});
  return columns;
}

Table to_table(const Json& columns) {
  Table table;
  for (const Json& column : columns) {
    const std::size_t index = table.add(column.at("name"), column.at("unit"));
    table[index].values = numbers<double>(column.at("values"));
    table[index].labels = column.at("labels").get<std::vector<std::string>>();
  }
  return table;
}

Json from_series(const FieldSeries& series) {
  Json cell_fields = Json::array(), point_fields = Json::array(), frames = Json::array();
  for (const CellField& field : series.cell_fields)
    cell_fields.push_back({{"name", field.name}, {"unit", field.unit}, {"values", binary(field.values)}});
  for (const PointField& field : series.point_fields)
    point_fields.push_back({{"name", field.name}, {"unit", field.unit}, {"components", field.components}});
  for (const FieldSeries::Frame& frame : series.frames) {
    Json values = Json::array();
    for (const auto& field : frame.values) values.push_back(binary(field));
    frames.push_back({{"time", frame.time}, {"values", std::move(values)}});
  }
  return {{"name", series.name},
          {"shape", static_cast<int>(series.mesh.shape)},
          {"points", binary(series.mesh.points)},
          {"cells", binary(series.mesh.cells)},
          {"cell_fields", std::move(cell_fields)},
          {"point_fields", std::move(point_fields)},
          {"frames", std::move(frames)}};
}

FieldSeries to_series(const Json& value) {
  FieldSeries series;
  series.name = value.at("name");
  series.mesh.shape = static_cast<CellShape>(value.at("shape").get<int>());
  series.mesh.points = numbers<std::array<double, 3>>(value.at("points"));
  series.mesh.cells = numbers<int>(value.at("cells"));
  for (const Json& field : value.at("cell_fields"))
    series.cell_fields.push_back({field.at("name"), field.at("unit"), numbers<int>(field.at("values"))});
  for (const Json& field : value.at("point_fields"))
    series.point_fields.push_back({field.at("name"), field.at("unit"), field.at("components")});
  for (const Json& frame : value.at("frames")) {
    FieldSeries::Frame& back = series.frames.emplace_back();
    back.time = frame.at("time");
    for (const Json& field : frame.at("values")) back.values.push_back(numbers<float>(field));
  }
  return series;
}

Json from_record(const RunRecord& record) {
  // As text, since the order of its keys is part of it.
  Json value = {{"tier", record.tier},
                {"resolution", record.resolution.dump()},
                {"setup_seconds", record.setup_seconds},
                {"solve_seconds", record.solve_seconds},
                {"median_step_seconds", binary(std::vector<double>{record.median_step_seconds})},
                {"converged", record.converged},
                {"interrupted", record.interrupted},
                {"failure", record.failure},
                {"remarks", record.remarks},
                {"findings", record.findings}};
  for (const auto& [name, count] : counts) value[name] = record.*count;
  return value;
}

RunRecord to_record(const Json& value) {
  RunRecord record;
  record.tier = value.at("tier");
  record.resolution = nlohmann::ordered_json::parse(value.at("resolution").get<std::string>());
  record.setup_seconds = value.at("setup_seconds");
  record.solve_seconds = value.at("solve_seconds");
  record.median_step_seconds = numbers<double>(value.at("median_step_seconds")).at(0);
  record.converged = value.at("converged");
  record.interrupted = value.at("interrupted");
  record.failure = value.at("failure");
  record.remarks = value.at("remarks").get<std::vector<std::string>>();
  record.findings = value.at("findings").get<std::vector<std::string>>();
  for (const auto& [name, count] : counts) record.*count = value.at(name);
  return record;
}

}  // namespace

Json from_result(const Result& result) {
  Json value = {{"record", from_record(result.record)}, {"fields", Json::array()}};
  for (const auto& [name, table] : tables) value["tables"][name] = from_table(result.*table);
  for (const FieldSeries& series : result.fields) value["fields"].push_back(from_series(series));
  return value;
}

Result to_result(const Json& value) {
  Result result;
  result.record = to_record(value.at("record"));
  for (const auto& [name, table] : tables) result.*table = to_table(value.at("tables").at(name));
  for (const Json& series : value.at("fields")) result.fields.push_back(to_series(series));
  return result;
}

}  // namespace tunica::json
