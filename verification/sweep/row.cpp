// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/row.hpp"

#include "core/scene/parameter.hpp"

namespace tunica::sweep {

std::vector<NumberColumn> number_columns(const run::Question& question) {
  std::vector<NumberColumn> columns;
  for (const run::Quantity& quantity : question.quantities)
    columns.push_back({quantity.name(), quantity.unit()});
  for (const run::Quantity& quantity : question.quantities)
    for (const std::string& key : question.keys) {
      auto head = observables::sensitivity_column(quantity.name(), quantity.unit(), key,
                                                  scene::find_parameter(key)->unit);
      columns.push_back({std::move(head.name), std::move(head.unit)});
    }
  return columns;
}

std::vector<double> numbers_of(const run::Answer& answer) {
  std::vector<double> numbers = answer.values;
  for (const auto& gradient : answer.gradients)
    numbers.insert(numbers.end(), gradient.begin(), gradient.end());
  return numbers;
}

}  // namespace tunica::sweep
