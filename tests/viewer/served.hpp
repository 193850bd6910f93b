// A server of the viewer over the network of this machine, for tests of what it answers.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "../audit/drawn.hpp"
#include "support_errors.hpp"
#include "viewer/server.hpp"

namespace cleancolor {

using nlohmann::json;

inline std::string small_gcode() {
  Drawing d(drawn_machine({{0, 0}, {10, 0}}));
  for (int layer = 0; layer < 4; ++layer) {
    d.layer(layer).tool(0).wall().road({20, 20}, {40, 20});
    d.tool(1).wall().road({20, 30}, {40, 30}).dwell(20);
  }
  return d.text();
}

/// A connection to this port of this machine; the caller closes it.
inline int connected_socket(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(std::uint16_t(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  return socket;
}

/// Of a request that is let in, without its end.
inline std::string head(const Server& server, const std::string& request) {
  return request + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.access().port) +
         "\r\nAuthorization: Bearer " + server.access().token + "\r\n";
}

/// A server on a free port, and a client that knows its token.
class Served : public testing::Test {
 protected:
  Served()
      : api_({.machine = {.nozzle_offset_mm = {{0, 0}, {10, 0}}, .offsets_in = OffsetsIn::slicer},
              .threads = 2,
              .most_gcode_bytes = 100'000,
              .most_mesh_bytes = 10'000'000,
              .most_json_bytes = 2'000}),
        server_(api_, {.port = 0, .refused = [this](const std::string& line) { note(line); }}),
        client_("127.0.0.1", server_.access().port) {
    client_.set_default_headers({{"Authorization", "Bearer " + server_.access().token}});
    client_.set_read_timeout(60);  // on a busy machine, too
  }

  void note(const std::string& line) {
    const std::lock_guard lock(log_mutex_);
    log_.push_back(line);
  }
  std::vector<std::string> log() {
    const std::lock_guard lock(log_mutex_);
    return log_;
  }

  json get(const std::string& path, int status = 200) { return answer(client_.Get(path.c_str()), status); }
  json post(const std::string& path, const std::string& body, int status = 200) {
    return answer(client_.Post(path.c_str(), body, "application/octet-stream"), status);
  }
  json remove(const std::string& path, int status = 200) { return answer(client_.Delete(path.c_str()), status); }

  static json answer(const httplib::Result& result, int status) {
    if (!result) {
      ADD_FAILURE() << "no answer: " << httplib::to_string(result.error());
      return nullptr;
    }
    EXPECT_EQ(result->status, status) << result->body;
    return json::parse(result->body, nullptr, false);
  }

  /// Asks again and again until the state is one of them.
  json until(const std::string& path, const std::vector<std::string>& states) {
    for (int i = 0; i < 6000; ++i) {
      const json now = get(path);
      for (const std::string& state : states)
        if (now.at("state") == state) return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << path << " never came to " << states.front();
    return nullptr;
  }

  int model(const std::string& name) {
    return post("/api/meshes?name=" + name, file_text(CLEANCOLOR_ROOT "/models/" + name)).at("id");
  }

  static std::string job(int mesh, const std::string& settings = "{}") {
    return R"({"meshes": [{"id": )" + std::to_string(mesh) + R"(}], "settings": )" + settings + "}";
  }

  /// Bytes as they are; returns the whole answer. ends: nothing more comes, also where the request is not whole.
  std::string raw(const std::string& bytes, bool ends = false) const {
    const int socket = connected_socket(server_.access().port);
    std::string answer;
    if (::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == ssize_t(bytes.size())) {
      if (ends) ::shutdown(socket, SHUT_WR);
      std::array<char, 4096> piece;
      for (ssize_t n = 0; (n = ::recv(socket, piece.data(), piece.size(), 0)) > 0;)
        answer.append(piece.data(), std::size_t(n));
    }
    ::close(socket);
    return answer;
  }

  /// A request line with all headers that let it in.
  std::string raw_get(const std::string& target) const {
    return raw("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.access().port) +
               "\r\nAuthorization: Bearer " + server_.access().token + "\r\n\r\n");
  }

  std::mutex log_mutex_;
  std::vector<std::string> log_;
  Api api_;
  Server server_;
  httplib::Client client_;
};

}  // namespace cleancolor
