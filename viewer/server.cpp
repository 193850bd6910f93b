#include "viewer/server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <thread>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "viewer/api_error.hpp"
#include "viewer/connection.hpp"
#include "viewer/page.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t bytes_per_piece = 1 << 18;
constexpr std::uint64_t patience = 4;  // a body beyond its limit is read on up to so many times it, or nobody reads why

/// Nothing from elsewhere, no frames around it, no guessing of types, nothing told to others.
const httplib::Headers safe_headers = {
    {"Content-Security-Policy",
     "default-src 'self'; img-src 'self' data: blob:; worker-src 'self' blob:; object-src 'none'; base-uri 'none'; "
     "form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Accept-Ranges", "none"},
    {"Cache-Control", "no-store"}};

Headers headers_of(const httplib::Request& request) {
  return {.host = request.get_header_value("Host"),
          .origin = request.get_header_value("Origin"),
          .cookie = request.get_header_value("Cookie"),
          .authorization = request.get_header_value("Authorization")};
}

/// In pieces, and without compression, which takes longer than the way to the browser.
void send_bytes(httplib::Response& response, const std::string& type, std::string_view bytes, const Bytes& holder) {
  if (bytes.empty()) return response.set_content("", type);
  response.set_content_provider(
      bytes.size(), type, [bytes, holder](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        if (offset >= bytes.size()) return false;
        const std::string_view piece = bytes.substr(offset, std::min(length, bytes_per_piece));
        sink.write(piece.data(), piece.size());
        return true;
      });
}

/// name="..." of a download: plain letters for old readers, all of them for new ones.
std::string disposition(const std::string& name) {
  std::string plain, escaped;
  for (const char c : name) {
    const bool letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
    plain += letter ? c : '_';
    escaped += letter ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return fmt::format("attachment; filename=\"{}\"; filename*=UTF-8''{}", plain, escaped);
}

void send(httplib::Response& response, const Answer& answer);

void send_file(httplib::Response& response, const Answer& answer) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(answer.file->path(), fault);
  const auto in = std::make_shared<std::ifstream>(answer.file->path(), std::ios::binary);
  if (fault || !*in) return send(response, refusal(404, "the file is gone"));
  response.set_header("Content-Disposition", disposition(answer.file_name));
  if (size == 0) return response.set_content("", answer.type);
  response.set_content_provider(
      size, answer.type,
      [in, size, holder = answer.file](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        if (offset >= size) return false;
        std::string piece(std::min({length, std::size_t(size) - offset, bytes_per_piece}), '\0');
        in->seekg(std::streamoff(offset));
        if (!in->read(piece.data(), std::streamsize(piece.size()))) return false;
        sink.write(piece.data(), piece.size());
        return true;
      });
}

void send(httplib::Response& response, const Answer& answer) {
  if (answer.status != 200) response.status = answer.status;
  if (!answer.allow.empty()) response.set_header("Allow", answer.allow);
  if (answer.file) return send_file(response, answer);
  if (answer.status != 200) return response.set_content(*answer.body, answer.type);
  if (answer.body) return send_bytes(response, answer.type, *answer.body, answer.body);
  response.headers.erase("Cache-Control");
  response.set_header("Cache-Control", "no-cache");
  send_bytes(response, answer.type, answer.page, nullptr);
}

Asked asked_of(const httplib::Request& request) {
  return {.method = request.method, .path = request.path, .query = {request.params.begin(), request.params.end()}};
}

/// Where a body goes while it is received.
class Receiver {
 public:
  Receiver(const BodyRule& rule, FileHandle file) : rule_(rule), file_(std::move(file)) {
    if (file_) out_.open(file_->path(), std::ios::binary);
  }

  /// Returns whether to read on.
  bool take(const char* bytes, std::size_t count) {
    received_ += count;
    if (received_ > rule_.most_bytes) return received_ <= patience * rule_.most_bytes;
    if (file_)
      out_.write(bytes, std::streamsize(count));
    else
      text_.append(bytes, count);
    return true;
  }

  bool too_large() const { return received_ > rule_.most_bytes; }

  /// Throws SystemError where it was not all kept.
  void finish(Asked& asked) {
    if (file_) {
      out_.close();
      if (!out_) throw SystemError("the upload cannot be kept: is the disc full?");
    }
    asked.body = std::move(text_);
    asked.upload = file_;
  }

 private:
  BodyRule rule_;
  FileHandle file_;
  std::ofstream out_;
  std::string text_;
  std::uint64_t received_ = 0;
};

/// The library's server, but with connections of which none lasts for ever.
class HttpServer : public httplib::Server {
 public:
  explicit HttpServer(double patience_s) : patience_s_(patience_s) {}

  /// Cuts off who is still being served.
  void stop_soon() {
    stopping_ = true;
    stop();
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, patience_s_, stopping_);
    bool closed = false;
    const bool done = process_request(connection, /*close_connection=*/true, closed, nullptr);
    connection.close();
    return done;
  }

  double patience_s_;
  std::atomic<bool> stopping_ = false;
};

}  // namespace

struct Server::Http {
  Http(Api& api_, const Access& access_, const ServerOptions& options)
      : api(api_), access(access_), refused(options.refused), server(options.patience_s) {}

