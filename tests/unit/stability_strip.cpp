// SPDX-License-Identifier: GPL-3.0-or-later
// Ripples of the inflated wall: the stiffness against the weak form, its symmetries, and how it converges.
#include "core/stability/strip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/physics/tether.hpp"
#include "tests/support/random_deformation.hpp"
#include "tests/support/strip_cases.hpp"

namespace tunica {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using stability::BaseState;
using stability::Strip;
using test_support::joined;
using test_support::model_with;
using test_support::RandomDeformation;
using test_support::wall_at;
using test_support::wall_density;
using test_support::wall_stretched;
using test_support::wall_under;
using test_support::wave_number;

double asymmetry(const MatrixXd& a) {
  return (a - a.transpose()).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff();
}

/// A ripple whose amplitudes are polynomials of degree 4 in the depth.
struct Amplitudes {
  std::array<std::array<double, 5>, 3> coefficients;

  explicit Amplitudes(RandomDeformation& random) {
    for (auto& component : coefficients)
      for (double& c : component) c = random.uniform(-1, 1);
  }
  template <class S>
  S at(int component, const S& depth) const {
    S sum(0.0);
    for (int k = 4; k >= 0; --k) sum = sum * depth + coefficients[component][k];
    return sum;
  }
  VectorXd nodal(const Strip& strip, const radial::Ring<double>& ring) const {
    VectorXd values(static_cast<Eigen::Index>(strip.nodes().size() * strip.components().size()));
    Eigen::Index row = 0;
    for (const double radius : strip.nodes())
      for (const int component : strip.components())
        values[row++] = at(component, (radius - ring.inner_radius) / ring.thickness);
    return values;
  }
};

/// The weak form in Cartesian coordinates, without linearisation and without Fourier's method: the internal
/// and external virtual work of a rippled wall, averaged over a wave.
class RippledWall {
 public:
  RippledWall(const radial::RingModel& model, const BaseState& base, double wave_number, int around)
      : model_(model), base_(base), wave_number_(wave_number), around_(around) {
    for (const auto& cell : base.cells)
      for (const auto& point : gauss_legendre(10)) {
        const double half = 0.5 * (cell.upper - cell.lower);
        places_.push_back(cell.lower + half * (1 + point.position));
        weights_.push_back(point.weight * half * model.ring().thickness);
        layers_.push_back(cell.layer);
      }
    places_.insert(places_.end(), {0.0, 1.0});
    states_ = model.respond(base.lumen_stretch, places_, false).states;
  }

  double work(const Amplitudes& ripple, double size, const Amplitudes& test) const {
    constexpr int phases = 8;  // exact for products of up to seven waves
    double sum = 0;
    for (int phase = 0; phase < phases; ++phase) {
      const double z = 2 * std::numbers::pi * phase / (phases * wave_number_);
      for (std::size_t q = 0; q < weights_.size(); ++q) {
        const auto gradient = field(q, z, ripple, size, true).second;
        const auto stress = wall::piola(model_.ring().layers[layers_[q]].law, gradient, axes());
        sum += weights_[q] * model_.ring().radius(places_[q]) *
               contract(stress, field(q, z, test, 1, false).second);
      }
      sum += surface_work(weights_.size(), -1, z, ripple, size, test);
      sum += surface_work(weights_.size() + 1, 1, z, ripple, size, test);
    }
    return sum / phases;
  }

 private:
  static constexpr double angle = 0.7;  // Theta of the points

