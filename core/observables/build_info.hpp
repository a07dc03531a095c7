// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tunica {

/// The project's version, "0.1.0".
std::string_view program_version();

/// The commit that the library was built from, "-dirty" behind it when files differed from it; empty
/// when the sources were no git checkout.
std::string_view program_commit();

}  // namespace tunica
