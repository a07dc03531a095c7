// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>

namespace tunica {

/// Writes to standard error, or out. Where that has gone, with the terminal, nobody hears it, which is no
/// reason to lose results or an exit code (fmt::print would throw).
inline void tell(const std::string& text, std::FILE* where = stderr) {
  std::fputs(text.c_str(), where);
}

}  // namespace tunica
