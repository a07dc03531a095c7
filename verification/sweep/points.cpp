// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "core/error.hpp"
#include "core/observables/inputs.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/text.hpp"

namespace tunica::sweep {

namespace {

using Json = nlohmann::ordered_json;

std::vector<Varied> keys_of(const std::vector<Axis>& axes) {
  std::vector<Varied> keys;
  std::set<std::string> seen;
  for (const Axis& axis : axes) {
    if (!seen.insert(axis.key).second)
      throw InvalidInput(fmt::format("--vary: {} is there twice; name each key once", axis.key));
    keys.push_back({axis.key, axis.unit});
  }
  return keys;
}

class Grid final : public Points {
 public:
  explicit Grid(std::vector<Axis> axes) : axes_(std::move(axes)), keys_(keys_of(axes_)) {
    constexpr std::uint64_t most = std::uint64_t{1} << 53;
    for (const Axis& axis : axes_) {
      if (axis.values.empty())
        throw InvalidInput(
            fmt::format("--vary {}: a range or distribution of a sample; add --sample sobol:N, "
                        "or write {}=LO:HI:N for a grid",
                        axis.key, axis.key));
      if (count_ > most / axis.values.size())
        throw InvalidInput("--vary: the grid has too many points to count; vary less, or take a sample");
      count_ *= axis.values.size();
    }
  }
  const std::vector<Varied>& keys() const override { return keys_; }
  std::uint64_t count() const override { return count_; }
  std::vector<std::string> values(std::uint64_t point) override {
    std::vector<std::string> all(axes_.size());
    for (std::size_t k = axes_.size(); k-- > 0;) {
      all[k] = axes_[k].values[point % axes_[k].values.size()];
      point /= axes_[k].values.size();
    }
    return all;
  }
  Json describe() const override {
    Json axes = Json::array();
    for (const Axis& axis : axes_)
      axes.push_back({{"key", axis.key}, {"unit", axis.unit}, {"values", axis.values}});
    return {{"kind", "grid"}, {"parameters", std::move(axes)}};
  }

 private:
  std::vector<Axis> axes_;
  std::vector<Varied> keys_;
  std::uint64_t count_ = 1;
};

/// Axes that a sample can be drawn of. Throws InvalidInput for others.
std::vector<Axis> sampled(std::vector<Axis> axes) {
  for (const Axis& axis : axes) {
    if (!axis.marginal)
      throw InvalidInput(
          fmt::format("--vary {}: values of a grid; with --sample write {}=LO:HI or a "
                      "distribution",
                      axis.key, axis.key));
    if (scene::find_parameter(axis.key)->kind == scene::Kind::integer)
      throw InvalidInput(
          fmt::format("--vary {}: whole numbers are not drawn; take a grid or --points", axis.key));
  }
  return axes;
}

class Sample : public Points {
 public:
  Sample(std::vector<Axis> axes, uncertainty::Sampling sampling, std::uint64_t count, std::uint64_t seed)
      : Sample(std::move(axes), sampling, count, seed, 1) {}
  const std::vector<Varied>& keys() const override { return keys_; }
  std::uint64_t count() const override { return design_.count(); }
  std::vector<std::string> values(std::uint64_t point) override {
    design_.point(point, coordinates_.data());
    return values_at(coordinates_.data());
  }
  Json describe() const override {
    Json axes = Json::array();
    for (const Axis& axis : axes_)
      axes.push_back({{"key", axis.key}, {"unit", axis.unit}, {"distribution", axis.marginal->text()}});
    return {{"kind", uncertainty::name_of(sampling_)}, {"seed", seed_}, {"parameters", std::move(axes)}};
  }

 protected:
  /// Of a design with so many coordinates for each axis.
  Sample(std::vector<Axis> axes, uncertainty::Sampling sampling, std::uint64_t count, std::uint64_t seed,
         int places)
      : axes_(sampled(std::move(axes))),
        keys_(keys_of(axes_)),
        sampling_(sampling),
        seed_(seed),
        design_(sampling, count, places * static_cast<int>(axes_.size()), seed),
        coordinates_(static_cast<std::size_t>(places) * axes_.size()) {}

  std::vector<std::string> values_at(const double* coordinates) const {
    std::vector<std::string> all;
    for (std::size_t k = 0; k < axes_.size(); ++k)
      all.push_back(value_text(axes_[k].marginal->quantile(coordinates[k])));
    return all;
  }

