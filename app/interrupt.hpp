// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// From here on Ctrl-C, SIGTERM and, unless it is ignored (nohup), SIGHUP are heeded: they end the program at
/// once, as there is nothing to keep.
void heed_interrupts(bool quiet);
/// From here on they are kept for stop_asked() instead, so that a run can store what it has, which is said at
/// once unless quiet. The second one ends the program at once.
void computation_begins();
bool stop_asked();
/// For processes that only serve one that heeds them: it decides when they end.
void ignore_interrupts();

}  // namespace tunica
