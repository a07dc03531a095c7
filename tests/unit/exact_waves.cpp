// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure pulse in an elastic tube: its equations, and its limits in theories that share nothing with
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>

#include "tests/support/elastic_womersley.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/lame_tube.hpp"
#include "tests/support/tube_waves.hpp"
#include "tests/support/womersley.hpp"

namespace tunica::test_support {
namespace {

constexpr double pi = std::numbers::pi;

struct Case {
  const char* name;
  ElasticTube tube;
  double frequency;  ///< Hz
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

constexpr ElasticTube artery{0.033, 0.01, 4e5, 0.49, 1.2, 1.0, 0.035, 1e7};
constexpr ElasticTube benchmark{0.5, 0.1, 3e6, 0.3, 1.2, 1.0, 0.03};

ElasticTube with(ElasticTube tube, double ElasticTube::*member, double value) {
  tube.*member = value;
  return tube;
}

double largest(const Tensor<Complex>& t) {
  double most = 0;
  for (const Complex& entry : t.entries) most = std::max(most, std::abs(entry));
  return most;
}

/// Div of a stress that depends on r alone times e^{ikz}, and the size of its terms.
template <class Field>
std::pair<std::array<Complex, 2>, double> divergence(const Field& stress, double r, double step, Complex k) {
  const Tensor<Complex> s = stress(r);
  const auto slope = [&](int i, int j) {
    return finite_difference([&](double p) { return stress(p)(i, j); }, r, step);
  };
  const Complex ik = Complex(0, 1) * k, rr = slope(0, 0), zr = slope(2, 0);
  return {{rr + (s(0, 0) - s(1, 1)) / r + ik * s(0, 2), zr + s(2, 0) / r + ik * s(2, 2)},
          std::abs(rr) + std::abs(zr) + largest(s) / r};
}

class ElasticTubeWave : public testing::TestWithParam<Case> {
 protected:
  ElasticTube tube = GetParam().tube;
  double w = 2 * pi * GetParam().frequency;
  ElasticWomersley wave{tube, w};
  Complex k = wave.wave_number();
  Complex rate{0, -w};
};

TEST_P(ElasticTubeWave, BloodSatisfiesStokesEquations) {
  const double number = tube.radius * std::sqrt(w * tube.blood_density / tube.viscosity);
  const double step = 0.02 * tube.radius / std::max(1.0, number);
  EXPECT_NEAR(std::abs(wave.blood(0).pressure - 1.0), 0, 1e-14);
  for (const double share : {0.2, 0.6, 0.9}) {
    const double r = share * tube.radius;
    const auto here = wave.blood(r);
    const double size = largest(here.gradient);
    EXPECT_LT(std::abs(trace(here.gradient)), 1e-13 * size);
    EXPECT_LT(std::abs(here.gradient(1, 1) - here.velocity[0] / r), 1e-13 * size);
    for (const int i : {0, 2}) {
      const auto along_r = [&](double p) { return wave.blood(p).velocity[i]; };
      const double round_off = 1e-14 * std::abs(here.velocity[i]) / step;
      EXPECT_LT(std::abs(finite_difference(along_r, r, step) - here.gradient(i, 0)),
                1e-11 * size + round_off);
      EXPECT_LT(std::abs(Complex(0, 1) * k * here.velocity[i] - here.gradient(i, 2)), 1e-13 * size);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Complex law = tube.viscosity * (here.gradient(i, j) + here.gradient(j, i)) -
                            (i == j ? here.pressure : Complex(0));
        EXPECT_LT(std::abs(here.stress(i, j) - law), 1e-13 * largest(here.stress));
      }
    // -i w rho v = div sigma. The pressure in sigma_rr is differenced: its round-off counts, size/step.
    const auto [force, terms] = divergence([&](double p) { return wave.blood(p).stress; }, r, step, k);
    EXPECT_LT(std::abs(rate * tube.blood_density * here.velocity[0] - force[0]),
              1e-13 * terms * tube.radius / step);
    EXPECT_LT(std::abs(rate * tube.blood_density * here.velocity[2] - force[1]),
              1e-10 * std::abs(k) + 1e-13 * std::abs(here.stress(0, 2)) / step);
  }
}

TEST_P(ElasticTubeWave, WallSatisfiesNaviersEquation) {
  const double step = 0.01 * std::min(tube.thickness, tube.radius);
  for (const double share : {0.1, 0.5, 0.9}) {
    const double r = tube.radius + share * tube.thickness;
    const auto here = wave.wall(r);
    const double size = largest(here.gradient);
    EXPECT_LT(std::abs(here.gradient(1, 1) - here.displacement[0] / r), 1e-12 * size);
    for (const int i : {0, 2}) {
      const auto along_r = [&](double p) { return wave.wall(p).displacement[i]; };
      const double round_off = 1e-14 * std::abs(here.displacement[i]) / step;
      EXPECT_LT(std::abs(finite_difference(along_r, r, step) - here.gradient(i, 0)),
                1e-10 * size + round_off);
      EXPECT_LT(std::abs(Complex(0, 1) * k * here.displacement[i] - here.gradient(i, 2)), 1e-13 * size);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Complex law = tube.shear_modulus() * (here.gradient(i, j) + here.gradient(j, i)) +
                            (i == j ? tube.lame_first() * trace(here.gradient) : Complex(0));
        EXPECT_LT(std::abs(here.stress(i, j) - law), 1e-13 * tube.lame_first() * size);
      }
    const auto [force, terms] = divergence([&](double p) { return wave.wall(p).stress; }, r, step, k);
    for (const int i : {0, 2})
      EXPECT_LT(std::abs(rate * rate * tube.wall_density * here.displacement[i] - force[i == 0 ? 0 : 1]),
                1e-11 * terms)
          << i;
  }
}

TEST_P(ElasticTubeWave, SurfacesSatisfyTheirConditions) {
  const auto blood = wave.blood(tube.radius);
  const auto inner = wave.wall(tube.radius), outer = wave.wall(tube.outer_radius());
  EXPECT_LT(std::abs(blood.velocity[0] - rate * inner.displacement[0]), 1e-11 * std::abs(blood.velocity[0]));
  EXPECT_LT(std::abs(blood.velocity[2] - rate * inner.displacement[2]),
            1e-11 * std::abs(wave.blood(0).velocity[2]));
  // Pressure is 1; the shears are compared with the blood's.
  EXPECT_LT(std::abs(blood.stress(0, 0) - inner.stress(0, 0)), 1e-10);
  EXPECT_LT(std::abs(blood.stress(2, 0) - inner.stress(2, 0)), 1e-10 * std::abs(blood.stress(2, 0)));
  EXPECT_LT(std::abs(outer.stress(0, 0) + tube.tether * outer.displacement[0]), 1e-10);
  EXPECT_LT(std::abs(outer.stress(2, 0) + tube.tether * outer.displacement[2]),
            1e-9 * std::abs(blood.stress(2, 0)));
}

TEST_P(ElasticTubeWave, DecaysOnItsWay) {
  EXPECT_GT(k.real(), 0);
  EXPECT_GT(k.imag(), 0);
}

INSTANTIATE_TEST_SUITE_P(Tubes, ElasticTubeWave,
                         testing::Values(Case{"Artery", artery, 1.25}, Case{"ArteryFast", artery, 100},
                                         Case{"ArteryFaster", artery, 1000},
                                         Case{"ArteryNearlyIncompressible",
                                              with(artery, &ElasticTube::poisson_ratio, 0.4999), 1.25},
                                         Case{"ArteryFree", with(artery, &ElasticTube::tether, 0), 1.25},
                                         Case{"ArteryFreeFast", with(artery, &ElasticTube::tether, 0), 300},
                                         Case{"Benchmark", benchmark, 1.25},
                                         Case{"BenchmarkFast", benchmark, 100},
                                         Case{"Thin", with(benchmark, &ElasticTube::thickness, 5e-3), 10},
                                         Case{"Thick", with(benchmark, &ElasticTube::thickness, 0.5), 10}),
                         [](const auto& instance) { return std::string(instance.param.name); });

/// Square of the phase speed of long waves (kR about 1e-3) in inviscid blood: its first order in the Stokes
/// layer, 1/alpha, is extrapolated away, which leaves some 1/alpha^2 = 1e-6.
double inviscid_speed_squared(ElasticTube tube) {
  const double scale =
      std::sqrt(tube.young_modulus * tube.thickness / (2 * tube.blood_density * tube.radius));
  const double w = 1e-3 * scale / tube.radius;
  const auto wave_number = [&](double number) {
    tube.viscosity = tube.radius * tube.radius * w * tube.blood_density / (number * number);
    return ElasticWomersley(tube, w).wave_number().real();
  };
  return std::pow(w / (2 * wave_number(2000) - wave_number(1000)), 2);
}

// c^2 = E h/(2 rho R), times 1/(1 - nu^2) where the wall is held axially, as h/R -> 0.
TEST(ElasticTubeLimits, ThinWallsHaveMoensAndKortewegsSpeed) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    const auto excess = [&](double thickness) {
      return inviscid_speed_squared({0.5, 0.5 * thickness, 3e6, nu, 1.2, 1.0, 0.0}) / (3e6 * thickness / 2) -
             1;
    };
    const double coarse = excess(2e-3), fine = excess(1e-3);
    // First order in h/R, coefficient of order 1.
    EXPECT_NEAR(coarse / fine, 2, 0.02) << nu;
    EXPECT_NEAR(2 * fine - coarse, 0, 1e-5) << nu;  // (h/R)^2, (kR)^2, 1/alpha^2
  }
}

TEST(ElasticTubeLimits, HeldThinWallsAreStifferByPoissonsEffect) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    // Stiff against axial motion of waves this long, K >> E h k^2, and soft against radial motion, K << E
    // h/R^2.
    const double plate = 3e6 * 5e-4, hoop = plate / 0.25;
    const double held = plate / (2 * 0.5 * (1 - nu * nu));
    // Thickness and spring are 1e-3 each.
    EXPECT_NEAR(inviscid_speed_squared({0.5, 5e-4, 3e6, nu, 1.2, 1.0, 0.0, 1e-3 * hoop}) / held, 1, 4e-3)
        << nu;
  }
}

