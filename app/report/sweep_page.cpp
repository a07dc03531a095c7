// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/report/html.hpp"
#include "app/report/json_object.hpp"
#include "app/report/sections.hpp"
#include "app/report/sweep_indices.hpp"
#include "app/report/sweep_table.hpp"
#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "verification/sweep/campaign.hpp"

namespace tunica::embedded {
std::string_view sweep_template();
std::string_view report_style();
std::string_view sweep_style();
std::string_view report_chart_script();
std::string_view sweep_plots_script();
std::string_view sweep_script();
std::string_view uplot_style();
std::string_view uplot_script();
}  // namespace tunica::embedded

namespace tunica {

namespace fs = std::filesystem;

namespace report {

namespace {

constexpr int digits = 5;
constexpr std::size_t most_drawn = 2000;            // points, one by one
constexpr std::size_t most_drawn_numbers = 250000;  // all their numbers together
constexpr std::size_t most_paired = 4;              // keys whose pairs have heat maps
constexpr std::size_t most_curves = 12;             // points, as many as there are colours

void append_key(std::string& json, const SweepKey& key) {
  Object object(json);
  object.text("name", key.name);
  object.text("unit", key.unit == "1" ? "" : key.unit);
  object.key("log") += key.is_log ? "true" : "false";
  object.key("binned") += key.is_binned ? "true" : "false";
  if (key.is_text())
    append_list(object.key("texts"), key.texts,
                [](std::string& out, const std::string& text) { out += script_string(text); });
  object.value("lowest", key.lowest);
  object.value("highest", key.highest);
  append_array(object.key("places"), key.places, 1, digits);
}

void append_quantity(std::string& json, const SweepQuantity& quantity) {
  Object object(json);
  object.text("name", quantity.name);
  object.text("unit", quantity.unit == "1" ? "" : quantity.unit == "deg" ? "°" : quantity.unit);
}

void append_spread(std::string& json, const LevelSpread& found) {
  Object object(json);
  append_array(object.key("count"), found.count, 1, digits);
  append_array(object.key("mean"), found.mean, 1, digits);
  append_array(object.key("q05"), found.q05, 1, digits);
  append_array(object.key("q25"), found.q25, 1, digits);
  append_array(object.key("q50"), found.q50, 1, digits);
  append_array(object.key("q75"), found.q75, 1, digits);
  append_array(object.key("q95"), found.q95, 1, digits);
}

/// Rows that are drawn one by one: all, or those whose lots are lowest, in the order of points.
std::vector<std::size_t> drawn_rows(const SweepTable& table) {
  const std::size_t columns = 1 + table.keys.size() + table.quantities.size();
  const std::size_t most = std::min(most_drawn, most_drawn_numbers / columns + 1);
  std::vector<std::size_t> rows(table.numbers.size());
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = k;
  if (rows.size() <= most) return rows;
  const auto lot = [&](std::size_t row) { return lot_of(table.numbers[row]); };
  std::nth_element(rows.begin(), rows.begin() + static_cast<long>(most), rows.end(),
                   [&](std::size_t a, std::size_t b) { return lot(a) < lot(b); });
  rows.resize(most);
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::vector<double> taken(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> found;
  for (const std::size_t row : rows) found.push_back(values[row]);
  return found;
}

/// Points with whole results in the folder: those chosen, then others by their numbers.
std::vector<std::uint64_t> points_with_curves(const fs::path& folder,
                                              const std::vector<std::uint64_t>& chosen) {
  std::vector<std::uint64_t> found, others = chosen;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder / "points", missing)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc{} && end == name.data() + name.size() && fs::exists(entry.path() / "record.json"))
      others.push_back(number);
  }
  std::sort(others.begin() + static_cast<long>(chosen.size()), others.end());
  for (const std::uint64_t point : others)
    if (std::find(found.begin(), found.end(), point) == found.end()) found.push_back(point);
  if (found.size() > most_curves) found.resize(most_curves);
  return found;
}

void append_points(std::string& json, const SweepTable& table) {
  const auto rows = drawn_rows(table);
  Object points(json);
  std::vector<double> numbers;
  for (const std::size_t row : rows) numbers.push_back(static_cast<double>(table.numbers[row]));
  append_array(points.key("number"), numbers, 1, 17);
  const auto append_column = [&](std::string& out, const std::vector<double>& column) {
    append_array(out, taken(column, rows), 1, digits);
  };
  append_list(points.key("keys"), table.key_values, append_column);
  append_list(points.key("values"), table.values, append_column);
  append_list(points.key("done"), rows,
              [&](std::string& out, std::size_t row) { out += table.is_done[row] ? '1' : '0'; });
}

std::string failures_section(const SweepTable& table) {
  if (table.failures.empty()) return {};
  std::string body;
  for (const SweepFailure& failure : table.failures) {
    std::string points;
    for (const std::uint64_t point : failure.points)
      points += (points.empty() ? "" : ", ") + fmt::format("{}", point);
    if (failure.count > failure.points.size()) points += ", …";
    body += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td>{}</td><td class=\"text\">{}</td></tr>",
        escape(failure.status), escape(failure.reason), failure.count, points);
  }
  return fmt::format(
      "<section aria-labelledby=\"failures\">\n  <h2 id=\"failures\">Points without a result</h2>\n"
      "  {}</section>\n",
      report::table(
          "What gave up began and could not be computed; what was refused is no scene. They are left "
          "out of every mean and quantile above.",
          "<tr><th scope=\"col\">Status</th><th scope=\"col\" class=\"text\">Reason</th>"
          "<th scope=\"col\">Points</th><th scope=\"col\" class=\"text\">Numbers</th></tr>",
          body));
}

