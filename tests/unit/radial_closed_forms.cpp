// SPDX-License-Identifier: GPL-3.0-or-later
// The thick ring against solutions in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

using test_support::joined;
using test_support::model_with;

constexpr double inner = 0.033, outer = 0.043;

/// Incompressible neo-Hookean tube: r^2 = R^2 + c, tau_TT - tau_RR = mu (l^2 - l^-2) for l = r/R, and
/// equilibrium d(sigma_RR)/dr = (tau_TT - tau_RR)/r. From dl/l = dr/r - dR/R = (1 - l^2) dr/r,
///   sigma_RR(r) - sigma_RR(r_i) = int mu (l^2 - l^-2)/(1 - l^2) dl/l = -mu [ln l - 1/(2 l^2)] between them.
struct NeoHookeanTube {
  double mu, stretch;
  double outer_radius = outer;
  double ratio(double radius) const {
    return std::sqrt(1 + (stretch * stretch - 1) * inner * inner / (radius * radius));
  }
  static double primitive(double ratio) { return std::log(ratio) - 1 / (2 * ratio * ratio); }
  /// sigma_RR(R) - sigma_RR at the inner surface
  double radial_stress_gain(double radius) const {
    return mu * (primitive(stretch) - primitive(ratio(radius)));
  }
  double outer_displacement() const { return outer_radius * (ratio(outer_radius) - 1); }
};

std::vector<std::string> neo_hookean(const std::string& tether, const std::string& reading = "normal") {
  return {"wall.law=neo-Hookean", "wall.shear_modulus=76350", "wall.incompressible=true",
          "tether.stiffness=" + tether, "tether.traction=" + reading};
}

TEST(RadialClosedForm, IncompressibleNeoHookeanTube) {
  for (const double stretch : {0.7, 0.95, 1.02, 1.2, 1.5, 2.5}) {
    SCOPED_TRACE(stretch);
    const NeoHookeanTube tube{76350, stretch};
    const auto response = model_with(neo_hookean("0"))->respond(stretch, std::array{0.0, 0.4, 1.0}, false);
    // A Gauss rule of 12 points integrates this smooth function to round-off; closer to rest the
    // closed form itself, a difference of numbers of order 1, would lose digits.
    EXPECT_NEAR(response.pressure / tube.radial_stress_gain(outer), 1, 1e-12);
    const double scale = std::abs(response.pressure);
    EXPECT_NEAR(response.states[0].radial_stress, -response.pressure, 1e-12 * scale);
    EXPECT_NEAR(response.states[1].radial_stress, -response.pressure + tube.radial_stress_gain(inner + 0.004),
                1e-12 * scale);
    EXPECT_NEAR(response.states[2].radial_stress, 0, 1e-12 * scale);
    EXPECT_NEAR(response.states[2].displacement, tube.outer_displacement(), 1e-14);
  }
}

// The closed form, a difference of numbers of order 1, has two digits less where the wall is thin.
TEST(RadialClosedForm, ThinnestTubeOfAScene) {
  const double thickness = 0.01 * inner;
  auto keys = neo_hookean("0");
  keys.push_back("geometry.thickness=" + std::to_string(thickness));
  const auto model = model_with(keys);
  for (const double stretch : {0.95, 1.1, 1.5}) {
    const NeoHookeanTube tube{76350, stretch, inner + thickness};
    const double exact = tube.radial_stress_gain(inner + thickness);
    EXPECT_NEAR(model->respond(stretch, {}, false).pressure / exact, 1, 1e-11) << stretch;
  }
}

TEST(RadialClosedForm, TetherAddsItsPressure) {
  const double stretch = 1.35;
  const NeoHookeanTube tube{76350, stretch};
  const double u = tube.outer_displacement();
  const double by_current_area = 1e7 * u;
  const double by_reference_area = 1e7 * u * outer / (outer + u);
  const auto pressure = [&](const char* reading) {
    return model_with(neo_hookean("1e7", reading))->respond(stretch, {}, false).pressure;
  };
  const double wall = tube.radial_stress_gain(outer);
  EXPECT_NEAR(pressure("normal") / (wall + by_current_area), 1, 1e-12);
  EXPECT_NEAR(pressure("reference") / (wall + by_reference_area), 1, 1e-12);
  EXPECT_EQ(pressure("current"), pressure("normal"));
}

