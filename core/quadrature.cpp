// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/quadrature.hpp"

#include <gsl/gsl_integration.h>

namespace tunica {

std::vector<QuadraturePoint> gauss_legendre(int points) {
  gsl_integration_glfixed_table* table = gsl_integration_glfixed_table_alloc(points);
  std::vector<QuadraturePoint> rule(points);
  for (int q = 0; q < points; ++q)
    gsl_integration_glfixed_point(-1.0, 1.0, q, &rule[q].position, &rule[q].weight, table);
  gsl_integration_glfixed_table_free(table);
  return rule;
}

}  // namespace tunica
