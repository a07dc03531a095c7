// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include "core/observables/result.hpp"

namespace tunica::python {

/// A table as a list of (name, unit, values): a numpy array, or a list of str with the unit "".
pybind11::list columns_of(const observables::Table& table);

/// {"observables": ..., "record": JSON text, ...}: the tables by the names of their files.
pybind11::dict parts_of(const StoredResult& stored);

}  // namespace tunica::python