TEST(RadialClosedForm, IncompressibleSlopeIsThatOfTheClosedForm) {
  const auto model = model_with(neo_hookean("0"));
  for (const double s : {0.8, 1.1, 1.9}) {
    // d/ds of primitive(s) - primitive(l_o): (1/l + 1/l^3) each, with dl_o/ds = s (R_i/R_o)^2 / l_o.
    const double o = NeoHookeanTube{76350, s}.ratio(outer);
    const double slope = 76350 * ((1 / s + 1 / (s * s * s)) -
                                  (1 / o + 1 / (o * o * o)) * s * inner * inner / (outer * outer) / o);
    EXPECT_NEAR(model->respond(s, {}, false).pressure_slope / slope, 1, 1e-11);
  }
}

// J - 1 is of the order of p/kappa, so the two walls differ by that much: ten times less for ten
// times kappa, up to the next order (p/kappa)^2 and, at the far end, round-off of kappa (J-1).
TEST(RadialClosedForm, CompressibleWallTendsToTheIncompressibleOne) {
  for (const char* law : test_support::paper_laws) {
    for (const double stretch : {1.2, 1.45}) {
      SCOPED_TRACE(testing::Message() << law << " at " << stretch);
      const std::vector<std::string> base{std::string("wall.law=") + law};
      const double exact =
          model_with(joined(base, {"wall.incompressible=true"}))->respond(stretch, {}, false).pressure;
      const auto gap = [&](const char* kappa) {
        return model_with(joined(base, {std::string("wall.bulk_modulus=") + kappa}))
                   ->respond(stretch, {}, false)
                   .pressure -
               exact;
      };
      const double at_8 = gap("1e8"), at_9 = gap("1e9"), at_10 = gap("1e10");
      EXPECT_NEAR(at_8 / at_9, 10, 0.3);
      EXPECT_NEAR(at_9 / at_10, 10, 0.05);
      EXPECT_LT(std::abs(at_10), 2e-4 * exact);
    }
  }
}

/// Lame's thick-walled cylinder in plane strain: u = A R + B/R, P_RR = 2 (lambda + mu) A - 2 mu B/R^2.
struct Lame {
  double lambda, mu;
  Lame(double young, double nu)
      : lambda(young * nu / ((1 + nu) * (1 - 2 * nu))), mu(young / (2 * (1 + nu))) {}
  double a = 0, b = 0;
  double displacement(double radius) const { return a * radius + b / radius; }
  double stress(double radius) const { return 2 * (lambda + mu) * a - 2 * mu * b / (radius * radius); }
  /// Inner displacement given, P_RR = -k u outside.
  void solve(double inner_displacement, double k) {
    // [R_i, 1/R_i; 2 (lambda+mu) + k R_o, -2 mu/R_o^2 + k/R_o] (A, B) = (u_i, 0)
    const double c = 2 * (lambda + mu) + k * outer, d = -2 * mu / (outer * outer) + k / outer;
    const double determinant = inner * d - c / inner;
    a = inner_displacement * d / determinant;
    b = -inner_displacement * c / determinant;
  }
};