  Api& api;
  const Access& access;
  std::function<void(const std::string&)> refused;
  std::mutex log_mutex;
  HttpServer server;
  std::thread listening;

  void prepare();
  void listen(const ServerOptions& options, Access& access_to_fill);

  bool refuses(const httplib::Request& request, httplib::Response& response);
  httplib::Server::HandlerResponse before(const httplib::Request& request, httplib::Response& response);
  void receive(const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& read);
  void log(const httplib::Request& request, const httplib::Response& response);
};

void Server::Http::prepare() {
  server.set_tcp_nodelay(true);
  server.set_default_headers(safe_headers);
  // The library would share the port with another server that has it already.
  server.set_socket_options([](socket_t socket) {
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
  server.set_pre_routing_handler([this](const auto& request, auto& response) { return before(request, response); });
  server.Post("/api/(prints|meshes|jobs|profiles)",
              [this](const auto& request, auto& response, const auto& read) { receive(request, response, read); });
  // What the library itself refuses: lines that are no HTTP, headers that are too long.
  server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (!response.body.empty() || response.content_length_ > 0) return;
    response.set_content(*refusal(response.status, "the request is malformed").body, "application/json");
  });
  server.set_exception_handler([](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
    send(response, refusal(500, "something went wrong"));
  });
  server.set_logger([this](const auto& request, const auto& response) { log(request, response); });
}

void Server::Http::listen(const ServerOptions& options, Access& access_to_fill) {
  const int wished = options.port.value_or(ServerOptions::usual_port);
  int port = wished;
  if (wished == 0 || !server.bind_to_port(options.address, wished)) {
    if (options.port && wished != 0)
      throw SystemError(fmt::format("port {} of {} cannot be used; is it taken?", wished, options.address));
    port = server.bind_to_any_port(options.address);
    if (port <= 0) throw SystemError(fmt::format("{}: cannot listen at this address", options.address));
  }
  access_to_fill.port = port;
  listening = std::thread([this] { server.listen_after_bind(); });
  while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Who may not ask is told why.
bool Server::Http::refuses(const httplib::Request& request, httplib::Response& response) {
  const Headers headers = headers_of(request);
  if (!access.is_host(headers.host)) {
    send(response, refusal(403, "this server has another name; open the address that the program printed"));
    return true;
  }
  if (!access.is_origin(headers)) {
    send(response, refusal(403, "another site may not ask"));
    return true;
  }
  const bool page = request.path == "/" && (request.method == "GET" || request.method == "HEAD");
  if (page && same_secret(request.get_param_value("token"), access.token)) {
    response.set_header("Set-Cookie",
                        fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", access.cookie_name(), access.token));
    return false;
  }
  if (access.knows_token(headers)) return false;
  send(response, refusal(401, "no token, or a wrong one; open the address that the program printed"));
  return true;
}

httplib::Server::HandlerResponse Server::Http::before(const httplib::Request& request, httplib::Response& response) {
  using enum httplib::Server::HandlerResponse;
  // The library checks no range against what there is: none is heeded, so everybody gets the whole.
  const_cast<httplib::Request&>(request).ranges.clear();
  if (refuses(request, response)) return Handled;
  if (api.body_rule(request.method, request.path)) return Unhandled;  // receive() goes on with it
  send(response, api.answer(asked_of(request)));
  return Handled;
}

void Server::Http::receive(const httplib::Request& request, httplib::Response& response,
                           const httplib::ContentReader& read) {
  const auto rule = api.body_rule(request.method, request.path);
  if (!rule) return send(response, refusal(404, "there is no such address"));
  if (request.is_multipart_form_data())
    return send(response, refusal(415, "the body is the file itself, not a form with it"));
  Asked asked = asked_of(request);
  try {
    Receiver receiver(*rule, rule->upload ? api.new_upload(asked) : nullptr);
    const bool whole = read([&](const char* bytes, std::size_t count) { return receiver.take(bytes, count); });
    if (receiver.too_large())
      return send(response, refusal(413, fmt::format("too large: at most {} bytes are taken", rule->most_bytes)));
    if (!whole) return send(response, refusal(response.status >= 400 ? response.status : 400, "the body is cut short"));
    receiver.finish(asked);
  } catch (const ApiError& e) {
    return send(response, refusal(e.status(), e.what(), e.field()));
  } catch (const Error& e) {
    return send(response, refusal(500, e.what()));
  }
  send(response, api.answer(asked));
}

void Server::Http::log(const httplib::Request& request, const httplib::Response& response) {
  if (response.status < 400) return;
  // Of what is no HTTP the library may know neither the path nor who sent it.
  std::string what = request.method.empty() ? "a request" : printable(request.method);
  if (!request.path.empty()) what += " " + printable(request.path);
  if (!request.remote_addr.empty()) what += " from " + request.remote_addr;
  const std::lock_guard lock(log_mutex);
  refused(fmt::format("{}: refused with {}", what, response.status));
}

Server::Server(Api& api, const ServerOptions& options)
    : access_{.token = random_token(), .address = options.address},
      http_(std::make_unique<Http>(api, access_, options)) {
  http_->prepare();
  http_->listen(options, access_);
}

Server::~Server() {
  http_->server.stop_soon();
  http_->listening.join();
}

}  // namespace cleancolor
