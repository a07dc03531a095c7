// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace tunica::verification::serve {

/// How requests that come by HTTP are answered.
struct HttpServer {
  std::string host;
  int port = 0;                  ///< 0: any that is free
  int threads = 1;               ///< that answer side by side
  std::size_t longest_body = 0;  ///< bytes
  /// Returns the reply's status and sets its body. `refused` is 0, or the status with which the request was
  /// turned away before it was read whole.
  std::function<int(const std::string& method, const std::string& path, const std::string& body, int refused,
                    std::string& reply)>
      answer;
  std::function<void(int port)> listening;
  std::function<bool()> stopped;  ///< asked some times a second
};

/// Answers until `stopped`. False when host and port cannot be listened at. It lives in a module of its own,
/// libtunica_http.so, which is loaded when something is served: the library behind it brings those for TLS
/// and compression, for which no other command should wait.
using Serve = bool (*)(const HttpServer& server);
inline constexpr const char* serve_symbol = "tunica_serve_http";

}  // namespace tunica::verification::serve