  std::vector<Axis> axes_;
  std::vector<Varied> keys_;
  uncertainty::Sampling sampling_;
  std::uint64_t seed_;
  uncertainty::Design design_;
  std::vector<double> coordinates_;
};

class PickFreezeSample final : public Sample {
 public:
  PickFreezeSample(std::vector<Axis> axes, uncertainty::Sampling sampling, std::uint64_t groups,
                   std::uint64_t seed)
      : Sample(std::move(axes), sampling, groups, seed, 2) {}
  std::uint64_t count() const override { return design_.count() * group_size(); }
  std::vector<std::string> values(std::uint64_t point) override {
    const std::size_t inputs = axes_.size();
    design_.point(point / group_size(), coordinates_.data());
    const std::uint64_t place = point % group_size();
    std::vector<double> at(coordinates_.begin(), coordinates_.begin() + static_cast<std::ptrdiff_t>(inputs));
    for (std::size_t k = 0; k < inputs; ++k)
      if (place == 1 || place == k + 2) at[k] = coordinates_[inputs + k];
    return values_at(at.data());
  }
  Json describe() const override {
    Json all = Sample::describe();
    all["pick_freeze"] = true;
    return all;
  }

 private:
  std::uint64_t group_size() const { return axes_.size() + 2; }
};

class List final : public Points {
 public:
  List(const std::filesystem::path& file, std::vector<Axis> laws) : laws_(std::move(laws)) {
    constexpr std::size_t largest = 1'000'000'000;
    const std::string text = scene::load_text(file, "list of points", ".csv", largest);
    const auto lines = rows_of(text, file.string());
    if (lines.size() < 2)
      throw InvalidInput(
          fmt::format("{}: a header of keys and at least one point are needed", file.string()));
    std::vector<double> factors;
    std::set<std::string> seen;
    for (const std::string& head : lines.front().second) {
      if (head.empty()) throw InvalidInput(fmt::format("{}: a column without a key", file.string()));
      const std::size_t open = head.ends_with(']') ? head.rfind('[') : std::string::npos;
      // An index of a layer stands in brackets too, but never at the end of a key.
      const std::string key = head.substr(0, open);
      const std::string unit = unit_of(key, file.string());
      if (!seen.insert(key).second)
        throw InvalidInput(fmt::format("{}: {} is there twice; name each key once", file.string(), key));
      double factor = 1;
      if (open != std::string::npos) {
        const std::string given = head.substr(open + 1, head.size() - open - 2);
        if (unit.empty())
          throw InvalidInput(fmt::format("{}: {} holds no numbers and has no unit", file.string(), key));
        factor = unit_factor(given, unit, fmt::format("{}: {}", file.string(), head),
                             fmt::format("its unit is {}", unit));
      }
      keys_.push_back({key, unit});
      factors.push_back(factor);
    }
    for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
      const auto& [number, cells] = *line;
      if (cells.size() != keys_.size())
        throw InvalidInput(fmt::format("{}, line {}: {} values for {} keys", file.string(), number,
                                       cells.size(), keys_.size()));
      for (std::size_t k = 0; k < cells.size(); ++k)
        values_.push_back(keys_[k].unit.empty() || cells[k].empty()
                              ? cells[k]
                              : number_text(cells[k], factors[k], file, number, keys_[k].key));
    }
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      std::size_t at = k;
      while (at < values_.size() && values_[at].empty()) at += keys_.size();
      if (at >= values_.size())
        throw InvalidInput(fmt::format("{}: {} has no value in any line", file.string(), keys_[k].key));
    }
    if (!laws_.empty()) check_laws(file);
  }
  const std::vector<Varied>& keys() const override { return keys_; }
  std::uint64_t count() const override { return values_.size() / keys_.size(); }
  std::vector<std::string> values(std::uint64_t point) override {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(point * keys_.size());
    return {first, first + static_cast<std::ptrdiff_t>(keys_.size())};
  }
  Json describe() const override {
    Json keys = Json::array();
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      keys.push_back({{"key", keys_[k].key}, {"unit", keys_[k].unit}});
      if (!laws_.empty()) keys.back()["distribution"] = laws_[k].marginal->text();
    }
    return {{"kind", "list"},
            {"parameters", std::move(keys)},
            {"values", fmt::format("{:016x}", checksum(fmt::format("{}", fmt::join(values_, "\n"))))}};
  }

 private:
  using Row = std::pair<std::size_t, std::vector<std::string>>;  ///< line and cells

  /// Brings the distributions into the order of the keys.
  void check_laws(const std::filesystem::path& file) {
    static_cast<void>(keys_of(laws_));
    laws_ = sampled(std::move(laws_));
    std::vector<Axis> in_order;
    for (const Varied& key : keys_) {
      const auto law =
          std::find_if(laws_.begin(), laws_.end(), [&](const Axis& axis) { return axis.key == key.key; });
      if (key.unit.empty())
        throw InvalidInput(fmt::format(
            "{}: {} holds words, of which there are no indices; choose one by --set {}=..., and leave out "
            "the column",
            file.string(), key.key, key.key));
      if (law == laws_.end())
        throw InvalidInput(
            fmt::format("{}: {} varies; for indices say its range or distribution too, as in --vary {}=LO:HI",
                        file.string(), key.key, key.key));
      in_order.push_back(*law);
    }
    if (in_order.size() < laws_.size())
      for (const Axis& axis : laws_)
        if (std::none_of(keys_.begin(), keys_.end(), [&](const Varied& key) { return key.key == axis.key; }))
          throw InvalidInput(fmt::format("--vary {}: {} has no such column, so that it does not vary",
                                         axis.key, file.string()));
    laws_ = std::move(in_order);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Axis& law = laws_[i % keys_.size()];
      if (values_[i].empty())
        throw InvalidInput(
            fmt::format("{}: {} of point {} is missing; with --vary every point needs its values",
                        file.string(), law.key, i / keys_.size()));
      if (const double value = std::stod(values_[i]); !law.marginal->contains(value))
        throw InvalidInput(fmt::format("{}: {} = {} of point {} is outside of {}", file.string(), law.key,
                                       values_[i], i / keys_.size(), law.marginal->text()));
    }
  }

  static std::vector<Row> rows_of(const std::string& text, const std::string& name) {
    std::vector<Row> rows;
    std::size_t number = 0, begin = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    while (begin < text.size()) {
      std::size_t end = text.find('\n', begin);
      if (end == std::string::npos) end = text.size();
      std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      ++number;
      if (line.ends_with('\r')) line.pop_back();
      if (line.find_first_not_of(" \t") == std::string::npos) continue;
      rows.emplace_back(number, cells_of(line, fmt::format("{}, line {}", name, number)));
    }
    return rows;
  }

  static std::vector<std::string> cells_of(const std::string& line, const std::string& where) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (line[k] == '"') {
        if (quoted && k + 1 < line.size() && line[k + 1] == '"') {
          cells.back() += '"';
          ++k;
        } else {
          quoted = !quoted;
        }
      } else if (line[k] == ',' && !quoted) {
        cells.emplace_back();
      } else {
        cells.back() += line[k];
      }
    }
    if (quoted) throw InvalidInput(where + ": a quotation mark is not closed");
    for (std::string& cell : cells) {
      const std::size_t first = cell.find_first_not_of(" \t");
      cell = first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
    }
    return cells;
  }

  static std::string number_text(const std::string& cell, double factor, const std::filesystem::path& file,
                                 std::size_t line, const std::string& key) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size())
      throw InvalidInput(
          fmt::format("{}, line {}: {} = {} is no number", file.string(), line, key, scene::in_quotes(cell)));
    return value_text(factor == 1 ? value : factor * value);
  }

  std::vector<Varied> keys_;
  std::vector<Axis> laws_;           ///< of the keys, or none
  std::vector<std::string> values_;  ///< of one point after the other
};

}  // namespace

