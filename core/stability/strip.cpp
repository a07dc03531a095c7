// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stability/strip.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

#include "core/stability/ripple.hpp"

namespace tunica::stability {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Relative asymmetry below which a matrix is symmetric up to round-off.
constexpr double rounding = 1e-9;

bool is_symmetric(const MatrixXd& a) {
  return (a - a.transpose()).cwiseAbs().maxCoeff() <= rounding * a.cwiseAbs().maxCoeff();
}

/// grad v : tangent : grad d at a point, for the components i of v and j of d: the factors of v' d', v' d, v
/// d', v d, those of k v' d, k v d' and k v d, and that of k^2 v d.
struct Block {
  double slope_slope, slope_value, value_slope, value_value, slope_wave, wave_slope, value_wave, wave_wave;
};

struct Blocks : std::array<std::array<Block, 3>, 3> {
  template <class TangentMatrix>
  Blocks(const RippleGradient& ripple, const TangentMatrix& tangent) {
    const RippleGradient::Columns by_slope = tangent * ripple.slope, by_value = tangent * ripple.value,
                                  by_wave = tangent * ripple.wave;
    for (Index i = 0; i < ripple.slope.cols(); ++i)
      for (Index j = 0; j < ripple.slope.cols(); ++j) {
        const auto slope = ripple.slope.col(i), value = ripple.value.col(i), wave = ripple.wave.col(i);
        (*this)[i][j] = {slope.dot(by_slope.col(j)),
                         slope.dot(by_value.col(j)),
                         value.dot(by_slope.col(j)),
                         value.dot(by_value.col(j)),
                         slope.dot(by_wave.col(j)),
                         wave.dot(by_slope.col(j)),
                         value.dot(by_wave.col(j)) + wave.dot(by_value.col(j)),
                         wave.dot(by_wave.col(j))};
      }
  }
};

}  // namespace

Strip::Strip(const BaseState& base, int circumferential, bool twist) : circumferential_(circumferential) {
  if (circumferential == 0 && !twist)
    components_ = {0, 2};
  else
    components_ = {0, 1, 2};
  for (std::size_t cell = 0; cell < base.cells.size(); ++cell) add_cell(base, cell);
  inner_ = surface(base.inner);
  outer_ = surface(base.outer);
}

void Strip::add_cell(const BaseState& base, std::size_t cell) {
  const element::Line& line = base.line;
  const Index n = line.nodes(), c = unknowns();
  const double half_width = base.half_widths[cell];
  const std::size_t count = line.rule().size();
  Polynomial stiffness;
  for (MatrixXd& term : stiffness.terms) term = MatrixXd::Zero(n * c, n * c);
  MatrixXd mass = MatrixXd::Zero(n, n);
  for (std::size_t q = 0; q < count; ++q) {
    const MaterialPoint& point = base.points[cell * count + q];
    const RippleGradient ripple(1 / point.radius, circumferential_ / point.radius, components_);
    const Blocks blocks(ripple, matrix_of(point.tangent));
    for (Index b = 0; b < n; ++b) {
      const double shape_b = line.shape(q, static_cast<int>(b));
      const double slope_b = line.slope(q, static_cast<int>(b)) / half_width;
      for (Index a = 0; a < n; ++a) {
        const double shape_a = point.weight * line.shape(q, static_cast<int>(a));
        const double slope_a = point.weight * line.slope(q, static_cast<int>(a)) / half_width;
        mass(a, b) += shape_a * shape_b;
        const double products[] = {slope_a * slope_b, slope_a * shape_b, shape_a * slope_b,
                                   shape_a * shape_b};
        for (Index j = 0; j < c; ++j)
          for (Index i = 0; i < c; ++i) {
            const auto& block = blocks[i][j];
            const Index row = a * c + i, column = b * c + j;
            stiffness.terms[0](row, column) +=
                products[0] * block.slope_slope + products[1] * block.slope_value +
                products[2] * block.value_slope + products[3] * block.value_value;
            stiffness.terms[1](row, column) += products[1] * block.slope_wave +
                                               products[2] * block.wave_slope +
                                               products[3] * block.value_wave;
            stiffness.terms[2](row, column) += products[3] * block.wave_wave;
          }
      }
    }
  }
  cells_.push_back(std::move(stiffness));
  masses_.push_back(std::move(mass));
  const radial::Interval& interval = base.cells[cell];
  const double lower = base.inner.radius + interval.lower * base.thickness;
  for (int k = nodes_.empty() ? 0 : 1; k < line.nodes(); ++k)
    nodes_.push_back(lower + half_width * (1 + line.node(k)));
}

