// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica {

/// Where results go unless --out says so: results/NAME, behind which stands what the command says besides the
/// scene: `parts` (a tier), then the overrides by their keys, as in "results/cylinder-axisym-wall.law=EXP1".
/// Of a key that is there twice the last one counts. Characters that shells and file systems do not take
/// become "_". Longer than 120 characters only a scene's own name can be; what was replaced or cut is told
/// apart by a checksum.
std::filesystem::path result_folder(const std::string& name, const std::vector<std::string>& parts,
                                    const std::vector<std::string>& overrides);

}  // namespace tunica
