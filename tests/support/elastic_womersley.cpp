// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/elastic_womersley.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tunica::test_support {

namespace {

using Real = long double;
using Matrix6 = Eigen::Matrix<LongComplex, 6, 6>;

constexpr LongComplex i_unit(0, 1);

Complex rounded(LongComplex z) {
  return {static_cast<double>(z.real()), static_cast<double>(z.imag())};
}

/// One term of a field at one radius: the vector and its gradient in axes (r, theta, z), and for a gradient
/// field its potential and divergence.
struct Term {
  LongComplex radial = 0, axial = 0;
  LongComplex rr = 0, tt = 0, rz = 0, zr = 0, zz = 0;
  LongComplex potential = 0, divergence = 0;

  std::array<LongComplex*, 9> parts() {
    return {&radial, &axial, &rr, &tt, &rz, &zr, &zz, &potential, &divergence};
  }
  Term& operator*=(LongComplex factor) {
    for (LongComplex* part : parts()) *part *= factor;
    return *this;
  }
  void add(LongComplex factor, Term other) {
    const auto mine = parts(), others = other.parts();
    for (std::size_t k = 0; k < mine.size(); ++k) *mine[k] += factor * *others[k];
  }
};

/// Solutions of f0'' + f0'/x = f0 with f1 = f0', f1' = (f0 + f2)/2, f1/x = (f0 - f2)/2.
struct Modified {
  LongComplex zero, one, two;
};
Modified growing(LongComplex x) {
  const BesselI i = bessel_i(x);
  return {i.zero, i.one, i.two};
}
Modified decaying(LongComplex x) {
  const BesselK k = bessel_k(x);
  return {k.zero, -k.one, k.two};
}

/// grad(f0(a r) e^{ikz}), divergence (a^2 - k^2) f0; a^2 - k^2 is given, since a difference would lose it.
Term gradient_field(LongComplex k, LongComplex a, LongComplex excess, const Modified& f) {
  Term t;
  t.radial = a * f.one;
  t.axial = i_unit * k * f.zero;
  t.rr = 0.5L * a * a * (f.zero + f.two);
  t.tt = 0.5L * a * a * (f.zero - f.two);
  t.rz = t.zr = i_unit * k * a * f.one;
  t.zz = -k * k * f.zero;
  t.potential = f.zero;
  t.divergence = excess * f.zero;
  return t;
}

/// curl(f1(a r) e^{ikz} e_theta)
Term curl_field(LongComplex k, LongComplex a, const Modified& f) {
  Term t;
  t.radial = -i_unit * k * f.one;
  t.axial = a * f.zero;
  t.rr = -0.5L * i_unit * k * a * (f.zero + f.two);
  t.tt = -0.5L * i_unit * k * a * (f.zero - f.two);
  t.rz = k * k * f.one;
  t.zr = a * a * f.one;
  t.zz = i_unit * k * a * f.zero;
  return t;
}

/// The two terms of the blood's velocity. The second has v_z = 1 at the wall, however thin its
/// boundary layer.
std::array<Term, 2> blood_terms(const ElasticTube& tube, Real w, LongComplex k, Real r) {
  const LongComplex s = std::sqrt(k * k - i_unit * w * Real(tube.blood_density) / Real(tube.viscosity));
  Term irrotational = gradient_field(k, k, 0, growing(k * r));
  irrotational *= 1.0L / (i_unit * w * Real(tube.blood_density));
  Term vortical = curl_field(k, s, growing(s * r));
  vortical *= 1.0L / (s * bessel_i(s * Real(tube.radius)).zero);
  return {irrotational, vortical};
}

/// The four terms of the wall's displacement. The factors b and 1/b make the determinant even in b: k may
/// pass the shear wave's number, where b = 0, and the cut of the square root.
std::array<Term, 4> wall_terms(const ElasticTube& tube, Real w, LongComplex k, Real r) {
  const Real shear = tube.shear_modulus(), density = tube.wall_density;
  const Real long_squared = w * w * density / (Real(tube.lame_first()) + 2 * shear);
  const Real shear_squared = w * w * density / shear;
  const LongComplex a = std::sqrt(k * k - long_squared), b = std::sqrt(k * k - shear_squared);
  std::array<Term, 4> terms{gradient_field(k, a, -long_squared, growing(a * r)),
                            gradient_field(k, a, -long_squared, decaying(a * r)),
                            curl_field(k, b, growing(b * r)), curl_field(k, b, decaying(b * r))};
  terms[2] *= 1.0L / b;
  terms[3] *= b;
  return terms;
}

struct Traction {
  LongComplex radial, axial;
};
/// On a surface r = const; the blood's pressure is i w rho times the potential of its velocity.
Traction blood_traction(const ElasticTube& tube, Real w, const Term& t) {
  const LongComplex pressure = i_unit * w * Real(tube.blood_density) * t.potential;
  const Real viscosity = tube.viscosity;
  return {-pressure + 2 * viscosity * t.rr, viscosity * (t.rz + t.zr)};
}
Traction wall_traction(const ElasticTube& tube, const Term& t) {
  const Real shear = tube.shear_modulus();
  return {Real(tube.lame_first()) * t.divergence + 2 * shear * t.rr, shear * (t.rz + t.zr)};
}

/// The six conditions (rows) on the six terms (columns).
Matrix6 conditions(const ElasticTube& tube, Real w, LongComplex k) {
  Matrix6 m = Matrix6::Zero();
  const auto blood = blood_terms(tube, w, k, tube.radius);
  for (int j = 0; j < 2; ++j) {
    const Traction traction = blood_traction(tube, w, blood[j]);
    m.col(j) << blood[j].radial, blood[j].axial, traction.radial, traction.axial, 0, 0;
  }
  const auto inner = wall_terms(tube, w, k, tube.radius), outer = wall_terms(tube, w, k, tube.outer_radius());
  const Real spring = tube.tether;
  for (int j = 0; j < 4; ++j) {
    const Traction in = wall_traction(tube, inner[j]), out = wall_traction(tube, outer[j]);
    m.col(2 + j) << i_unit * w * inner[j].radial, i_unit * w * inner[j].axial, -in.radial, -in.axial,
        out.radial + spring * outer[j].radial, out.axial + spring * outer[j].axial;
  }
  return m;
}

/// Constants that bring rows and columns of the matrix to size 1.
struct Scaling {
  Eigen::Matrix<Real, 6, 1> rows = Eigen::Matrix<Real, 6, 1>::Ones(),
                            columns = Eigen::Matrix<Real, 6, 1>::Ones();

