// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace tunica {

/// The root of a continuous function in [lower, upper], where it changes sign, to within `tolerance`
/// (Brent's method of GSL). Throws std::logic_error when the signs at the ends agree.
double find_root(const std::function<double(double)>& function, double lower, double upper, double tolerance);

}  // namespace tunica