// Long waves in a wall that is held axially: c^2 = R/(2 rho) dp/du of Lame's tube in plane strain, of any
// thickness; and for viscous blood k = (w/c) sqrt(I0/I2)(sR), Womersley's constrained tube.
TEST(ElasticTubeLimits, HeldThickWallsFollowLamesTube) {
  for (const double nu : {0.0, 0.3, 0.49}) {
    for (const double number : {0.3, 1.0, 5.0, 30.0}) {
      SCOPED_TRACE(testing::Message() << "nu " << nu << ", alpha " << number);
      ElasticTube tube{0.5, 0.2, 3e6, nu, 1.2, 1.0, 0.0, 1e6};
      const double w = 1e-2;
      tube.viscosity = tube.radius * tube.radius * w * tube.blood_density / (number * number);
      const LameTube lame({0.5, 0.2, 3e6, nu, tube.tether, tube.tether}, 1);
      const double speed =
          std::sqrt(tube.radius / (2 * tube.blood_density * lame.at(tube.radius).displacement[0]));
      const LongComplex x =
          std::polar(static_cast<long double>(number), -std::numbers::pi_v<long double> / 4);
      const BesselI i = bessel_i(x);
      const LongComplex expected = static_cast<long double>(w / speed) * std::sqrt(i.zero / i.two);
      const Complex k = ElasticWomersley(tube, w).wave_number();
      // (kR)^2 is some 1e-11, (kR)^2 E/(K R) as well, the shear's axial pull mu w/(K R) below 1e-8 even at
      // 0.3
      EXPECT_LT(std::abs(LongComplex(k) / expected - 1.0L), 1e-7);
    }
  }
}

