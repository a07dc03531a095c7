// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gsl.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>

#include <stdexcept>

namespace tunica {

void let_gsl_return_codes() {
  gsl_set_error_handler_off();
}

void check_gsl(int code, const char* call) {
  if (code != GSL_SUCCESS) throw std::runtime_error(fmt::format("{}: {}", call, gsl_strerror(code)));
}

}  // namespace tunica
