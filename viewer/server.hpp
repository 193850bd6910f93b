// viewer/server.hpp
//
// Server: the API and the page over HTTP, to whoever knows the token.
//
//   request  ->  Host, Origin, token (viewer/access.hpp)  ->  Api  ->  answer with the headers that keep browsers safe
//
// A connection carries one request: whatever was sent beyond it is never taken for another one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "viewer/access.hpp"
#include "viewer/api.hpp"

namespace cleancolor {

struct ServerOptions {
  static constexpr int usual_port = 8737;

  std::string address = "127.0.0.1";
  std::optional<int> port = {};  // empty: the usual one, or any where that is taken; 0: any
  double patience_s = 10;        // with a client that sends or takes nothing: viewer/connection.hpp
  std::function<void(const std::string&)> refused = [](const std::string&) {};  // a line for each; one at a time
};

class Server {
 public:
  /// Listens when it is made.  Throws SystemError where it cannot.  The API must outlive it.
  Server(Api& api, const ServerOptions& options);
  /// Ends what runs, whatever the clients do: within a second.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  const Access& access() const { return access_; }

  /// What a browser is to open: with the token.
  std::string page_url() const { return access_.url() + "/?token=" + access_.token; }

 private:
  struct Http;

  Access access_;
  std::unique_ptr<Http> http_;
};

}  // namespace cleancolor