  static wall::MaterialAxes axes() { return {{-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}; }

  /// Displacement and gradient, Cartesian, of a ripple at a place, with or without those of the ring.
  std::pair<Vector<double>, Tensor<double>> field(std::size_t place, double z, const Amplitudes& ripple,
                                                  double size, bool with_ring) const {
    using S = Dual<double, 3>;
    const radial::Ring<double>& ring = model_.ring();
    const double radius = ring.radius(places_[place]);
    const S x = S::variable(radius * std::cos(angle), 0), y = S::variable(radius * std::sin(angle), 1),
            axial = S::variable(z, 2);
    const S r = sqrt(x * x + y * y), theta = atan2(y, x);
    const S phase = wave_number_ * axial + static_cast<double>(around_) * theta;
    const S depth = (r - ring.inner_radius) / ring.thickness;
    S radial = size * ripple.at(0, depth) * cos(phase);
    const S circumferential = size * ripple.at(1, depth) * sin(phase),
            along = size * ripple.at(2, depth) * sin(phase);
    if (with_ring)
      radial = radial + S(states_[place].displacement) + states_[place].radial_slope * (r - radius);
    const Vector<S> d{radial * cos(theta) - circumferential * sin(theta),
                      radial * sin(theta) + circumferential * cos(theta), along};
    Tensor<double> gradient;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gradient(i, j) = d[i].derivative[j];
    return {{d[0].value, d[1].value, d[2].value}, gradient};
  }

  double surface_work(std::size_t place, double outward, double z, const Amplitudes& ripple, double size,
                      const Amplitudes& test) const {
    const auto [displacement, gradient] = field(place, z, ripple, size, true);
    const Vector<double> normal{outward * std::cos(angle), outward * std::sin(angle), 0};
    const radial::Ring<double>& ring = model_.ring();
    const auto load =
        outward < 0
            ? physics::pressure_load(base_.pressure, physics::oriented_area(gradient, normal))
            : physics::tether_load({ring.tether_stiffness, ring.traction}, displacement, gradient, normal);
    return ring.radius(places_[place]) * dot(load, field(place, z, test, 1, false).first);
  }

  const radial::RingModel& model_;
  const BaseState& base_;
  double wave_number_;
  int around_;
  std::vector<double> places_, weights_;  ///< quadrature points through the wall; then the surfaces
  std::vector<std::size_t> layers_;
  std::vector<radial::WallState<double>> states_;
};

// Central differences of the weak form: the remainder is of second order in the size of the ripple.
TEST(Strip, StiffnessIsTheTangentOfTheWeakForm) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (const char* law : test_support::paper_laws)
    for (const char* tether : test_support::tether_readings)
      for (const int around : {0, 3}) {
        SCOPED_TRACE(testing::Message() << law << ", " << tether << ", m = " << around);
        const auto model = model_with(wall_under(law, tether));
        const BaseState base = stability::base_state(*model, random.uniform(1.1, 1.4), {4, 1});
        const double k = wave_number(random.uniform(1, 5));
        const Strip strip(base, around, true);
        const Amplitudes ripple(random), test(random);
        const double linear =
            test.nodal(strip, model->ring()).dot(strip.stiffness(k) * ripple.nodal(strip, model->ring()));
        const RippledWall wall(*model, base, k, around);
        const auto difference = [&](double size) {
          return 2 * (wall.work(ripple, size, test) - wall.work(ripple, -size, test)) / (2 * size);
        };
        const double coarse = difference(2e-6) - linear, fine = difference(1e-6) - linear;
        // Amplitudes of 1e-6 cm are strains of some 1e-3, so the remainder is of the order of 1e-6.
        const double scale = std::max(std::abs(linear), 1e6);
        EXPECT_LT(std::abs(fine), 1e-4 * scale);
        EXPECT_LT(std::abs((4 * fine - coarse) / 3), 1e-10 * scale);
      }
}

TEST(Strip, ConservativeTethersGiveSymmetricStiffness) {
  for (const char* law : test_support::paper_laws)
    for (const char* tether : {"normal", "reference"})
      for (const double stretch : {1.2, 1.6})
        for (const int around : {0, 2}) {
          const Strip strip(wall_stretched(wall_under(law, tether), stretch), around, true);
          EXPECT_LT(asymmetry(strip.stiffness(wave_number(2))), 1e-13)
              << law << ", " << tether << ", " << stretch << ", m = " << around;
        }
}

// The tether per current area along the displacement answers a change of area by a force along the radius
// alone: its row of the outer surface has k K u times the other current radius that its column lacks.
TEST(Strip, TetherPerCurrentAreaIsNotConservative) {
  const double stretch = 1.3, k = wave_number(2);
  const auto model = model_with(wall_under("EXP1", "current"));
  const BaseState base = stability::base_state(*model, stretch);
  const MatrixXd stiffness = Strip(base).stiffness(k);
  const MatrixXd skew = stiffness - stiffness.transpose();
  const auto last = skew.rows() - 1;
  const double outer = model->respond(stretch, std::array{1.0}, false).states[0].displacement;
  const double expected = k * 1e7 * outer * (0.043 + outer);
  EXPECT_NEAR(skew(last - 1, last), expected, 1e-10 * expected);
  MatrixXd rest = skew;
  rest.bottomRightCorner(2, 2).setZero();
  EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-13 * stiffness.cwiseAbs().maxCoeff());
}

