#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# cpp-httplib 0.11.4: two servers have one port, both without a word, and share the requests.
#
# A second httplib::Server at a port that the first one has is told success by bind_to_port: the library sets
# SO_REUSEPORT on every socket, and the kernel then hands connections to either. A client of a numerical model that
# is served so (the C++ servers of UM-Bridge are) gets answers of two models, by chance. With socket options of
# one's own the second is refused.
#
# Needs g++. Exits 0 while this is so, 1 when it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# TLS and compression come with it, whatever their versions.
apt-get download -qq -o APT::Sandbox::User=root libcpp-httplib-dev=0.11.4+ds-1+deb12u1 \
  libcpp-httplib0.11=0.11.4+ds-1+deb12u1 libssl-dev libssl3 libbrotli-dev libbrotli1 zlib1g-dev zlib1g
for package in *.deb; do dpkg -x "$package" .; done

cat > servers.cpp <<'C'
#include <httplib.h>
#include <cstdio>
#include <string>
#include <thread>
int main() {
  for (const bool own : {false, true}) {
    httplib::Server first, second;
    int count[2] = {0, 0};
    first.Get("/", [&](const httplib::Request&, httplib::Response& reply) { reply.set_content("1", "text/plain"); });
    second.Get("/", [&](const httplib::Request&, httplib::Response& reply) { reply.set_content("2", "text/plain"); });
    if (own)
      for (auto* server : {&first, &second}) server->set_socket_options([](socket_t) {});
    const int port = first.bind_to_any_port("127.0.0.1");
    const bool has_it_too = second.bind_to_port("127.0.0.1", port);
    std::thread one([&] { first.listen_after_bind(); });
    std::thread two([&] { if (has_it_too) second.listen_after_bind(); });
    for (int i = 0; i < 200; ++i) {
      httplib::Client client("127.0.0.1", port);
      if (auto reply = client.Get("/")) ++count[reply->body == "2"];
    }
    first.stop();
    second.stop();
    one.join();
    two.join();
    std::printf("%s: the second server %s, %s\n", own ? "own socket options" : "as it is",
                has_it_too ? "has the port too" : "is refused",
                count[0] > 20 && count[1] > 20 ? "both answer" : count[0] == 200 ? "the first answers" : "else");
  }
}
C
libraries=$folder/usr/lib/x86_64-linux-gnu
g++ -std=c++17 -DCPPHTTPLIB_OPENSSL_SUPPORT -DCPPHTTPLIB_ZLIB_SUPPORT -DCPPHTTPLIB_BROTLI_SUPPORT -Iusr/include \
  -Iusr/include/x86_64-linux-gnu servers.cpp -o servers -L"$libraries" -lcpp-httplib -pthread \
  -Wl,--allow-shlib-undefined
cat > described <<'TEXT'
as it is: the second server has the port too, both answer
own socket options: the second server is refused, the first answers
TEXT
LD_LIBRARY_PATH=$libraries ./servers | tee seen
cmp -s seen described || { echo "described:"; cat described; exit 1; }
