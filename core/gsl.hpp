// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// Has GSL return codes, for its own handler would end the program. To be called before what can fail.
void let_gsl_return_codes();

/// Throws std::runtime_error naming the call of GSL that failed and its reason.
void check_gsl(int code, const char* call);

}  // namespace tunica