TEST(RadialClosedForm, LinearElasticWallIsLamesCylinder) {
  for (const double nu : {0.3, 0.499999})
    for (const auto& [stiffness, stretch] : {std::pair{0.0, 1 + 1e-9},
                                             {0.0, 1.01},
                                             {0.0, 1.3},
                                             {0.0, 0.9},
                                             {1e7, 1 + 1e-9},
                                             {1e7, 1.01},
                                             {1e7, 1.3},
                                             {1e7, 0.9}}) {
      SCOPED_TRACE(testing::Message() << stretch << ", tether " << stiffness << ", Poisson's ratio " << nu);
      const auto model = model_with(
          {"wall.law=linear-elastic", "wall.young_modulus=3e6", "wall.poisson_ratio=" + std::to_string(nu),
           "tether.stiffness=" + std::to_string(stiffness), "tether.traction=reference"});
      Lame lame(3e6, nu);
      lame.solve((stretch - 1) * inner, stiffness);
      const std::array places{0.0, 0.35, 1.0};
      const auto response = model->respond(stretch, places, false);
      // The pressure acts on the current inner surface: p r_i = -P_RR R_i. Strains of volume that are 1e-6 of
      // the others leave it a digit less.
      EXPECT_NEAR(response.pressure / (-lame.stress(inner) / stretch), 1, nu < 0.4 ? 1e-10 : 1e-9);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double radius = inner + 0.01 * places[k];
        EXPECT_NEAR(response.states[k].displacement / lame.displacement(radius), 1, 1e-10);
        // Slopes of polynomials of degree 8 keep two or three digits less.
        EXPECT_NEAR(response.states[k].radial_slope / (lame.a - lame.b / (radius * radius)), 1, 1e-7);
      }
    }
}

TEST(RadialClosedForm, StVenantKirchhoffTendsToLameLinearly) {
  const auto model =
      model_with({"wall.law=St-Venant-Kirchhoff", "wall.young_modulus=3e6", "wall.poisson_ratio=0.3"});
  const auto gap = [&](double strain) {
    Lame lame(3e6, 0.3);
    lame.solve(strain * inner, 1e7);
    return model->respond(1 + strain, {}, false).pressure / -lame.stress(inner) - 1;
  };
  // First order: half the strain, half the difference; the next order is the strain itself.
  for (const double strain : {1e-3, 1e-4}) EXPECT_NEAR(gap(strain) / gap(strain / 2), 2, 10 * strain);
  EXPECT_LT(std::abs(gap(1e-6)), 1e-5);
}

// A wall of compressible neo-Hookean tissue at small strain is Lame's with lambda = kappa - 2/3 mu.
TEST(RadialClosedForm, OtherLawsHaveTheirSmallStrainModuli) {
  const double kappa = 9e6, mu = 76350;
  Lame lame(9 * kappa * mu / (3 * kappa + mu), (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu)));
  EXPECT_NEAR(lame.mu, mu, 1e-8);
  const double strain = 1e-6;
  lame.solve(strain * inner, 1e7);
  for (const char* law : {"neo-Hookean", "neo-Hookean-compressible", "EXP1"}) {
    SCOPED_TRACE(law);
    const auto model = model_with({std::string("wall.law=") + law});
    // Terms of second order in the strain, hoop and radial: some 1e-5 of the first. U'' (1) = kappa for each.
    EXPECT_NEAR(model->respond(1 + strain, {}, false).pressure / -lame.stress(inner), 1, 2e-5);
  }
}

TEST(RadialClosedForm, RestIsUnloaded) {
  for (const char* law : test_support::paper_laws) {
    // A smooth step leaves unrecruited fibres a share of 1e-6 of their stress, so it is made sharp.
    const auto model = model_with({std::string("wall.law=") + law, "wall.recruitment=sharp"});
    const auto response = model->respond(1.0, std::array{0.5}, false);
    // kappa times round-off of a displacement gradient of 0
    EXPECT_NEAR(response.pressure, 0, 1e-6) << law;
    EXPECT_NEAR(response.states[0].displacement, 0, 1e-14) << law;
  }
}

TEST(RadialClosedForm, ClosedLumenIsRefused) {
  for (const char* incompressible : {"true", "false"}) {
    const auto model = model_with({std::string("wall.incompressible=") + incompressible});
    for (const double stretch : {0.0, -0.5}) {
      try {
        model->respond(stretch, {}, false);
        ADD_FAILURE() << "an equilibrium with a closed lumen";
      } catch (const SolverFailure& failure) {
        EXPECT_NE(std::string(failure.what()).find("the lumen has closed"), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace tunica
