// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <semaphore>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/run/door.hpp"

namespace tunica::verification::serve {

/// What is served: one vector of scene keys in, one vector of quantities out, each in its unit.
struct Served {
  std::string tier;  ///< its name, not "auto"
  std::vector<std::string> inputs;
  std::vector<run::Quantity> outputs;
  int jobs = 1;  ///< evaluations side by side; others wait
};

struct Reply {
  int status = 200;
  std::string body;  ///< JSON
};

/// The model "forward" by the UM-Bridge protocol, version 1.0 (Seelinger et al., JOSS 2023): the text of
/// requests and replies, without the wire. Any number of threads may ask at once.
class UmBridge {
 public:
  /// `interrupted` ends evaluations under way. The door must outlive it. Throws InvalidInput for inputs that
  /// are no number keys, and inputs or outputs that are there twice.
  UmBridge(const run::Door& door, Served served, std::function<bool()> interrupted);

  /// Never throws but for want of memory: what cannot be answered is an error object of the protocol,
  /// {"error": {"type": ..., "message": ...}}.
  Reply answer(std::string_view method, const std::string& path, const std::string& body) const;

  bool has_gradients() const { return has_gradients_; }

  static Reply error(int status, const std::string& type, const std::string& message);

 private:
  nlohmann::ordered_json dispatch(const std::string& path, const nlohmann::json& request) const;
  run::Answer evaluate(const nlohmann::json& request, bool with_gradients) const;
  std::vector<std::string> overrides(const nlohmann::json& request) const;

  const run::Door& door_;
  Served served_;
  std::function<bool()> interrupted_;
  bool has_gradients_ = true;
  mutable std::counting_semaphore<> gate_;
};

}  // namespace tunica::verification::serve
