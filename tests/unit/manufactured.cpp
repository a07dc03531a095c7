// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/manufactured.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/kinematics.hpp"
#include "tests/support/random_deformation.hpp"

namespace tunica {
namespace {

using std::cos;
using std::exp;
using std::sin;
using std::sqrt;
using test_support::expect_near;
using test_support::RandomDeformation;
namespace manufactured = test_support::manufactured;
using manufactured::Axisymmetric;
using manufactured::Cartesian;

/// Results are sums of some ten terms of size 1 to 10.
constexpr double round_off = 2e-14;

/// A smooth motion of a tube, far from rest: d_r / r and d_z are even in r.
struct Motion {
  template <class S>
  Vector<S> operator()(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    return {r * (0.3 * cos(1.3 * z + 0.4 * t) + 0.2 * r * r * sin(z) * t), S(0.0),
            0.4 * sin(0.7 * z - t) * exp(-0.5 * r * r) + 0.1 * z * t};
  }
};

/// The same motion in Cartesian coordinates: x = r cos theta, y = r sin theta.
struct TurnedMotion {
  template <class S>
  Vector<S> operator()(const Vector<S>& x, const S& t) const {
    const S r = sqrt(x[0] * x[0] + x[1] * x[1]);
    const Vector<S> d = Motion{}(Vector<S>{r, S(0.0), x[2]}, t);
    return {d[0] * x[0] / r, d[0] * x[1] / r, d[2]};
  }
};

/// Stress of a compressible neo-Hookean body, P = mu (F - F^-T) + lambda ln J F^-T.
template <class S>
Tensor<S> stress(const Tensor<S>& displacement_gradient) {
  const Kinematics<S> k(displacement_gradient);
  const S factor = (2.0 * k.log_jacobian - 0.7) / k.jacobian;
  return 0.7 * k.deformation_gradient + factor * k.deformation_cofactor;
}

/// Tests at random points (r, 0, z), where the axes of both frames coincide.
template <class Check>
void at_random_points(const Check& check) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int k = 0; k < 20; ++k) {
    const Vector<double> x{random.uniform(0.2, 1.5), 0, random.uniform(-1, 1)};
    check(x, random.uniform(0, 1));
  }
}

void expect_vector_near(const Vector<double>& actual, const Vector<double>& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 10 * round_off) << i;
}

TEST(Manufactured, LaplaciansOfPolynomials) {
  const auto scalar = [](const auto& x, const auto&) { return x[0] * x[0] * x[2] * x[2] * x[2]; };
  const auto vector = [](const auto& x, const auto& t) {
    using S = std::remove_cvref_t<decltype(t)>;
    return Vector<S>{x[0] * x[0] * x[2] * x[2] * x[2], S(0.0), x[0] * x[0] * x[0] * x[2] * x[2]};
  };
  at_random_points([&](const Vector<double>& x, double time) {
    const double r = x[0], z = x[2];
    // grad (r^2 z^3) = (2 r z^3, 0, 3 r^2 z^2); lap = 4 z^3 + 6 r^2 z
    expect_vector_near(manufactured::gradient<Axisymmetric>(scalar, x, time),
                       {2 * r * z * z * z, 0, 3 * r * r * z * z});
    const auto slope = [&](const auto& p, const auto& t) {
      return manufactured::gradient<Axisymmetric>(scalar, p, t);
    };
    EXPECT_NEAR(manufactured::divergence<Axisymmetric>(slope, x, time), 4 * z * z * z + 6 * r * r * z,
                10 * round_off);
    // Div grad u = (lap u_r - u_r/r^2, 0, lap u_z)
    const auto gradient = [&](const auto& p, const auto& t) {
      return manufactured::gradient<Axisymmetric>(vector, p, t);
    };
    expect_vector_near(manufactured::divergence<Axisymmetric>(gradient, x, time),
                       {3 * z * z * z + 6 * r * r * z, 0, 9 * r * z * z + 2 * r * r * r});
    EXPECT_NEAR(manufactured::divergence<Axisymmetric>(vector, x, time),
                3 * r * z * z * z + 2 * r * r * r * z, 10 * round_off);
    // grad div u = Div (grad u)^T
    const auto transposed = [&](const auto& p, const auto& t) { return transpose(gradient(p, t)); };
    expect_vector_near(manufactured::divergence<Axisymmetric>(transposed, x, time),
                       {3 * z * z * z + 6 * r * r * z, 0, 9 * r * z * z + 2 * r * r * r});
  });
}