// Long waves in inviscid blood and a free thick wall: Lame's solution with the axial strain e of
// sigma_zz = rho_s c^2 e (d sigma_zz/dz = rho_s d2u_z/dt2) and c^2 = R p/(2 rho u).
TEST(ElasticTubeLimits, FreeThickWallsFollowLamesTubeWithAxialInertia) {
  for (const double thickness : {0.01, 0.1, 0.5}) {
    for (const double nu : {0.0, 0.3, 0.49}) {
      SCOPED_TRACE(testing::Message() << "h " << thickness << ", nu " << nu);
      const ElasticTube tube{0.5, thickness, 3e6, nu, 1.2, 1.0, 0.0};
      const LinearTube wall{0.5, thickness, 3e6, nu};
      const LameTube pressed(wall, 1), strained(wall, 0, 0, 1);
      const auto u = [&](const LameTube& solution) { return solution.at(wall.radius).displacement[0]; };
      const auto axial = [&](const LameTube& solution) { return solution.at(wall.radius).stress(2, 2); };
      const double measured = inviscid_speed_squared(tube);
      const double strain = axial(pressed) / (tube.wall_density * measured - axial(strained));
      const double expected = wall.radius / (2 * tube.blood_density * (u(pressed) + strain * u(strained)));
      // (kR)^2 and what the Stokes layer leaves
      EXPECT_NEAR(measured / expected, 1, 5e-6);
    }
  }
}

