// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/sweep_indices.hpp"

#include <fmt/format.h>

#include <charconv>

#include "app/report/html.hpp"
#include "app/report/json_object.hpp"
#include "core/error.hpp"
#include "core/observables/table.hpp"
#include "verification/sweep/surrogate_table.hpp"

namespace tunica::report {

namespace fs = std::filesystem;

namespace {

constexpr int digits = 5;

/// indices.csv has no units, so that its numbers are read as texts.
std::vector<double> plain_numbers(const observables::Table& table, const char* name, const fs::path& file) {
  const observables::Column* column = table.find(name);
  if (!column)
    throw InvalidInput(fmt::format("{}: has no column {}; compute the indices again", file.string(), name));
  if (!column->is_text()) return column->values;
  std::vector<double> numbers;
  for (const std::string& text : column->labels) {
    double value = observables::none;
    if (const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        !text.empty() && (error != std::errc{} || end != text.data() + text.size()))
      throw InvalidInput(fmt::format("{}: {} is no number, in column {}", file.string(), text, name));
    numbers.push_back(value);
  }
  return numbers;
}

void append_surrogate(std::string& json, const nlohmann::ordered_json& surrogate) {
  Object object(json);
  for (const char* name : {"quantity", "kind", "reason"})
    if (surrogate.contains(name)) object.text(name, surrogate.at(name).get<std::string>());
  for (const char* name : {"q2", "points"})
    if (surrogate.contains(name)) object.value(name, surrogate.at(name));
}

}  // namespace

void append_indices(std::string& json, const fs::path& folder, const nlohmann::ordered_json& campaign) {
  const fs::path file = folder / "indices.csv";
  if (!fs::exists(file)) {
    json += "null";
    return;
  }
  const observables::Table table = observables::read_csv(file.string());
  const observables::Column *quantity = table.find("quantity"), *parameter = table.find("parameter");
  if (!quantity || !parameter || !quantity->is_text() || !parameter->is_text())
    throw InvalidInput(fmt::format("{}: has no columns quantity and parameter", file.string()));
  const auto append_text = [](std::string& out, const std::string& text) { out += script_string(text); };
  Object object(json);
  append_list(object.key("quantity"), quantity->labels, append_text);
  append_list(object.key("parameter"), parameter->labels, append_text);
  for (const char* name : {"first", "first_low", "first_high", "total", "total_low", "total_high"})
    append_array(object.key(name), plain_numbers(table, name, file), 1, digits);
  append_list(object.key("surrogates"), campaign.value("surrogates", nlohmann::ordered_json::array()),
              append_surrogate);
}

std::string tiers_section(const fs::path& folder, const nlohmann::ordered_json& campaign) {
  const fs::path file = folder / sweep::fidelities_file;
  if (!campaign.at("design").contains("fidelities") || !fs::exists(file)) return {};
  const observables::Table table = observables::read_csv(file.string());
  std::string body;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto text = [&](const char* name) {
      const observables::Column* column = table.find(name);
      if (!column || !column->is_text())
        throw InvalidInput(fmt::format("{}: has no column {} of texts", file.string(), name));
      return escape(column->labels[row]);
    };
    const auto value = [&](const char* name) { return plain_numbers(table, name, file)[row]; };
    const double range = value("range");
    // Quantities that nothing varies differ by rounding.
    if (!(range > 0)) continue;
    body += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{} of "
        "{}</td></tr>",
        text("quantity"), text("dear"), number(100 * value("mean_difference") / range, 2),
        number(100 * value("largest_difference") / range, 2), value("largest_at"), value("beyond_5_percent"),
        value("points"));
  }
  if (body.empty()) return {};
  const std::string cheap = campaign.at("design").at("fidelities").at(0).at("tier");
  return fmt::format(
      "<section aria-labelledby=\"tiers\">\n  <h2 id=\"tiers\">Where tiers differ</h2>\n  {}</section>\n",
      report::table(
          fmt::format(
              "What dearer tiers find, less what the {} tier finds at the same points, in per cent of the "
              "range that both span there. Everything above is of the {} tier, but for Sobol’ indices, "
              "which are those of the dearest.",
              escape(cheap), escape(cheap)),
          "<tr><th scope=\"col\">Quantity</th><th scope=\"col\" class=\"text\">Tier</th>"
          "<th scope=\"col\">Mean difference</th><th scope=\"col\">Largest</th>"
          "<th scope=\"col\">At point</th>"
          "<th scope=\"col\">Beyond 5 %</th></tr>",
          body));
}

}  // namespace tunica::report
