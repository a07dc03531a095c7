// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/serve/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/threads.hpp"
#include "verification/sweep/axis.hpp"

namespace tunica::verification::serve {

namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

constexpr const char* model_name = "forward";

/// What the protocol has an error object for.
struct Refused {
  int status;
  std::string type, message;
};

[[noreturn]] void refuse_input(const std::string& message) {
  throw Refused{400, "InvalidInput", message};
}

const Json& member(const Json& request, const char* name) {
  const auto found = request.find(name);
  if (found == request.end()) refuse_input(fmt::format("the request has no \"{}\"", name));
  return *found;
}

std::vector<double> numbers(const Json& array, const std::string& name, std::size_t count) {
  if (!array.is_array() || array.size() != count)
    refuse_input(fmt::format("{} has to be a list of {} numbers", name, count));
  std::vector<double> values;
  for (const Json& one : array) {
    if (!one.is_number() || !std::isfinite(one.get<double>()))
      refuse_input(fmt::format("{} has to be a list of {} numbers", name, count));
    values.push_back(one.get<double>());
  }
  return values;
}

/// The model has one input and one output vector.
void expect_first(const Json& request, const char* name) {
  const Json& index = member(request, name);
  if (!index.is_number_integer() || index != 0)
    refuse_input(fmt::format("{} has to be 0: there is one vector of inputs and one of outputs", name));
}

void expect_model(const Json& request) {
  const Json& name = member(request, "name");
  if (name != model_name)
    throw Refused{400, "ModelNotFound", fmt::format("the only model is \"{}\"", model_name)};
  const auto config = request.find("config");
  if (config != request.end() && !config->is_null() && !config->empty())
    refuse_input("config has to be empty: the scene is configured where it is served");
}

}  // namespace

UmBridge::UmBridge(const run::Door& door, Served served, std::function<bool()> interrupted)
    : door_(door), served_(std::move(served)), interrupted_(std::move(interrupted)), gate_(served_.jobs) {
  for (const std::string& key : served_.inputs) {
    sweep::unit_of(key, "--inputs");
    if (scene::find_parameter(key)->kind != scene::Kind::number)
      throw InvalidInput(fmt::format("--inputs: {} does not hold a number", key));
    if (std::count(served_.inputs.begin(), served_.inputs.end(), key) > 1)
      throw InvalidInput(fmt::format("--inputs: {} is there twice; leave one out", key));
  }
  for (const run::Quantity& output : served_.outputs)
    if (std::count_if(served_.outputs.begin(), served_.outputs.end(),
                      [&](const run::Quantity& other) { return other.name() == output.name(); }) > 1)
      throw InvalidInput(fmt::format("--outputs: {} is there twice; leave one out", output.name()));
  try {
    door.prepare(run::Case{served_.tier, {run::sensitivity_override(served_.inputs)}}, {});
  } catch (const InvalidInput&) {
    has_gradients_ = false;
  }
}

Reply UmBridge::error(int status, const std::string& type, const std::string& message) {
  const Ordered json{{"error", {{"type", type}, {"message", message}}}};
  return {status, json.dump(-1, ' ', false, Ordered::error_handler_t::replace)};
}

Reply UmBridge::answer(std::string_view method, const std::string& path, const std::string& body) const {
  try {
    // Clients ask for /Info with GET, the others with POST.
    if (path == "/Info" && (method == "GET" || method == "POST"))
      return {200, Ordered{{"protocolVersion", 1.0}, {"models", {model_name}}}.dump()};
    const Json request = Json::parse(body, nullptr, false);
    if (request.is_discarded() || !request.is_object()) refuse_input("the body has to be a JSON object");
    return {200, dispatch(path, request).dump()};
  } catch (const Refused& refused) {
    return error(refused.status, refused.type, refused.message);
  }
}

Ordered UmBridge::dispatch(const std::string& path, const Json& request) const {
  expect_model(request);
  const std::size_t inputs = served_.inputs.size(), outputs = served_.outputs.size();
  if (path == "/InputSizes") return {{"inputSizes", {inputs}}};
  if (path == "/OutputSizes") return {{"outputSizes", {outputs}}};
  if (path == "/ModelInfo")
    return {{"support",
             {{"Evaluate", true},
              {"Gradient", has_gradients_},
              {"ApplyJacobian", has_gradients_},
              {"ApplyHessian", false}}}};
  if (path == "/Evaluate") {
    Ordered output = Ordered::array();
    output.push_back(evaluate(request, false).values);
    return {{"output", output}};
  }
  if (path != "/Gradient" && path != "/ApplyJacobian")
    throw Refused{path == "/ApplyHessian" ? 400 : 404, "UnsupportedFeature",
                  fmt::format("{} is not supported", scene::one_line(path))};
  if (!has_gradients_)
    throw Refused{400, "UnsupportedFeature",
                  fmt::format("the {} tier has no derivatives by all of these inputs", served_.tier)};
  expect_first(request, "outWrt");
  expect_first(request, "inWrt");
  const bool is_gradient = path == "/Gradient";
  const auto weights = is_gradient ? numbers(member(request, "sens"), "sens", outputs)
                                   : numbers(member(request, "vec"), "vec", inputs);
  const run::Answer answer = evaluate(request, true);
  std::vector<double> product(is_gradient ? inputs : outputs);
  for (std::size_t i = 0; i < outputs; ++i)
    for (std::size_t k = 0; k < inputs; ++k)
      product[is_gradient ? k : i] += answer.gradients[i][k] * weights[is_gradient ? i : k];
  return {{"output", product}};
}

std::vector<std::string> UmBridge::overrides(const Json& request) const {
  const Json& input = member(request, "input");
  if (!input.is_array() || input.size() != 1) refuse_input("input has to be a list of one list of numbers");
  const auto values = numbers(input[0], "input[0]", served_.inputs.size());
  std::vector<std::string> all;
  for (std::size_t k = 0; k < values.size(); ++k)
    all.push_back(fmt::format("{}={}", served_.inputs[k], sweep::value_text(values[k])));
  return all;
}

run::Answer UmBridge::evaluate(const Json& request, bool with_gradients) const {
  const run::Case what{served_.tier, overrides(request)};
  RunControl control;
  control.interrupted = interrupted_;
  run::Outcome outcome;
  gate_.acquire();
  try {
    const ThreadLimit limit(served_.jobs > 1 ? 1 : available_threads());
    outcome = door_.ask(what, {served_.outputs, with_gradients ? served_.inputs : std::vector<std::string>{}},
                        control);
  } catch (const OutputFailure& failure) {
    outcome.ending = run::Ending::gave_up;
    outcome.reason = failure.what();
  } catch (...) {
    gate_.release();
    throw;
  }
  gate_.release();
  if (outcome.ending == run::Ending::refused) refuse_input(outcome.reason);
  if (outcome.ending != run::Ending::done) throw Refused{500, "InvalidOutput", outcome.reason};
  for (std::size_t i = 0; i < served_.outputs.size(); ++i) {
    bool is_known = std::isfinite(outcome.answer.values[i]);
    if (with_gradients)
      for (const double one : outcome.answer.gradients[i]) is_known = is_known && std::isfinite(one);
    if (!is_known)
      throw Refused{500, "InvalidOutput", fmt::format("{} has no value there", served_.outputs[i].name())};
  }
  return std::move(outcome.answer);
}

}  // namespace tunica::verification::serve
