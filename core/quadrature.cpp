// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/quadrature.hpp"

#include <fmt/format.h>
#include <gsl/gsl_integration.h>

#include <memory>
#include <new>
#include <stdexcept>

#include "core/gsl.hpp"

namespace tunica {

std::vector<QuadraturePoint> gauss_legendre(int points) {
  if (points < 1)
    throw std::invalid_argument(fmt::format("a Gauss rule has at least one point, not {}", points));
  let_gsl_return_codes();
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(points), &gsl_integration_glfixed_table_free);
  if (!table) throw std::bad_alloc();
  std::vector<QuadraturePoint> rule(points);
  for (int q = 0; q < points; ++q)
    check_gsl(gsl_integration_glfixed_point(-1.0, 1.0, q, &rule[q].position, &rule[q].weight, table.get()),
              "gsl_integration_glfixed_point");
  return rule;
}

}  // namespace tunica