// The thin tube's wave numbers (axial force of the blood's shear, Poisson's coupling, wall inertia, springs)
// are met at first order in h/R.
TEST(ElasticTubeLimits, ThinWallsFollowWomersleysElasticTube) {
  for (const double tether : {0.0, 300.0})
    for (const double nu : {0.3, 0.5 - 1e-3})
      for (const double number : {0.5, 3.0, 12.0}) {
        SCOPED_TRACE(testing::Message() << "K " << tether << ", nu " << nu << ", alpha " << number);
        const double w = 0.1;
        const auto error = [&](double thickness) {
          // E h, rho_s h and K stay as the wall gets thinner.
          ElasticTube tube{0.5, 0.5 * thickness, 3e3 / thickness, nu, 1e-2 / thickness, 1.0, 0.0, tether};
          tube.viscosity = tube.radius * tube.radius * w * tube.blood_density / (number * number);
          const LongComplex thin = std::sqrt(thin_wall_wave_numbers_squared(tube, w)[0]);
          return std::abs(LongComplex(ElasticWomersley(tube, w).wave_number()) / thin - 1.0L);
        };
        const long double coarse = error(4e-3), fine = error(2e-3);
        EXPECT_LT(fine, 5e-3L);
        EXPECT_NEAR(static_cast<double>(coarse / fine), 2, 0.05);
      }
}

TEST(ElasticTubeLimits, StiffTubeCarriesRigidPipesFlow) {
  ElasticTube tube = artery;
  tube.young_modulus = tube.tether = 1e13;
  const double w = 2 * pi * 5;
  const ElasticWomersley wave(tube, w);
  const auto rigid = Womersley::from_gradient({tube.radius, tube.blood_density, tube.viscosity}, w,
                                              Complex(0, -1) * wave.wave_number());
  for (const double share : {0.0, 0.3, 0.7, 0.99}) {
    const double r = share * tube.radius;
    // The wall's compliance is some p/E, that is (kR)^2 below 1e-8.
    EXPECT_LT(std::abs(wave.blood(r).velocity[2] - rigid.velocity(r)), 1e-7 * std::abs(rigid.velocity(0)));
  }
  EXPECT_LT(std::abs(-wave.blood(tube.radius).stress(0, 2) - rigid.wall_shear()),
            1e-7 * std::abs(rigid.wall_shear()));
}

TEST(ElasticTubeLimits, TooShortWavesAreRefused) {
  EXPECT_THROW(ElasticWomersley(benchmark, 2 * pi * 1000), std::runtime_error);
}

class StandingWave : public testing::Test {
 protected:
  double w = 2 * pi * 20, length = 5, time = 0.013, r = 0.31, z = 1.7;
  ElasticWomersley wave{benchmark, w};
  TubeWaves waves = TubeWaves::from_end_pressures(wave, length, Complex(100, 20), Complex(-30, 60));
};

TEST_F(StandingWave, HasThePressuresOfItsEnds) {
  EXPECT_LT(std::abs(waves.blood(0, 0).pressure - Complex(100, 20)), 1e-11);
  EXPECT_LT(std::abs(waves.blood(0, length).pressure - Complex(-30, 60)), 1e-11);
  // A forward wave alone
  const TubeWaves forward(wave, length, 2, 0);
  const Complex factor = 2.0 * std::exp(Complex(0, z) * wave.wave_number());
  EXPECT_LT(std::abs(forward.blood(r, z).velocity[2] - factor * wave.blood(r).velocity[2]), 1e-14);
  EXPECT_LT(std::abs(forward.wall(0.55, z).stress(0, 2) - factor * wave.wall(0.55).stress(0, 2)), 1e-14);
}

