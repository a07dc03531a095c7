// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// False in the second and further processes of those that mpirun or a batch system has started together.
bool is_first_process();

}  // namespace tunica