Strip::Polynomial Strip::surface(const SurfaceState& state) const {
  const RippleGradient ripple(1 / state.radius, circumferential_ / state.radius, components_);
  // A load depends on the tangents of its surface alone: nothing multiplies the slopes of the ripple.
  const MatrixXd by_value =
      load_by_gradient(state) * ripple.value + load_by_displacement(state)(Eigen::all, components_);
  const MatrixXd by_wave = load_by_gradient(state) * ripple.wave;
  Polynomial stiffness;
  stiffness.terms[0] = state.radius * by_value(components_, Eigen::all);
  stiffness.terms[1] = state.radius * by_wave(components_, Eigen::all);
  stiffness.terms[2] = MatrixXd::Zero(unknowns(), unknowns());
  return stiffness;
}

MatrixXd Strip::stiffness(double wave_number) const {
  const Index c = unknowns(), size = static_cast<Index>(nodes_.size()) * c;
  MatrixXd k = MatrixXd::Zero(size, size);
  Index first = 0;
  for (const Polynomial& cell : cells_) {
    const Index width = cell.terms[0].rows();
    k.block(first, first, width, width) += cell.at(wave_number);
    first += width - c;
  }
  k.topLeftCorner(c, c) += inner_.at(wave_number);
  k.bottomRightCorner(c, c) += outer_.at(wave_number);
  return k;
}

MatrixXd Strip::mass(double density) const {
  const Index c = unknowns(), size = static_cast<Index>(nodes_.size()) * c;
  MatrixXd m = MatrixXd::Zero(size, size);
  Index first = 0;
  for (const MatrixXd& cell : masses_) {
    const Index n = cell.rows();
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b)
        for (Index i = 0; i < c; ++i) m(first + a * c + i, first + b * c + i) += density * cell(a, b);
    first += (n - 1) * c;
  }
  return m;
}

StripMode Strip::least_mode(double wave_number, double density) const {
  const MatrixXd k = stiffness(wave_number), m = mass(density);
  StripMode mode{wave_number, circumferential_, 0.0, 0};
  if (is_symmetric(k)) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m, Eigen::EigenvaluesOnly);
    const double least = solver.eigenvalues()[0];
    mode.eigenvalue = least;
    mode.growth_rate = least < 0 ? std::sqrt(-least) : 0.0;
    return mode;
  }
  // Of the inverse problem, whose round-off is relative to the slow modes and not to the sound waves. It has
  // a real solution where modes meet to within the root of that round-off.
  const Eigen::EigenSolver<MatrixXd> solver(k.partialPivLu().solve(m), false);
  mode.eigenvalue = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& inverse : solver.eigenvalues()) {
    const bool is_real = std::abs(inverse.imag()) <= 1e-6 * std::abs(inverse.real());
    const std::complex<double> lambda = is_real ? 1 / inverse.real() : 1.0 / inverse;
    const double growth = is_real && lambda.real() >= 0 ? 0.0 : std::abs(std::sqrt(-lambda).real());
    if (growth > mode.growth_rate || (growth == mode.growth_rate && lambda.real() < mode.eigenvalue.real())) {
      mode.eigenvalue = lambda;
      mode.growth_rate = growth;
    }
  }
  return mode;
}

MatrixXd Strip::surface_stiffness(double wave_number) const {
  const Index c = unknowns();
  MatrixXd below = inner_.at(wave_number);
  for (const Polynomial& cell : cells_) {
    MatrixXd k = cell.at(wave_number);
    k.topLeftCorner(c, c) += below;
    const Index within = k.rows() - c;
    const Eigen::LLT<MatrixXd> factor(k.topLeftCorner(within, within));
    if (factor.info() != Eigen::Success) return {};
    below =
        k.bottomRightCorner(c, c) - k.bottomLeftCorner(c, within) * factor.solve(k.topRightCorner(within, c));
  }
  return below + outer_.at(wave_number);
}

bool Strip::is_stable(double wave_number) const {
  const MatrixXd stiffness = surface_stiffness(wave_number);
  if (stiffness.size() == 0) return false;
  return (Eigen::EigenSolver<MatrixXd>(stiffness, false).eigenvalues().real().array() > 0).all();
}

}  // namespace tunica::stability
