// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica::run {

namespace {

struct Entry {
  Statistic statistic;
  const char* name;
};
constexpr std::array entries{Entry{Statistic::max, "max"},
                             Entry{Statistic::min, "min"},
                             Entry{Statistic::mean, "mean"},
                             Entry{Statistic::change, "change"},
                             Entry{Statistic::time_of_max, "time_of_max"},
                             Entry{Statistic::time_of_min, "time_of_min"},
                             Entry{Statistic::drift, "drift"},
                             Entry{Statistic::share, "share"},
                             Entry{Statistic::on, "on"},
                             Entry{Statistic::off, "off"},
                             Entry{Statistic::max_place, "max_place"},
                             Entry{Statistic::periodic, "periodic"}};

const char* name_of(Statistic statistic) {
  return std::find_if(entries.begin(), entries.end(),
                      [&](const Entry& e) { return e.statistic == statistic; })
      ->name;
}

std::vector<Quantity> make_quantities() {
  std::vector<Quantity> all;
  const auto add = [&](const std::string& observable, std::initializer_list<Statistic> statistics) {
    for (const Statistic statistic : statistics) all.push_back({observable, statistic});
  };
  const observables::Table table = observables::standard_table();
  for (const auto& column : table.columns()) {
    if (column.name == "time") continue;
    add(column.name, {Statistic::max, Statistic::min, Statistic::mean, Statistic::change,
                      Statistic::time_of_max, Statistic::time_of_min, Statistic::drift});
    if (column.name.starts_with("recruitment."))
      add(column.name, {Statistic::share, Statistic::on, Statistic::off});
  }
  add("von_mises", {Statistic::max, Statistic::max_place});
  add("beat", {Statistic::periodic});
  return all;
}

}  // namespace

std::string Quantity::name() const {
  return fmt::format("{}.{}", observable, name_of(statistic));
}

std::string Quantity::unit() const {
  switch (statistic) {
    case Statistic::time_of_max:
    case Statistic::time_of_min:
    case Statistic::on:
    case Statistic::off:
      return "s";
    case Statistic::share:
    case Statistic::max_place:
    case Statistic::periodic:
      return "1";
    default:
      break;
  }
  static const observables::Table table = observables::standard_table();
  const auto* column = table.find(observable);
  return column ? column->unit : table.find(observable + ".P1")->unit;
}

const std::vector<Quantity>& known_quantities() {
  static const std::vector<Quantity> all = make_quantities();
  return all;
}

Quantity parse_quantity(std::string_view name) {
  std::vector<std::string> names;
  for (const Quantity& quantity : known_quantities()) {
    names.push_back(quantity.name());
    if (names.back() == name) return quantity;
  }
  const std::string near = scene::nearest(name, names);
  throw InvalidInput(fmt::format("{} is not a quantity{}", scene::in_quotes(std::string(name)),
                                 near.empty()
                                     ? "; write OBSERVABLE.STATISTIC, such as pressure.max, "
                                       "radial_displacement.P1.change, recruitment.P4.share or von_mises.max"
                                     : scene::did_you_mean(near)));
}

}  // namespace tunica::run