TEST(Manufactured, CofactorsHaveNoDivergence) {
  const auto check = [](auto frame, const auto& motion) {
    using Frame = decltype(frame);
    const auto cofactors = [&](const auto& x, const auto& t) {
      return Kinematics(manufactured::gradient<Frame>(motion, x, t)).deformation_cofactor;
    };
    at_random_points([&](const Vector<double>& x, double t) {
      expect_vector_near(manufactured::divergence<Frame>(cofactors, x, t), {0, 0, 0});
    });
  };
  check(Axisymmetric{}, Motion{});
  check(Cartesian{}, TurnedMotion{});
}

TEST(Manufactured, FramesAgree) {
  const auto piola = [](const auto& x, const auto& t) {
    return stress(manufactured::gradient<Axisymmetric>(Motion{}, x, t));
  };
  const auto turned_piola = [](const auto& x, const auto& t) {
    return stress(manufactured::gradient<Cartesian>(TurnedMotion{}, x, t));
  };
  at_random_points([&](const Vector<double>& x, double t) {
    expect_near(manufactured::gradient<Axisymmetric>(Motion{}, x, t),
                manufactured::gradient<Cartesian>(TurnedMotion{}, x, t), round_off);
    const Vector<double> force = manufactured::divergence<Axisymmetric>(piola, x, t);
    expect_vector_near(force, manufactured::divergence<Cartesian>(turned_piola, x, t));
    EXPECT_GT(std::abs(force[0]) + std::abs(force[2]), 1e-3);
  });
}

TEST(Manufactured, RatesOfKnownFunctions) {
  const auto wave = [](const auto& x, const auto& t) { return x[0] * sin(3.0 * t) * x[2]; };
  at_random_points([&](const Vector<double>& x, double t) {
    EXPECT_NEAR(manufactured::rate(wave, x, t), 3 * x[0] * x[2] * std::cos(3 * t), round_off);
    EXPECT_NEAR(manufactured::second_rate(wave, x, t), -9 * x[0] * x[2] * std::sin(3 * t), round_off);
  });
}

// dJ/dt = cof F : dF/dt, with F and its rate from nested duals in either order.
TEST(Manufactured, RatesAndGradientsCommute) {
  const auto velocity = [](const auto& x, const auto& t) { return manufactured::rate(Motion{}, x, t); };
  const auto gradient = [](const auto& x, const auto& t) {
    return manufactured::gradient<Axisymmetric>(Motion{}, x, t);
  };
  const auto jacobian = [&](const auto& x, const auto& t) { return Kinematics(gradient(x, t)).jacobian; };
  at_random_points([&](const Vector<double>& x, double t) {
    const Tensor<double> rate = manufactured::gradient<Axisymmetric>(velocity, x, t);
    expect_near(manufactured::rate(gradient, x, t), rate, round_off);
    EXPECT_NEAR(manufactured::rate(jacobian, x, t),
                contract(Kinematics(gradient(x, t)).deformation_cofactor, rate), round_off);
  });
}

// Div (sigma cof F) = J div sigma: what lets a forcing in the deformed body be written on the body at rest.
TEST(Manufactured, PiolaTransformCarriesDivergences) {
  const auto sigma_at = [](const auto& y) {  // a tensor field of the deformed place
    using S = std::remove_cvref_t<decltype(y[0])>;
    Tensor<S> s;
    s(0, 0) = y[0] * y[0] + y[2];
    s(1, 1) = y[0] * y[0] + 2.0 * y[2];
    s(0, 2) = s(2, 0) = y[0] * sin(y[2]);
    s(2, 2) = cos(y[0]) * y[2];
    return s;
  };
  const auto carried = [&](const auto& x, const auto& t) {
    const auto d = Motion{}(x, t);
    auto y = x;
    for (int i = 0; i < 3; ++i) y[i] = x[i] + d[i];
    return sigma_at(y) *
           Kinematics(manufactured::gradient<Axisymmetric>(Motion{}, x, t)).deformation_cofactor;
  };
  const auto spatial = [&](const auto& y, const auto&) { return sigma_at(y); };
  at_random_points([&](const Vector<double>& x, double t) {
    const Vector<double> d = Motion{}(x, t), y{x[0] + d[0], 0, x[2] + d[2]};
    const double jacobian = Kinematics(manufactured::gradient<Axisymmetric>(Motion{}, x, t)).jacobian;
    const Vector<double> force = manufactured::divergence<Axisymmetric>(spatial, y, t);
    expect_vector_near(manufactured::divergence<Axisymmetric>(carried, x, t),
                       {jacobian * force[0], 0, jacobian * force[2]});
  });
}

}  // namespace
}  // namespace tunica
