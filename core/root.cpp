// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/root.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <memory>
#include <new>
#include <stdexcept>

#include "core/gsl.hpp"

namespace tunica {

double find_root(const std::function<double(double)>& function, double lower, double upper,
                 double tolerance) {
  let_gsl_return_codes();
  const double at_lower = function(lower);
  const double at_upper = function(upper);
  if (at_lower == 0) return lower;
  if (at_upper == 0) return upper;
  if ((at_lower > 0) == (at_upper > 0))
    throw std::logic_error("find_root: no change of sign in the interval");

  gsl_function callback{
      [](double x, void* f) { return (*static_cast<const std::function<double(double)>*>(f))(x); },
      const_cast<std::function<double(double)>*>(&function)};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (!solver) throw std::bad_alloc();
  if (gsl_root_fsolver_set(solver.get(), &callback, lower, upper) != GSL_SUCCESS)
    throw std::logic_error("find_root: the function is not finite at the ends of the interval");
  constexpr int most_iterations = 200;
  for (int k = 0; k < most_iterations; ++k) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS)
      throw std::logic_error("find_root: the function is not finite inside the interval");
    const double a = gsl_root_fsolver_x_lower(solver.get()), b = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(a, b, tolerance, 0.0) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace tunica
