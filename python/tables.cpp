// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/tables.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace tunica::python {

namespace py = pybind11;

py::list columns_of(const observables::Table& table) {
  py::list columns;
  for (const observables::Column& column : table.columns()) {
    py::object values;
    if (column.is_text())
      values = py::cast(column.labels);
    else
      values = py::array_t<double>(static_cast<py::ssize_t>(column.values.size()), column.values.data());
    columns.append(py::make_tuple(column.name, column.unit, values));
  }
  return columns;
}

py::dict parts_of(const StoredResult& stored) {
  const Result& result = stored.result;
  py::dict parts;
  parts["record"] = stored.record.dump();
  parts["observables"] = columns_of(result.observables);
  parts["profiles"] = columns_of(result.profiles);
  parts["events"] = columns_of(result.events);
  parts["sensitivities"] = columns_of(result.sensitivities);
  parts["event_sensitivities"] = columns_of(result.event_sensitivities);
  parts["recruited_time"] = columns_of(result.recruited_time);
  parts["compartments"] = columns_of(result.compartments);
  parts["along"] = columns_of(result.along);
  return parts;
}

}  // namespace tunica::python