// Without a tether a wall under pressure may be moved as a rigid body: the pressure turns with it.
TEST(Strip, RigidMotionsTakeNoForce) {
  for (const char* law : test_support::paper_laws) {
    SCOPED_TRACE(law);
    const BaseState base = wall_stretched(
        {std::string("wall.law=") + law, "tether.stiffness=0", "tether.traction=reference"}, 1.4);
    const auto model = model_with({std::string("wall.law=") + law, "tether.stiffness=0"});
    const auto force = [&](int around, const std::array<double, 3>& amplitudes, bool turn) {
      const Strip strip(base, around, true);
      VectorXd motion(3 * static_cast<Eigen::Index>(strip.nodes().size()));
      for (std::size_t n = 0; n < strip.nodes().size(); ++n) {
        const double xi = (strip.nodes()[n] - 0.033) / 0.01;
        const double radius =
            turn ? strip.nodes()[n] +
                       model->respond(1.4, std::array{std::clamp(xi, 0.0, 1.0)}, false).states[0].displacement
                 : 1.0;
        for (int i = 0; i < 3; ++i) motion[3 * static_cast<Eigen::Index>(n) + i] = radius * amplitudes[i];
      }
      const MatrixXd stiffness = strip.stiffness(0);
      return (stiffness * motion).cwiseAbs().maxCoeff() /
             (stiffness.cwiseAbs().maxCoeff() * motion.cwiseAbs().maxCoeff());
    };
    EXPECT_LT(force(1, {1, -1, 0}, false), 1e-12) << "across the axis";
    EXPECT_LT(force(0, {0, 0, 1}, false), 1e-12) << "along the axis";
    // The ring's displacement is known to 1e-10 or so.
    EXPECT_LT(force(0, {0, 1, 0}, true), 1e-9) << "about the axis";
  }
}

TEST(Strip, MassIsThatOfTheWall) {
  const Strip strip(wall_stretched({"wall.law=EXP1"}, 1.2), 2);
  const MatrixXd mass = strip.mass(1.2);
  for (int i = 0; i < 3; ++i) {
    VectorXd ones = VectorXd::Zero(mass.rows());
    for (Eigen::Index n = i; n < mass.rows(); n += 3) ones[n] = 1;
    EXPECT_NEAR(ones.dot(mass * ones), 1.2 * 0.5 * (0.043 * 0.043 - 0.033 * 0.033), 1e-17);
  }
}

