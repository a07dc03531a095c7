// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "verification/calibration/calibrate.hpp"

namespace tunica {

/// One HTML file, complete in itself: what a calibration found, what it misses, and how each search went.
std::string make_calibration_report(const std::string& scene, const verification::calibration::Task& task,
                                    const verification::calibration::Calibration& found);

}  // namespace tunica