std::unique_ptr<Points> grid_points(std::vector<Axis> axes) {
  return std::make_unique<Grid>(std::move(axes));
}

std::unique_ptr<Points> sample_points(std::vector<Axis> axes, uncertainty::Sampling sampling,
                                      std::uint64_t count, std::uint64_t seed) {
  return std::make_unique<Sample>(std::move(axes), sampling, count, seed);
}

std::unique_ptr<Points> pick_freeze_points(std::vector<Axis> axes, uncertainty::Sampling sampling,
                                           std::uint64_t groups, std::uint64_t seed) {
  return std::make_unique<PickFreezeSample>(std::move(axes), sampling, groups, seed);
}

std::unique_ptr<Points> list_points(const std::filesystem::path& file, std::vector<Axis> laws) {
  return std::make_unique<List>(file, std::move(laws));
}

std::pair<uncertainty::Sampling, std::uint64_t> parse_sample(const std::string& text) {
  using uncertainty::Sampling;
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  std::uint64_t count = 0;
  const char* begin = text.data() + (colon == std::string::npos ? text.size() : colon + 1);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), count);
  for (const Sampling sampling : {Sampling::sobol, Sampling::latin_hypercube, Sampling::random}) {
    if (name != uncertainty::name_of(sampling)) continue;
    if (error != std::errc{} || end != text.data() + text.size() || count == 0)
      throw InvalidInput(fmt::format("--sample {}: write {}:N with a number of points of 1 or more",
                                     scene::one_line(text), name));
    return {sampling, count};
  }
  throw InvalidInput(fmt::format("--sample {}: write sobol:N, lhs:N or random:N", scene::one_line(text)));
}

std::vector<std::string> overrides(const Points& points, const std::vector<std::string>& values) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!values[k].empty()) all.push_back(points.keys()[k].key + "=" + values[k]);
  return all;
}

}  // namespace tunica::sweep