TEST(Strip, UnloadedWallIsStable) {
  // EXP2 has no shear stiffness at rest.
  for (const char* law : {"EXP1", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"})
    for (const char* tether : test_support::tether_readings) {
      const BaseState base = wall_stretched(wall_under(law, tether), 1.0);
      for (const int around : {0, 1, 5})
        for (const double share : {0.05, 2.0, 50.0}) {
          SCOPED_TRACE(testing::Message() << law << ", " << tether << ", m = " << around << ", " << share);
          const Strip strip(base, around, true);
          EXPECT_TRUE(strip.is_stable(wave_number(share)));
          const auto mode = strip.least_mode(wave_number(share), wall_density);
          EXPECT_GT(mode.eigenvalue.real(), 0);
          EXPECT_EQ(mode.growth_rate, 0);
        }
    }
}

// Balanced families: helices to the left and to the right are mirror images. One family alone tells them
// apart, but not a helix from the same one turned by pi about a radius.
TEST(Strip, HelicesAreMirrorImagesWhenFamiliesAre) {
  const auto least = [](const std::vector<std::string>& families, int around, double k) {
    const BaseState base = wall_stretched(joined({"wall.law=EXP1+EXP2-ZS"}, families), 1.3);
    return Strip(base, around).least_mode(k, wall_density).eigenvalue.real();
  };
  const double k = wave_number(8);
  EXPECT_NEAR(least({}, 2, -k) / least({}, 2, k), 1, 1e-10);
  const std::vector<std::string> one{"wall.families=[{angle=40,weight=2}]"};
  EXPECT_NEAR(least(one, -2, -k) / least(one, 2, k), 1, 1e-10);
  EXPECT_GT(std::abs(least(one, 2, -k) / least(one, 2, k) - 1), 0.05);
}

// Whether the surface yields and whether a mode grows are the same question for a symmetric stiffness.
TEST(Strip, StabilityAgreesWithTheEigenvalue) {
  int unstable = 0;
  for (const char* law : {"EXP2", "EXP1+EXP2-FS"})
    for (const double pressure : {5.0, 30.0, 60.0, 75.0, 100.0, 130.0}) {
      const BaseState base = wall_at(law, "reference", pressure);
      for (const int around : {0, 2})
        for (const double share : {0.05, 0.3, 2.0, 5.0, 20.0}) {
          const Strip strip(base, around);
          const auto mode = strip.least_mode(wave_number(share), wall_density);
          EXPECT_EQ(strip.is_stable(wave_number(share)), mode.eigenvalue.real() > 0)
              << law << ", " << pressure << " mmHg, " << share;
          EXPECT_EQ(mode.growth_rate > 0, mode.eigenvalue.real() < 0);
          unstable += mode.growth_rate > 0;
        }
    }
  // Of 120 cases a good part has to be of either kind.
  EXPECT_GT(unstable, 30);
  EXPECT_LT(unstable, 90);
}

// kappa is 118 to 515 times the shear moduli and FS has a front in the wall at 100 mmHg.
TEST(Strip, ConvergesWithTheDegree) {
  for (const char* law : {"EXP2", "EXP1+EXP2-FS"})
    for (const double share : {0.05, 1.0, 5.0, 50.0}) {
      const auto least = [&](int degree) {
        return Strip(wall_at(law, "reference", 100, {degree, 0.05}))
            .least_mode(wave_number(share), wall_density)
            .eigenvalue.real();
      };
      // EXP2 is near its threshold at five thicknesses, where rounding leaves 3e-8 of the eigenvalue: a mean.
      constexpr std::array fine_degrees{12, 13, 14, 15, 16};
      double fine = 0;
      for (const int degree : fine_degrees) fine += least(degree) / fine_degrees.size();
      const double at_4 = std::abs(least(4) / fine - 1), at_6 = std::abs(least(6) / fine - 1),
                   at_8 = std::abs(least(8) / fine - 1);
      std::cout << law << ", wave length " << share << " h: " << fine << ", degrees 4, 6, 8 off by " << at_4
                << ", " << at_6 << ", " << at_8 << "\n";
      // The shortest wave that the mesh is made for takes most.
      EXPECT_LT(at_8, share < 1 ? 1e-4 : 1e-8);
      if (at_4 > 1e-7) {
        EXPECT_LT(at_6, 0.1 * at_4);
      }
    }
}

// Incompressible tissue is the limit of great bulk moduli: the difference falls as 1/kappa until it meets the
// bulk stiffness of some 1e10 that stands for the limit.
TEST(Strip, IncompressibleTissueIsTheLimitOfGreatBulkModuli) {
  const auto least = [](const std::string& key) {
    return Strip(wall_stretched(joined(wall_under("EXP1+EXP2-FS", "reference"), {key}), 1.3))
        .least_mode(wave_number(0.5), wall_density)
        .eigenvalue.real();
  };
  const double exact = least("wall.incompressible=true");
  const double at_7 = least("wall.bulk_modulus=1e7") / exact - 1,
               at_8 = least("wall.bulk_modulus=1e8") / exact - 1;
  EXPECT_NEAR(at_7 / at_8, 10, 0.5);
  EXPECT_LT(std::abs(at_8), 1e-2);
}

}  // namespace
}  // namespace tunica
