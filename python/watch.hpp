// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "core/tier.hpp"

namespace tunica::python {

/// Computes in a thread of its own while other Python threads go on. The calling thread looks for signals
/// every few hundredths of a second, and tells `progress` (a callable, or None) the latest with
/// (beat, time, end_time, step). What a signal or the callable raises ends the computation by the control's
/// `interrupted`, and is raised from here once it has ended; else what the computation throws. To be called
/// with the interpreter's lock held.
void watched(const pybind11::object& progress, const std::function<void(const RunControl&)>& compute);

}  // namespace tunica::python
