// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// From here on Ctrl-C and SIGTERM are heeded: they end the program at once, as there is nothing to keep.
void heed_interrupts();
/// From here on they are kept for stop_asked() instead, so that a run can store what it has.
void computation_begins();
bool stop_asked();

}  // namespace tunica