/// A word for a POSIX shell.
std::string shell_word(const std::string& text) {
  const bool is_plain = !text.empty() && text.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_./=+,:@%-") == std::string::npos;
  if (is_plain && text.front() != '-') return text;
  std::string quoted = "'";
  for (const char character : text)
    quoted += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return quoted + "'";
}

std::string counts(const SweepTable& table) {
  std::string text = fmt::format("{} of {} points", table.ended, table.planned);
  if (table.ended == table.planned) text = fmt::format("{} points", table.planned);
  if (table.done < table.ended) text += fmt::format(", {} without a result", table.ended - table.done);
  return text;
}

std::string remark_on_size(const SweepTable& table, std::size_t drawn) {
  std::string text;
  if (table.numbers.size() < table.ended)
    text += fmt::format("Curves, maps and bars are made of {} of the {} points, taken as by chance. ",
                        table.numbers.size(), table.ended);
  if (drawn < table.numbers.size())
    text += fmt::format("{} points are drawn one by one, taken as by chance. ", drawn);
  return text.empty() ? "All points are drawn. " : text + "sweep.csv has all of them. ";
}

}  // namespace

}  // namespace report

std::string make_sweep_report(const fs::path& folder, const std::vector<std::uint64_t>& chosen) {
  using namespace report;
  const SweepTable table = read_sweep(folder);
  const auto campaign = sweep::read_campaign(folder);
  std::vector<std::size_t> key_indices, quantity_indices;
  for (std::size_t k = 0; k < table.keys.size(); ++k) key_indices.push_back(k);
  for (std::size_t q = 0; q < table.quantities.size(); ++q) quantity_indices.push_back(q);

  const auto numbers = points_with_curves(folder, chosen);
  std::vector<StoredResult> stored;
  for (const std::uint64_t point : numbers)
    stored.push_back(read_result(folder / "points" / fmt::format("{}", point)));

  std::string data;
  {
    Object all(data);
    all.text("command", "tunica report " + shell_word(folder.string()) + " --point ");
    append_list(all.key("keys"), table.keys, append_key);
    append_list(all.key("quantities"), table.quantities, append_quantity);
    append_list(all.key("effects"), quantity_indices, [&](std::string& out, std::size_t quantity) {
      append_list(out, key_indices, [&](std::string& json, std::size_t key) {
        append_spread(json, spread(table, key, quantity));
      });
    });
    const std::size_t paired = std::min(most_paired, table.keys.size());
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < paired; ++a)
      for (std::size_t b = a + 1; b < paired; ++b) pairs.emplace_back(a, b);
    append_list(all.key("pairs"), pairs, [&](std::string& out, const auto& pair) {
      Object object(out);
      object.value("first", static_cast<double>(pair.first));
      object.value("second", static_cast<double>(pair.second));
      append_list(object.key("means"), quantity_indices, [&](std::string& json, std::size_t quantity) {
        append_array(json, cell_means(table, pair.first, pair.second, quantity), 1, digits);
      });
    });
    append_points(all.key("points"), table);
    append_indices(all.key("indices"), folder, campaign);
    append_list(all.key("curve_points"), numbers,
                [](std::string& out, std::uint64_t point) { out += fmt::format("{}", point); });
    all.key("curves") += stored.empty() ? "{\"runs\":[]}" : chart_data(summarize(stored));
  }
  const std::string scene = campaign.value("scene", "sweep");
  return fill(
      embedded::sweep_template(),
      {{"title", escape(scene)},
       {"subtitle", escape(fmt::format("Sweep · {} · {} tier", counts(table), campaign.value("tier", "")))},
       {"version", escape(program_version())},
       {"uplot_style", std::string(embedded::uplot_style())},
       {"style", std::string(embedded::report_style())},
       {"sweep_style", std::string(embedded::sweep_style())},
       {"tiers", tiers_section(folder, campaign)},
       {"failures", failures_section(table)},
       {"size", remark_on_size(table, drawn_rows(table).size())},
       {"scene", escape(campaign.value("scene_toml", ""))},
       {"data", data},
       {"uplot_script", std::string(embedded::uplot_script())},
       {"chart_script", std::string(embedded::report_chart_script())},
       {"plots_script", std::string(embedded::sweep_plots_script())},
       {"script", std::string(embedded::sweep_script())}});
}

}  // namespace tunica