  explicit Scaling(const Matrix6& m) {
    for (int sweep = 0; sweep < 5; ++sweep)
      for (int j = 0; j < 6; ++j) {
        rows(j) /= apply(m).row(j).cwiseAbs().maxCoeff();
        columns(j) /= apply(m).col(j).cwiseAbs().maxCoeff();
      }
  }
  Matrix6 apply(const Matrix6& m) const {
    return rows.cast<LongComplex>().asDiagonal() * m * columns.cast<LongComplex>().asDiagonal();
  }
};

/// Muller's method: the root, near the last of three points, of the parabola through them.
template <class Function>
LongComplex muller(const Function& f, LongComplex guess) {
  LongComplex x0 = guess * 1.01L, x1 = guess * LongComplex(1, 0.01L), x2 = guess;
  LongComplex f0 = f(x0), f1 = f(x1), f2 = f(x2);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const LongComplex d12 = (f2 - f1) / (x2 - x1), d01 = (f1 - f0) / (x1 - x0);
    const LongComplex curvature = (d12 - d01) / (x2 - x0), slope = d12 + (x2 - x1) * curvature;
    const LongComplex root = std::sqrt(slope * slope - 4.0L * f2 * curvature);
    const LongComplex larger = std::abs(slope + root) > std::abs(slope - root) ? slope + root : slope - root;
    LongComplex step = -2.0L * f2 / larger;
    if (std::abs(step) > 0.2L * std::abs(x2)) step *= 0.2L * std::abs(x2) / std::abs(step);
    x0 = x1, f0 = f1;
    x1 = x2, f1 = f2;
    x2 += step, f2 = f(x2);
    // The parabola of three such close points is round-off, so that the last step is not made smaller.
    if (std::abs(step) < 1e-14L * std::abs(x2) || f2 == LongComplex(0)) return x2;
  }
  throw std::runtime_error("ElasticWomersley: Muller's method does not converge");
}

}  // namespace

std::array<LongComplex, 2> thin_wall_wave_numbers_squared(const ElasticTube& tube, double angular_frequency) {
  const Real w = angular_frequency, radius = tube.radius, h = tube.thickness, density = tube.blood_density;
  const Real nu = tube.poisson_ratio, spring = tube.tether, inertia = tube.wall_density * h * w * w;
  const Real plate = tube.young_modulus * h / (1 - nu * nu);  // B h
  const LongComplex x = radius * std::sqrt(LongComplex(0, -w * density / Real(tube.viscosity)));
  const BesselI bessel = bessel_i(x);
  const LongComplex core = bessel.two / bessel.zero, layer = 1.0L - core;  // 1 - F and F = 2 I1/(x I0)
  // With q = k^2, u_r = 1 and u_z = i k zeta:
  //   radially    p = S - (B h nu/R) q zeta,
  //   axially     (M - q B h) zeta + B h nu/R = (R F/2) p,
  //   mass        q (p (1 - F)/(w rho) + w F zeta) = 2 w/R.
  const Real stiffness = plate / (radius * radius) + spring - inertia, coupling = plate * nu / radius;
  const LongComplex axial = inertia - spring + 0.5L * w * w * density * radius * layer;
  const LongComplex source = 0.5L * radius * layer * stiffness - coupling;
  const LongComplex stretch = plate - 0.5L * radius * layer * coupling;
  // zeta = source / (axial - q stretch) leaves second q^2 + first q + zeroth = 0.
  const LongComplex flow = core / (w * density);
  const LongComplex second = -stiffness * flow * stretch - coupling * flow * source;
  const LongComplex first = stiffness * flow * axial + w * layer * source + 2.0L * w / radius * stretch;
  const LongComplex zeroth = -2.0L * w / radius * axial;
  const LongComplex root = std::sqrt(first * first - 4.0L * second * zeroth);
  const LongComplex larger = std::abs(first + root) > std::abs(first - root) ? first + root : first - root;
  std::array<LongComplex, 2> roots{-0.5L * larger / second, -2.0L * zeroth / larger};

  const LongComplex held = 2.0L * w / (radius * stiffness * flow);  // zeta = 0
  const auto distance = [&](LongComplex q) { return std::abs(std::log(q / held)); };
  if (distance(roots[1]) < distance(roots[0])) std::swap(roots[0], roots[1]);
  return roots;
}

