// SPDX-License-Identifier: GPL-3.0-or-later
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/interrupt.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/run/choose_tier.hpp"
#include "core/threads.hpp"
#include "verification/serve/http.hpp"
#include "verification/serve/protocol.hpp"

namespace tunica {

namespace fs = std::filesystem;
namespace serve = verification::serve;

namespace {

constexpr const char* serve_examples =
    R"TEXT(Speaks the UM-Bridge protocol (version 1.0) until Ctrl-C. The model is called "forward"; it has one
input vector (the keys, each in its unit) and one output vector (the quantities).

Examples:
  tunica serve scenes/cylinder.toml --inputs outlet.resistance --outputs pressure.max,pressure.min
  curl -d '{"name": "forward", "input": [[1e6]], "config": {}}' http://127.0.0.1:4242/Evaluate

Exit codes: 0 ended by Ctrl-C, 2 bad input or a port that cannot be had.)TEXT";

/// The module with the HTTP server: beside the program where it was built, else in the install's own folder.
serve::Serve load_server() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  std::string reasons;
  for (const fs::path& file : {here / TUNICA_HTTP_MODULE, here / TUNICA_HTTP_FROM_PROGRAM}) {
    // It stays loaded until the program ends.
    if (void* module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (void* symbol = ::dlsym(module, serve::serve_symbol)) return reinterpret_cast<serve::Serve>(symbol);
    reasons += fmt::format("; {}", ::dlerror());
  }
  throw InvalidInput(fmt::format("serve: the module with the HTTP server cannot be loaded{}", reasons));
}

}  // namespace

CLI::App* add_serve_command(CLI::App& app, ServeArguments& arguments) {
  auto* command = app.add_subcommand("serve", "Answer UQ tools by HTTP (UM-Bridge)");
  command->footer(serve_examples);
  const auto option = [&](const char* name, auto& value, const char* text, const char* type) {
    return command->add_option(name, value, text)->type_name(type);
  };
  option("scene", arguments.scene, "Scene file (TOML)", "SCENE")->required();
  option("--inputs", arguments.inputs, "Keys that a request gives values of, separated by commas", "KEY,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->required();
  option("--outputs", arguments.outputs, "Quantities that it is answered with, separated by commas",
         "QUANTITY,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->required();
  option("--tier", arguments.tier, "Model to compute with: auto, lumped, axisym or full3d", "TIER");
  option("--host", arguments.host, "Address to listen at (default: 127.0.0.1, this machine only)", "ADDRESS");
  option("--port", arguments.port, "Port to listen at (default 4242; 0: any that is free)", "P")
      ->check(CLI::Range(0, 65535));
  option("--jobs", arguments.jobs, "Evaluations side by side (default: all cores)", "N")
      ->check(CLI::Range(1, 1024));
  option("--set", arguments.overrides, "Override a key of the scene; may be repeated", "KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
  return command;
}

int serve_command(const ServeArguments& arguments, const Program& program) {
  run::DoorOptions options;
  options.program = fs::read_symlink("/proc/self/exe").parent_path() / "tunica";
  const run::Door door(program.tiers(), run::SceneSource(arguments.scene, arguments.overrides), options);
  const Tier& tier = run::choose_tier(program.tiers(), arguments.tier, door.source().scene());
  serve::Served served{std::string(tier.name()), arguments.inputs, {}, 1};
  for (const std::string& name : arguments.outputs) served.outputs.push_back(run::parse_quantity(name));
  served.jobs = arguments.jobs > 0 ? arguments.jobs : tier.computes() ? available_threads() : 1;
  const serve::UmBridge model(door, served, stop_asked);
  const serve::Serve serve_http = load_server();
  heed_interrupts(true);
  if (!arguments.quiet)
    for (const auto& remark : door.source().scene().remarks()) spdlog::warn(remark);

  constexpr int waiting_threads = 8;
  serve::HttpServer server;
  server.host = arguments.host;
  server.port = arguments.port;
  // Those that wait for their turn, and questions about the model, do not keep an evaluation from going on.
  server.threads = served.jobs + waiting_threads;
  server.longest_body = 1 << 20;
  server.answer = [&](const std::string& method, const std::string& path, const std::string& body,
                      int refused, std::string& text) {
    const serve::Reply reply =
        refused == 0 ? model.answer(method, path, body)
                     : serve::UmBridge::error(refused, "InvalidInput",
                                              refused == 413 ? "the request is longer than 1 MiB"
                                                             : "the request cannot be read");
    text = reply.body;
    return reply.status;
  };
  server.listening = [&](int port) {
    computation_begins();
    if (arguments.quiet) return;
    tell(fmt::format("http://{}:{}: {} tier, from {} to {}{}; Ctrl-C ends\n", arguments.host, port,
                     served.tier, fmt::join(arguments.inputs, ", "), fmt::join(arguments.outputs, ", "),
                     model.has_gradients() ? ", with derivatives" : ""),
         stdout);
    std::fflush(stdout);
  };
  server.stopped = stop_asked;
  if (!serve_http(server) && !stop_asked())
    throw InvalidInput(
        fmt::format("serve: {}:{} cannot be listened at: take another --port (another server may have "
                    "this one), or an address of this machine for --host",
                    arguments.host, arguments.port));
  return done;
}

}  // namespace tunica
