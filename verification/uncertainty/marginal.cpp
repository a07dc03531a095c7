// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/marginal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/scene.hpp"

namespace tunica::uncertainty {

namespace {

struct Entry {
  std::string_view name;
  Marginal::Kind kind;
  std::size_t parameters;
  const char* form;
};
constexpr std::array entries{Entry{"uniform", Marginal::Kind::uniform, 2, "uniform(A,B)"},
                             Entry{"loguniform", Marginal::Kind::log_uniform, 2, "loguniform(A,B)"},
                             Entry{"normal", Marginal::Kind::normal, 2, "normal(M,SD)"},
                             Entry{"lognormal", Marginal::Kind::lognormal, 2, "lognormal(M,SD)"},
                             Entry{"triangular", Marginal::Kind::triangular, 3, "triangular(A,C,B)"}};

/// Deviation and mean of the logarithm of a lognormal number.
double log_deviation(const Marginal& of) {
  return std::sqrt(std::log1p((of.b / of.a) * (of.b / of.a)));
}
double log_mean(const Marginal& of) {
  const double deviation = log_deviation(of);
  return std::log(of.a) - 0.5 * deviation * deviation;
}

double number_from(const std::string& text, const std::string& key, const std::string& unit) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  return convert_quantity(text, unit, key);
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

void check(const Marginal& of, const std::string& key, std::string_view text) {
  const auto refuse = [&](const char* why) {
    throw InvalidInput(fmt::format("{} = {}: {}", key, std::string(text), why));
  };
  if (!std::isfinite(of.a) || !std::isfinite(of.b) || !std::isfinite(of.c))
    refuse("numbers have to be finite");
  switch (of.kind) {
    case Marginal::Kind::uniform:
      if (!(of.a < of.b)) refuse("A has to be below B");
      break;
    case Marginal::Kind::log_uniform:
      if (!(of.a > 0 && of.a < of.b)) refuse("A has to be above 0 and below B");
      break;
    case Marginal::Kind::normal:
      if (!(of.b > 0)) refuse("the standard deviation has to be above 0");
      break;
    case Marginal::Kind::lognormal:
      if (!(of.a > 0 && of.b > 0)) refuse("mean and standard deviation have to be above 0");
      break;
    case Marginal::Kind::triangular:
      if (!(of.a <= of.c && of.c <= of.b && of.a < of.b)) refuse("write A <= C <= B, A below B");
      break;
  }
}

}  // namespace

double Marginal::quantile(double p) const {
  switch (kind) {
    case Kind::uniform:
      return a + p * (b - a);
    case Kind::log_uniform:
      return a * std::pow(b / a, p);
    case Kind::normal:
      return a + gsl_cdf_gaussian_Pinv(p, b);
    case Kind::lognormal:
      return gsl_cdf_lognormal_Pinv(p, log_mean(*this), log_deviation(*this));
    case Kind::triangular:
    default: {
      const double left = (c - a) / (b - a);
      return p < left ? a + std::sqrt(p * (b - a) * (c - a)) : b - std::sqrt((1 - p) * (b - a) * (b - c));
    }
  }
}

double Marginal::probability(double x) const {
  switch (kind) {
    case Kind::uniform:
      return std::clamp((x - a) / (b - a), 0.0, 1.0);
    case Kind::log_uniform:
      return x <= a ? 0 : std::min(1.0, std::log(x / a) / std::log(b / a));
    case Kind::normal:
      return gsl_cdf_gaussian_P(x - a, b);
    case Kind::lognormal:
      return x <= 0 ? 0 : gsl_cdf_lognormal_P(x, log_mean(*this), log_deviation(*this));
    case Kind::triangular:
    default:
      if (x <= a) return 0;
      if (x >= b) return 1;
      return x < c ? (x - a) * (x - a) / ((b - a) * (c - a)) : 1 - (b - x) * (b - x) / ((b - a) * (b - c));
  }
}

bool Marginal::contains(double x) const {
  switch (kind) {
    case Kind::normal:
      return true;
    case Kind::lognormal:
      return x > 0;
    default:
      return a <= x && x <= b;
  }
}

double Marginal::mean() const {
  switch (kind) {
    case Kind::uniform:
      return 0.5 * (a + b);
    case Kind::log_uniform:
      return (b - a) / std::log(b / a);
    case Kind::triangular:
      return (a + b + c) / 3;
    default:
      return a;
  }
}

double Marginal::standard_deviation() const {
  switch (kind) {
    case Kind::uniform:
      return (b - a) / std::sqrt(12.0);
    case Kind::log_uniform:
      return std::sqrt(0.5 * (b * b - a * a) / std::log(b / a) - mean() * mean());
    case Kind::triangular:
      return std::sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18);
    default:
      return b;
  }
}

std::string Marginal::text() const {
  for (const Entry& entry : entries)
    if (entry.kind == kind)
      return kind == Kind::triangular ? fmt::format("{}({}, {}, {})", entry.name, a, c, b)
                                      : fmt::format("{}({}, {})", entry.name, a, b);
  return {};
}

std::optional<Marginal> parse_marginal(std::string_view text, const std::string& key,
                                       const std::string& unit) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || text.back() != ')') return {};
  const std::string name = trimmed(text.substr(0, open));
  std::vector<std::string> names, forms;
  for (const Entry& entry : entries) {
    names.emplace_back(entry.name);
    forms.emplace_back(entry.form);
  }
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
  if (entry == entries.end()) {
    const std::string near = scene::nearest(name, names);
    throw InvalidInput(fmt::format(
        "{} = {}: {} is not a distribution{}", key, scene::one_line(text), scene::in_quotes(name),
        near.empty() ? fmt::format("; there are: {}", fmt::join(forms, ", ")) : scene::did_you_mean(near)));
  }
  std::vector<double> numbers;
  std::string_view rest = text.substr(open + 1, text.size() - open - 2);
  for (;;) {
    const std::size_t comma = rest.find(',');
    numbers.push_back(number_from(trimmed(rest.substr(0, comma)), key, unit));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (numbers.size() != entry->parameters)
    throw InvalidInput(fmt::format("{} = {}: write {}", key, scene::one_line(text), entry->form));
  Marginal marginal{entry->kind, numbers[0], numbers.back(), entry->parameters == 3 ? numbers[1] : 0};
  check(marginal, key, text);
  return marginal;
}

}  // namespace tunica::uncertainty
