// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/chaos.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tunica::uncertainty {

namespace {

using Degrees = Chaos::Degrees;
using Eigen::Index;

constexpr std::size_t most_candidates = 1000;

/// All degrees with sum of n^(3/4) at most `room` from the k-th input on; false when there are too many.
bool extend(Degrees& degrees, std::size_t k, double room, std::vector<Degrees>& all) {
  if (k == degrees.size()) {
    all.push_back(degrees);
    return all.size() <= most_candidates;
  }
  for (int n = 0; n <= Coordinate::highest_degree; ++n) {
    const double left = room - std::pow(n, 0.75);
    if (left < -1e-9) break;
    degrees[k] = n;
    if (!extend(degrees, k + 1, left, all)) return false;
  }
  degrees[k] = 0;
  return true;
}

/// The constant first; empty when there are too many.
std::vector<Degrees> candidates(std::size_t inputs, int degree) {
  std::vector<Degrees> all;
  Degrees degrees(inputs, 0);
  if (!extend(degrees, 0, std::pow(degree, 0.75), all)) return {};
  return all;
}

/// Values of p_n of each input at each point: [input](point, n).
std::vector<Eigen::MatrixXd> polynomials_at(const Known& known, int degree) {
  std::vector<Eigen::MatrixXd> all;
  std::vector<double> values(static_cast<std::size_t>(degree) + 1);
  for (std::size_t k = 0; k < known.coordinates.size(); ++k) {
    Eigen::MatrixXd table(known.places.rows(), degree + 1);
    for (Index i = 0; i < known.places.rows(); ++i) {
      known.coordinates[k].polynomials(known.places(i, static_cast<Index>(k)), degree, values.data());
      table.row(i) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), degree + 1);
    }
    all.push_back(std::move(table));
  }
  return all;
}

/// What has been picked from the columns of a dictionary, and how good it is.
struct Pick {
  std::vector<Index> columns;
  Eigen::VectorXd coefficients;
  double error = std::numeric_limits<double>::infinity();  ///< leave-one-out, squared and summed
};

Pick matching_pursuit(const Eigen::MatrixXd& dictionary, const Eigen::VectorXd& values) {
  const Index points = dictionary.rows(), most = std::min(dictionary.cols(), points / 2);
  const Eigen::VectorXd lengths = dictionary.colwise().norm();
  Eigen::MatrixXd basis(points, most), triangle = Eigen::MatrixXd::Zero(most, most);
  Eigen::VectorXd residual = values, leverage = Eigen::VectorXd::Zero(points), shares(most);
  std::vector<Index> picked;
  std::vector<bool> is_out(static_cast<std::size_t>(dictionary.cols()), false);
  Pick best;
  Index best_size = 0;
  const Index patience = std::clamp<Index>(points / 10, 8, 25);
  const double smallest = 1e-13 * values.norm();
  for (Index size = 0; size < most && size - best_size < patience;) {
    Index next = 0;
    if (size > 0) {
      const Eigen::VectorXd match = (dictionary.transpose() * residual).cwiseAbs().cwiseQuotient(lengths);
      double closest = -1;
      for (Index j = 0; j < match.size(); ++j)
        if (!is_out[static_cast<std::size_t>(j)] && match[j] > closest) closest = match[next = j];
      if (closest < 0) break;
    }
    is_out[static_cast<std::size_t>(next)] = true;
    Eigen::VectorXd column = dictionary.col(next);
    const auto before = basis.leftCols(size);
    // Twice is enough (Kahan, after Parlett).
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd along = before.transpose() * column;
      triangle.col(size).head(size) += along;
      column -= before * along;
    }
    const double length = column.norm();
    if (length < 1e-8 * lengths[next]) {
      triangle.col(size).setZero();
      continue;  // spanned by what is there
    }
    triangle(size, size) = length;
    basis.col(size) = column / length;
    shares[size] = basis.col(size).dot(residual);
    residual -= shares[size] * basis.col(size);
    leverage += basis.col(size).cwiseAbs2();
    picked.push_back(next);
    ++size;
    const double counted = static_cast<double>(points + size) / static_cast<double>(points - size);
    const double error = counted * (residual.array() / (1 - leverage.array()).max(1e-10)).square().sum();
    if (error < best.error) {
      best.error = error;
      best_size = size;
    }
    if (residual.norm() <= smallest) break;
  }
  best.columns.assign(picked.begin(), picked.begin() + best_size);
  best.coefficients = triangle.topLeftCorner(best_size, best_size)
                          .triangularView<Eigen::Upper>()
                          .solve(shares.head(best_size));
  return best;
}

