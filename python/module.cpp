// SPDX-License-Identifier: GPL-3.0-or-later
// The module tunica._tunica: what the Python part of the package stands on. Its docstrings are those of the
// package's functions; nothing here is meant for users.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "app/full3d_by_name.hpp"
#include "app/tiers.hpp"
#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/run/door.hpp"
#include "core/scene/parameter.hpp"
#include "core/threads.hpp"
#include "python/tables.hpp"
#include "python/watch.hpp"

namespace tunica::python {

namespace py = pybind11;
namespace fs = std::filesystem;

namespace {

using Texts = std::vector<std::string>;

const TierList& tiers() {
  static const TierList all = [] {
    TierList list = light_tiers();
    list.push_back(full3d_by_name());
    return list;
  }();
  return all;
}

run::Question question_of(const Texts& quantities, const Texts& keys) {
  run::Question question;
  for (const std::string& name : quantities) question.quantities.push_back(run::parse_quantity(name));
  question.keys = keys;
  return question;
}

py::dict ending_of(const run::Outcome& outcome) {
  py::dict told;
  told["ending"] = run::name_of(outcome.ending);
  told["reason"] = outcome.reason;
  told["time"] = outcome.time;
  told["tier"] = outcome.tier;
  return told;
}

/// An array (rows, columns) of numbers.
py::array_t<double> matrix(const std::vector<std::vector<double>>& rows, std::size_t columns) {
  py::array_t<double> all({rows.size(), columns});
  auto cells = all.mutable_unchecked<2>();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < columns; ++k)
      cells(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) =
          rows[i].empty() ? observables::none : rows[i][k];
  return all;
}

run::DoorOptions by_program(const fs::path& program) {
  run::DoorOptions options;
  options.program = program;
  return options;
}

/// A scene file with overrides, and what computes it.
class Bound {
 public:
  Bound(const fs::path& file, const Texts& overrides, const fs::path& program)
      : door_(tiers(), run::SceneSource(file, overrides), by_program(program)) {}

  const Scene& scene() const { return door_.source().scene(); }

  py::dict values() const {
    py::dict all;
    for (const auto& [key, value] : scene().values()) all[py::str(key)] = value;
    return all;
  }

  py::dict ask(const std::string& tier, const Texts& quantities, const Texts& keys,
               const py::object& progress) const {
    const run::Question question = question_of(quantities, keys);
    run::Outcome outcome;
    watched(progress, [&](const RunControl& control) { outcome = door_.ask({tier, {}}, question, control); });
    py::dict told = ending_of(outcome);
    if (outcome.ending == run::Ending::done) {
      told["values"] = py::array_t<double>(static_cast<py::ssize_t>(outcome.answer.values.size()),
                                           outcome.answer.values.data());
      if (!keys.empty()) told["gradients"] = matrix(outcome.answer.gradients, keys.size());
    }
    return told;
  }

  py::dict compute(const std::string& tier, const fs::path& folder, bool resume,
                   const py::object& progress) const {
    run::Keep keep;
    keep.folder = folder;
    keep.earlier = resume ? Earlier::resume : Earlier::keep_stopped;
    run::Outcome outcome;
    watched(progress, [&](const RunControl& control) { outcome = door_.compute({tier, {}}, keep, control); });
    py::dict told = ending_of(outcome);
    if (outcome.stored) told["parts"] = parts_of(*outcome.stored);
    return told;
  }

  /// A row of values for each row of overrides; NaN and a reason where it cannot be computed.
  py::tuple evaluate(const std::string& tier, const std::vector<Texts>& rows, const Texts& quantities,
                     int threads, const py::object& progress) const {
    const run::Question question = question_of(quantities, {});
    std::vector<std::vector<double>> values(rows.size());
    Texts reasons(rows.size());
    std::atomic<long> ended{0};
    const int jobs = threads > 0 ? threads : available_threads();
    watched(progress, [&](const RunControl& control) {
      RunControl of_row;
      of_row.interrupted = control.interrupted;
      const auto one = [&](std::size_t row) {
        if (control.interrupted()) return;
        const ThreadLimit limit(jobs > 1 ? 1 : available_threads());
        run::Outcome outcome = door_.ask({tier, rows[row]}, question, of_row);
        if (outcome.ending == run::Ending::done)
          values[row] = std::move(outcome.answer.values);
        else
          reasons[row] = std::move(outcome.reason);
        Progress now;
        now.step = ++ended;
        now.time = static_cast<double>(now.step);
        now.end_time = static_cast<double>(rows.size());
        control.report(now);
      };
      // More jobs than cores are given when they are asked for.
      const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(std::max(jobs, available_threads())));
      tbb::task_arena arena(jobs);
      arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, rows.size(), 1),
            [&](const auto& range) {
              for (std::size_t row = range.begin(); row != range.end(); ++row) one(row);
            },
            tbb::simple_partitioner());
      });
    });
    return py::make_tuple(matrix(values, quantities.size()), reasons);
  }

 private:
  run::Door door_;
};

/// Unit and kind of a key. Throws InvalidInput for one that is not declared.
py::tuple declaration(const std::string& key) {
  const scene::Parameter* parameter = scene::find_parameter(key);
  if (!parameter) {
    const std::string nearest = scene::nearest_key(key);
    throw InvalidInput(fmt::format("{} is not a key of scenes{}", key,
                                   nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
  }
  const bool is_number = parameter->kind == scene::Kind::number || parameter->kind == scene::Kind::integer;
  return py::make_tuple(parameter->unit, is_number, parameter->meaning);
}

}  // namespace

PYBIND11_MODULE(_tunica, module) {
  module.attr("version") = program_version();
  module.attr("program_in_build") = TUNICA_PROGRAM_IN_BUILD;
  module.attr("program_in_install") = TUNICA_PROGRAM_IN_INSTALL;

  py::register_exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  py::register_exception<SolverFailure>(module, "SolverFailure", PyExc_RuntimeError);
  py::register_exception<OutputFailure>(module, "OutputFailure", PyExc_OSError);

  py::class_<Bound>(module, "Bound")
      .def(py::init<const fs::path&, const Texts&, const fs::path&>())
      .def("values", &Bound::values)
      .def("name", [](const Bound& bound) { return bound.scene().name(); })
      .def("remarks", [](const Bound& bound) { return bound.scene().remarks(); })
      .def("describe", [](const Bound& bound) { return describe(bound.scene()); })
      .def("ask", &Bound::ask)
      .def("compute", &Bound::compute)
      .def("evaluate", &Bound::evaluate);

  module.def("declaration", &declaration);
  module.def("read_result", [](const fs::path& folder) { return parts_of(read_result(folder)); });
  module.def("read_table", [](const std::string& file) { return columns_of(observables::read_csv(file)); });
  module.def("quantity_unit", [](const std::string& name) { return run::parse_quantity(name).unit(); });
  module.def("known_quantities", [] {
    Texts names;
    for (const run::Quantity& quantity : run::known_quantities()) names.push_back(quantity.name());
    return names;
  });
}

}  // namespace tunica::python
