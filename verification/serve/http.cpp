// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/serve/http.hpp"

#include <httplib.h>

#include <chrono>
#include <thread>

extern "C" bool tunica_serve_http(const tunica::verification::serve::HttpServer& how);

bool tunica_serve_http(const tunica::verification::serve::HttpServer& how) {
  httplib::Server server;
  server.new_task_queue = [&] { return new httplib::ThreadPool(static_cast<std::size_t>(how.threads)); };
  server.set_payload_max_length(how.longest_body);
  // The library's own options let two servers have one port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  // A connection that waits holds a thread.
  server.set_keep_alive_timeout(1);
  server.set_read_timeout(5);
  const auto reply = [&](const httplib::Request& request, httplib::Response& response) {
    std::string body;
    response.status = how.answer(request.method, request.path, request.body, 0, body);
    response.set_content(body, "application/json");
  };
  server.Get(".*", reply);
  server.Post(".*", reply);
  server.set_error_handler([&](const httplib::Request& request, httplib::Response& response) {
    if (!response.body.empty()) return;
    std::string body;
    how.answer(request.method, request.path, {}, response.status, body);
    response.set_content(body, "application/json");
  });
  const int port = how.port == 0 ? server.bind_to_any_port(how.host)
                                 : (server.bind_to_port(how.host, how.port) ? how.port : -1);
  if (port < 0) return false;
  std::jthread watch([&](const std::stop_token& token) {
    while (!token.stop_requested() && !how.stopped())
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    server.stop();
  });
  how.listening(port);
  return server.listen_after_bind();
}