TEST_F(StandingWave, MirroredEndsMirrorTheWave) {
  const auto mirrored = TubeWaves::from_end_pressures(wave, length, Complex(-30, 60), Complex(100, 20));
  const auto a = waves.blood(r, z), b = mirrored.blood(r, length - z);
  const auto c = waves.wall(0.55, z), d = mirrored.wall(0.55, length - z);
  EXPECT_LT(std::abs(a.pressure - b.pressure), 1e-11);
  EXPECT_LT(std::abs(a.velocity[0] - b.velocity[0]), 1e-13);
  EXPECT_LT(std::abs(a.velocity[2] + b.velocity[2]), 1e-13);
  EXPECT_LT(std::abs(c.displacement[2] + d.displacement[2]), 1e-15);
  EXPECT_LT(std::abs(c.stress(2, 2) - d.stress(2, 2)), 1e-10);
  EXPECT_LT(std::abs(c.stress(0, 2) + d.stress(0, 2)), 1e-10);
}

// Real fields in time: equations of both media once more, now with derivatives along r, z and t by
// differences.
TEST_F(StandingWave, SatisfiesTheEquationsOfMotion) {
  const double dr = 2e-3, dz = 0.05, dt = 1e-4;
  const auto blood = [&](double radius, double axial, double at) { return waves.blood(radius, axial, at); };
  const auto wall = [&](double radius, double axial, double at) { return waves.wall(radius, axial, at); };
  const auto check = [&](const auto& point, double radius, double density, const auto& acceleration) {
    const auto here = point(radius, z, time);
    const auto along_r = [&](int i, int j) {
      return finite_difference([&](double p) { return point(p, z, time).stress(i, j); }, radius, dr);
    };
    const auto along_z = [&](int i, int j) {
      return finite_difference([&](double p) { return point(radius, p, time).stress(i, j); }, z, dz);
    };
    const double radial = along_r(0, 0) + (here.stress(0, 0) - here.stress(1, 1)) / radius + along_z(0, 2);
    const double axial = along_r(2, 0) + here.stress(2, 0) / radius + along_z(2, 2);
    double size = 0;
    for (const double entry : here.stress.entries) size = std::max(size, std::abs(entry));
    // Round-off of stresses differenced over dr
    EXPECT_NEAR(density * acceleration[0], radial, 1e-13 * size / dr);
    EXPECT_NEAR(density * acceleration[2], axial, 1e-13 * size / dr);
  };
  Vector<double> acceleration{};
  for (const int i : {0, 2})
    acceleration[i] = finite_difference([&](double t) { return blood(r, z, t).velocity[i]; }, time, dt);
  check(blood, r, benchmark.blood_density, acceleration);
  check(wall, 0.55, benchmark.wall_density, waves.wall_acceleration(0.55, z, time));

  const Vector<double> rate = waves.wall_velocity(0.5, z, time);
  for (const int i : {0, 2}) {
    const double by_difference =
        finite_difference([&](double t) { return wall(0.5, z, t).displacement[i]; }, time, dt);
    EXPECT_NEAR(rate[i], by_difference, 1e-11 * std::abs(rate[i])) << i;
    EXPECT_NEAR(rate[i], blood(0.5, z, time).velocity[i], 1e-12) << i;
    const double second =
        finite_difference([&](double t) { return waves.wall_velocity(0.5, z, t)[i]; }, time, dt);
    EXPECT_NEAR(waves.wall_acceleration(0.5, z, time)[i], second, 1e-10 * std::abs(second)) << i;
    const double axial_slope =
        finite_difference([&](double p) { return wall(0.55, p, time).displacement[i]; }, z, dz);
    EXPECT_NEAR(wall(0.55, z, time).gradient(i, 2), axial_slope, 1e-10 * std::abs(axial_slope)) << i;
    const double blood_slope =
        finite_difference([&](double p) { return blood(r, p, time).velocity[i]; }, z, dz);
    EXPECT_NEAR(blood(r, z, time).gradient(i, 2), blood_slope, 1e-10 * std::abs(blood_slope)) << i;
  }
}

}  // namespace
}  // namespace tunica::test_support