ElasticWomersley::ElasticWomersley(const ElasticTube& tube, double angular_frequency)
    : tube_(tube), angular_frequency_(angular_frequency) {
  const Real w = angular_frequency;
  k_ = std::sqrt(thin_wall_wave_numbers_squared(tube, angular_frequency)[0]);
  // Thickened at the same E h and rho_s h, the wall leaves the thin one's root for its own step by step, so
  // that other modes are not met.
  double thickness = std::min(tube.thickness, 0.01 * tube.radius);
  while (true) {
    ElasticTube thinner = tube;
    thinner.thickness = thickness;
    thinner.young_modulus *= tube.thickness / thickness;
    thinner.wall_density *= tube.thickness / thickness;
    const Scaling scaling(conditions(thinner, w, k_));
    const LongComplex root = muller(
        [&](LongComplex k) { return scaling.apply(conditions(thinner, w, k)).partialPivLu().determinant(); },
        k_);
    if (std::abs(root / k_ - 1.0L) > 0.3L || std::abs(root) * tube.radius > 3)
      throw std::runtime_error(
          "ElasticWomersley: the Young mode is lost; the wave is too short for this start");
    k_ = root;
    if (thickness == tube.thickness) break;
    thickness = std::min(1.3 * thickness, tube.thickness);
  }

  const Scaling scaling(conditions(tube, w, k_));
  const Eigen::JacobiSVD<Matrix6> svd(scaling.apply(conditions(tube, w, k_)), Eigen::ComputeFullV);
  for (int j = 0; j < 6; ++j) weights_[j] = svd.matrixV()(j, 5) * scaling.columns(j);
  const LongComplex pressure = weights_[0];  // I0(0) = 1
  for (LongComplex& weight : weights_) weight /= pressure;
}

Complex ElasticWomersley::wave_number() const {
  return rounded(k_);
}

BloodPoint<Complex> ElasticWomersley::blood(double radius) const {
  const auto terms = blood_terms(tube_, angular_frequency_, k_, radius);
  Term v;
  for (int j = 0; j < 2; ++j) v.add(weights_[j], terms[j]);
  const LongComplex p = i_unit * Real(angular_frequency_) * Real(tube_.blood_density) * v.potential;
  const Real mu = tube_.viscosity;

  BloodPoint<Complex> point{};
  point.pressure = rounded(p);
  point.velocity = {rounded(v.radial), 0, rounded(v.axial)};
  point.gradient.entries = {rounded(v.rr), 0, rounded(v.rz), 0, rounded(v.tt), 0,
                            rounded(v.zr), 0, rounded(v.zz)};
  const Complex shear = rounded(mu * (v.rz + v.zr));
  point.stress.entries = {rounded(2 * mu * v.rr - p), 0, shear, 0, rounded(2 * mu * v.tt - p), 0, shear, 0,
                          rounded(2 * mu * v.zz - p)};
  return point;
}

WallPoint<Complex> ElasticWomersley::wall(double radius) const {
  const auto terms = wall_terms(tube_, angular_frequency_, k_, radius);
  Term u;
  for (int j = 0; j < 4; ++j) u.add(weights_[2 + j], terms[j]);
  const Real g = tube_.shear_modulus();
  const LongComplex volumetric = Real(tube_.lame_first()) * u.divergence;

  WallPoint<Complex> point{};
  point.displacement = {rounded(u.radial), 0, rounded(u.axial)};
  point.gradient.entries = {rounded(u.rr), 0, rounded(u.rz), 0, rounded(u.tt), 0,
                            rounded(u.zr), 0, rounded(u.zz)};
  const Complex shear = rounded(g * (u.rz + u.zr));
  point.stress.entries = {rounded(volumetric + 2 * g * u.rr), 0, shear, 0,
                          rounded(volumetric + 2 * g * u.tt), 0, shear, 0,
                          rounded(volumetric + 2 * g * u.zz)};
  return point;
}

}  // namespace tunica::test_support