bool is_alone(const Degrees& degrees, std::size_t input) {
  for (std::size_t k = 0; k < degrees.size(); ++k)
    if ((degrees[k] > 0) != (k == input)) return false;
  return true;
}

bool is_constant(const Degrees& degrees) {
  return std::all_of(degrees.begin(), degrees.end(), [](int n) { return n == 0; });
}

}  // namespace

Chaos::Chaos(const std::vector<Coordinate>& coordinates, std::vector<Term> terms)
    : coordinates_(coordinates), terms_(std::move(terms)) {}

template <class Is>
double Chaos::squares(const Is& is_of_it) const {
  double all = 0;
  for (const Term& term : terms_)
    if (is_of_it(term.degrees)) all += term.coefficient * term.coefficient;
  return all;
}

template <class Is>
double Chaos::sum(const Eigen::VectorXd& place, const Is& is_of_it) const {
  constexpr std::size_t width = Coordinate::highest_degree + 1;
  std::vector<double> values(width * coordinates_.size());
  for (std::size_t k = 0; k < coordinates_.size(); ++k)
    coordinates_[k].polynomials(place[static_cast<Index>(k)], Coordinate::highest_degree,
                                values.data() + width * k);
  double all = 0;
  for (const Term& term : terms_) {
    if (!is_of_it(term.degrees)) continue;
    double product = term.coefficient;
    for (std::size_t k = 0; k < coordinates_.size(); ++k)
      if (term.degrees[k] > 0) product *= values[width * k + static_cast<std::size_t>(term.degrees[k])];
    all += product;
  }
  return all;
}

double Chaos::mean() const {
  for (const Term& term : terms_)
    if (is_constant(term.degrees)) return term.coefficient;
  return 0;
}
double Chaos::variance() const {
  return squares([](const Degrees& degrees) { return !is_constant(degrees); });
}
double Chaos::value(const Eigen::VectorXd& place) const {
  return sum(place, [](const Degrees&) { return true; });
}
double Chaos::first(Index input, const Eigen::VectorXd& place) const {
  return sum(place, [&](const Degrees& n) { return is_alone(n, static_cast<std::size_t>(input)); });
}
double Chaos::first_variance(Index input) const {
  return squares([&](const Degrees& n) { return is_alone(n, static_cast<std::size_t>(input)); });
}
double Chaos::total(Index input, const Eigen::VectorXd& place) const {
  return sum(place, [&](const Degrees& n) { return n[static_cast<std::size_t>(input)] > 0; });
}
double Chaos::total_variance(Index input) const {
  return squares([&](const Degrees& n) { return n[static_cast<std::size_t>(input)] > 0; });
}

std::unique_ptr<Chaos> fit_chaos(const Known& known) {
  const auto tables = polynomials_at(known, Coordinate::highest_degree);
  Pick best;
  std::vector<Degrees> of_best;
  int worse = 0;
  for (const int degree : {1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 17, 20}) {
    std::vector<Degrees> all = candidates(known.coordinates.size(), degree);
    if (all.empty()) break;
    Eigen::MatrixXd dictionary = Eigen::MatrixXd::Ones(known.places.rows(), static_cast<Index>(all.size()));
    for (std::size_t t = 0; t < all.size(); ++t)
      for (std::size_t k = 0; k < tables.size(); ++k)
        if (all[t][k] > 0) dictionary.col(static_cast<Index>(t)).array() *= tables[k].col(all[t][k]).array();
    Pick pick = matching_pursuit(dictionary, known.values);
    if (pick.error < best.error) {
      best = std::move(pick);
      of_best = std::move(all);
      worse = 0;
    } else if (++worse == 3) {
      break;
    }
  }
  std::vector<Chaos::Term> terms;
  for (std::size_t t = 0; t < best.columns.size(); ++t)
    terms.push_back(
        {of_best[static_cast<std::size_t>(best.columns[t])], best.coefficients[static_cast<Index>(t)]});
  return std::make_unique<Chaos>(known.coordinates, std::move(terms));
}

std::unique_ptr<Chaos> sum(const std::vector<Coordinate>& coordinates, const Chaos& one, const Chaos& other) {
  std::map<Degrees, double> all;
  for (const Chaos* part : {&one, &other})
    for (const auto& [degrees, coefficient] : part->terms()) all[degrees] += coefficient;
  std::vector<Chaos::Term> terms;
  for (const auto& [degrees, coefficient] : all) terms.push_back({degrees, coefficient});
  return std::make_unique<Chaos>(coordinates, std::move(terms));
}

}  // namespace tunica::uncertainty
