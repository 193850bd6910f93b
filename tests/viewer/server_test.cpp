// The server end to end, over the network of this machine.
#include "viewer/server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "../audit/drawn.hpp"
#include "array_reader.hpp"
#include "audit/report.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

using nlohmann::json;

std::string small_gcode() {
  Drawing d(drawn_machine({{0, 0}, {10, 0}}));
  for (int layer = 0; layer < 4; ++layer) {
    d.layer(layer).tool(0).wall().road({20, 20}, {40, 20});
    d.tool(1).wall().road({20, 30}, {40, 30}).dwell(20);
  }
  return d.text();
}

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
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(std::uint16_t(server_.access().port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 &&
        ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == ssize_t(bytes.size())) {
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

using ViewerAccess = Served;

TEST_F(ViewerAccess, IsForThoseWhoKnowTheToken) {
  httplib::Client stranger("127.0.0.1", server_.access().port);
  for (const char* path : {"/", "/?token=", "/?token=0123", "/api/prints", "/api/options", "/assets/x.js"}) {
    const auto result = stranger.Get(path);
    ASSERT_TRUE(result) << path;
    EXPECT_EQ(result->status, 401) << path;
  }
  EXPECT_EQ(stranger.Post("/api/prints", "G1", "text/plain")->status, 401);
  EXPECT_EQ(stranger.Get(("/api/prints?token=" + server_.access().token).c_str())->status, 401);
  EXPECT_EQ(get("/api/prints"), json::array());
}

TEST_F(ViewerAccess, ThePageGivesACookieThatLetsIn) {
  httplib::Client browser("127.0.0.1", server_.access().port);
  const auto page = browser.Get(("/?token=" + server_.access().token).c_str());
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  const std::string cookie = page->get_header_value("Set-Cookie");
  EXPECT_NE(cookie.find("HttpOnly"), cookie.npos);
  EXPECT_NE(cookie.find("SameSite=Strict"), cookie.npos);
  const httplib::Headers with_cookie = {{"Cookie", cookie.substr(0, cookie.find(';'))}};
  EXPECT_EQ(browser.Get("/api/prints", with_cookie)->status, 200);
  EXPECT_EQ(browser.Get("/", with_cookie)->status, 200);
}

TEST_F(ViewerAccess, IsByItsOwnNameOnly) {
  for (const char* host : {"evil.example", "127.0.0.1:1", "evil.example:80"})
    EXPECT_EQ(
        client_.Get("/api/prints", {{"Host", host}, {"Authorization", "Bearer " + server_.access().token}})->status,
        403);
  EXPECT_EQ(client_.Get("/api/prints", {{"Origin", "http://127.0.0.1:1"}})->status, 403);
  EXPECT_EQ(client_.Get("/api/prints", {{"Origin", server_.access().url()}})->status, 200);
  EXPECT_NE(raw("GET /api/prints HTTP/1.0\r\n\r\n").find(" 403 "), std::string::npos);
}

TEST_F(ViewerAccess, AnswersCarryWhatKeepsBrowsersSafe) {
  for (const char* path : {"/", "/api/prints", "/nothing"}) {
    const auto result = client_.Get(path);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->get_header_value("X-Content-Type-Options"), "nosniff") << path;
    EXPECT_EQ(result->get_header_value("Content-Security-Policy").substr(0, 18), "default-src 'self'") << path;
  }
}

TEST_F(ViewerAccess, LeadsToNoOtherFiles) {
  for (const char* target :
       {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd", "/etc/passwd",
        "/index.html/../../../etc/passwd", "/./../etc/passwd", "/%00/etc/passwd", "/api/prints/../../etc/passwd",
        "/api/prints/1/../../../etc/passwd", "/..\\..\\etc\\passwd", "file:///etc/passwd", "/index.html%00.js"}) {
    const std::string answer = raw_get(target);
    EXPECT_EQ(answer.find("root:"), answer.npos) << target;
    EXPECT_TRUE(answer.find(" 404 ") != answer.npos || answer.find(" 400 ") != answer.npos)
        << target << " -> " << answer;
  }
}

TEST_F(ViewerAccess, SurvivesWhatIsNoHttp) {
  for (const std::string& bytes : {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"),
                                   std::string("NONSENSE / HTTP/1.1\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
                                   std::string(100, '\0'), "GET /" + std::string(20000, 'a') + " HTTP/1.1\r\n\r\n",
                                   "GET / HTTP/1.1\r\nX: " + std::string(20000, 'a') + "\r\n\r\n",
                                   std::string("POST /api/jobs HTTP/1.1\r\nContent-Length: -5\r\n\r\n{}")})
    (void)raw(bytes, /*ends=*/true);
  EXPECT_EQ(raw_get("/" + std::string(20000, 'a')).find(" 200 "), std::string::npos);
  EXPECT_EQ(get("/api/prints"), json::array());
}

TEST_F(ViewerAccess, LogsWhatItRefusesWithoutTheToken) {
  get("/api/nothing", 404);
  (void)client_.Get(("/api/nothing?token=" + server_.access().token).c_str());
  for (int i = 0; i < 1000 && log().size() < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const std::vector<std::string> lines = log();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "GET /api/nothing from 127.0.0.1: refused with 404");
  EXPECT_EQ(lines[1].find(server_.access().token), std::string::npos);
}

TEST_F(ViewerAccess, AnswersAndLogsEachRefusal) {
  const std::string port = std::to_string(server_.access().port), token = server_.access().token,
                    host = "Host: 127.0.0.1:" + port + "\r\n", bearer = "Authorization: Bearer " + token + "\r\n";
  const auto length = [](std::size_t n) { return "Content-Length: " + std::to_string(n) + "\r\n"; };
  const struct {
    std::string request;
    int status;
    std::string line;
  } table[] = {
      {"GET /api/prints HTTP/1.1\r\n" + host, 401, "GET /api/prints from 127.0.0.1: refused with 401"},
      {"GET /api/prints HTTP/1.1\r\n" + host + "Authorization: Bearer 0123\r\n", 401,
       "GET /api/prints from 127.0.0.1: refused with 401"},
      {"GET /?token=" + std::string(32, '0') + " HTTP/1.1\r\n" + host, 401, "GET / from 127.0.0.1: refused with 401"},
      {"GET / HTTP/1.1\r\nHost: evil.example:" + port + "\r\n" + bearer, 403, "GET / from 127.0.0.1: refused with 403"},
      {"GET / HTTP/1.1\r\n" + host + bearer + "Origin: http://evil.example\r\n", 403,
       "GET / from 127.0.0.1: refused with 403"},
      {"GET /../../etc/passwd HTTP/1.1\r\n" + host + bearer, 404,
       "GET /../../etc/passwd from 127.0.0.1: refused with 404"},
      {"GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\n" + host + bearer, 404,
       "GET /../../etc/passwd from 127.0.0.1: refused with 404"},
      {"GET /a%0ab%1b HTTP/1.1\r\n" + host + bearer, 404, "GET /a?b? from 127.0.0.1: refused with 404"},
      {"DELETE /api/options HTTP/1.1\r\n" + host + bearer, 405, "DELETE /api/options from 127.0.0.1: refused with 405"},
      {"POST /api/jobs HTTP/1.1\r\n" + host + bearer + length(3000), 413,
       "POST /api/jobs from 127.0.0.1: refused with 413"},
      {"POST /api/jobs HTTP/1.1\r\n" + host + bearer + length(3000) +
           "Content-Type: multipart/form-data; boundary=x\r\n",
       415, "POST /api/jobs from 127.0.0.1: refused with 415"},
      {"GET\r\n", 400, "GET: refused with 400"},
      {"NONSENSE / HTTP/1.1\r\n" + host, 400, "NONSENSE: refused with 400"},
      {"GET / HTTP/1.1\r\n" + host + bearer + "Range: bytes=5-2\r\n", 416, "GET / from 127.0.0.1: refused with 416"},
  };
  std::size_t lines = 0;
  for (const auto& row : table) {
    SCOPED_TRACE(row.request);
    const bool body = row.request.starts_with("POST");
    const std::string answer = raw(row.request + "\r\n" + (body ? std::string(3000, ' ') : ""), /*ends=*/true);
    EXPECT_NE(answer.find("HTTP/1.1 " + std::to_string(row.status) + " "), answer.npos) << answer;
    EXPECT_NE(answer.find(R"({"error":{"message":)"), answer.npos) << answer;
    ++lines;
    for (int i = 0; i < 1000 && log().size() < lines; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_EQ(log().size(), lines);
    EXPECT_EQ(log().back(), row.line);
  }
}

TEST_F(ViewerAccess, HeedsNoRanges) {
  const std::string options = client_.Get("/api/options")->body;
  post("/api/prints?name=small.gcode", small_gcode());
  httplib::Client stranger("127.0.0.1", server_.access().port);
  const std::string refused = stranger.Get("/api/options")->body;
  EXPECT_EQ(client_.Head("/api/prints/1/gcode")->get_header_value("Accept-Ranges"), "none");
  for (const char* range : {"bytes=0-0", "bytes=100-", "bytes=-5", "bytes=100000000-100000100", "bytes=0-99999999999",
                            "bytes=-99999999999", "bytes=0-0,100000000-100000100", "bytes=0-1,2-3,-1"}) {
    SCOPED_TRACE(range);
    const httplib::Headers own = {{"Range", range}, {"Authorization", "Bearer " + server_.access().token}};
    const auto table = client_.Get("/api/options", own);
    EXPECT_EQ(table->status, 200);
    EXPECT_EQ(table->body, options);
    const auto file = client_.Get("/api/prints/1/gcode", own);
    EXPECT_EQ(file->status, 200);
    EXPECT_EQ(file->body, small_gcode());
    const auto nobody = stranger.Get("/api/options", {{"Range", range}});
    EXPECT_EQ(nobody->status, 401);
    EXPECT_EQ(nobody->body, refused);
  }
}

TEST(ViewerPort, IsAnotherOneWhereTheUsualOneIsTaken) {
  Api api({});
  const Server first(api, {.port = 0});
  const int port = first.access().port;
  EXPECT_ERROR(Server(api, {.port = port}), "is it taken?");
  EXPECT_ERROR(Server(api, {.address = "203.0.113.1", .port = 0}), "cannot listen");
}

/// A client that does as little as it can.
class SlowClient {
 public:
  SlowClient(const Server& server, const std::string& first) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const int small = 4096;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(std::uint16_t(server.access().port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    EXPECT_TRUE(say(first));
  }
  ~SlowClient() { ::close(socket_); }
  SlowClient(const SlowClient&) = delete;
  SlowClient& operator=(const SlowClient&) = delete;

  bool say(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == ssize_t(bytes.size());
  }

 private:
  int socket_;
};

std::string head(const Server& server, const std::string& request) {
  return request + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.access().port) +
         "\r\nAuthorization: Bearer " + server.access().token + "\r\n";
}

TEST(ViewerClients, KeepNoServerFromStopping) {
  const TempFolder folder;
  const std::filesystem::path large = folder.path() / "large.gcode";
  std::ofstream(large) << std::string(30'000'000, ';');
  Api api({});
  api.add_print(large);
  auto server = std::make_unique<Server>(api, ServerOptions{.port = 0});
  const SlowClient silent(*server, ""), half_a_head(*server, "GET /api/pri"),
      half_a_body(*server, head(*server, "POST /api/jobs") + "Content-Length: 1000\r\n\r\n{"),
      takes_nothing(*server, head(*server, "GET /api/prints/1/gcode") + "\r\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto since = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - since, std::chrono::seconds(3));
}

TEST(ViewerClients, AreCutOffWhereTheyTrickle) {
  Api api({});
  const Server server(api, {.port = 0, .patience_s = 0.5});
  const SlowClient in_the_head(server, head(server, "GET /api/prints") + "X: "),
      in_the_body(server, head(server, "POST /api/jobs") + "Content-Length: 100000\r\n\r\n");
  const auto since = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - since < std::chrono::seconds(2)) {
    (void)in_the_head.say("x");
    (void)in_the_body.say(" ");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  httplib::Client other("127.0.0.1", server.access().port);
  EXPECT_EQ(other.Get("/api/prints")->status, 401);
  EXPECT_FALSE(in_the_head.say("x") && in_the_head.say("x"));
  EXPECT_FALSE(in_the_body.say(" ") && in_the_body.say(" "));
}

using ViewerPrints = Served;

TEST_F(ViewerPrints, AreDrawnThenAudited) {
  const int id = post("/api/prints?name=small.gcode", small_gcode()).at("id");
  const std::string path = "/api/prints/" + std::to_string(id);
  const json print = until(path, {"audited", "failed"});
  EXPECT_EQ(print.at("state"), "audited") << print;
  EXPECT_EQ(print.at("name"), "small.gcode");
  EXPECT_EQ(get("/api/prints"), json::parse(R"([{"id": 1, "name": "small.gcode", "state": "audited"}])"));

  const json audit = get(path + "/audit.json");
  EXPECT_EQ(audit.at("name"), "small.gcode");
  const json& summary = print.at("summary");
  EXPECT_EQ(summary.at("layers"), audit.at("print").at("layers"));
  EXPECT_EQ(summary.at("tool_changes"), audit.at("print").at("tool_changes"));
  const ArrayReader moves(client_.Get((path + "/moves").c_str())->body);
  EXPECT_EQ(moves.array<float>("position", 3).size(), 3 * summary.at("moves").get<std::size_t>());
  EXPECT_EQ(moves.array<std::uint32_t>("tool_change_move").size(), summary.at("tool_changes"));
  EXPECT_EQ(moves.array<float>("layer_z").size(), summary.at("layers"));
  const ArrayReader places(client_.Get((path + "/audit").c_str())->body);
  const json& worst = audit.at("scenarios").at("worst");
  EXPECT_EQ(places.header().at("worst").size(), worst.at("places").size());
  EXPECT_NEAR(places.header().at("figures").at("hole_volume").get<double>(),
              worst.at("figures").at("hole_volume").get<double>(), 1e-3);

  const auto file = client_.Get((path + "/gcode").c_str());
  EXPECT_EQ(file->body, small_gcode());
  EXPECT_NE(file->get_header_value("Content-Disposition").find("filename=\"small.gcode\""), std::string::npos);
  remove(path);
  get(path, 404);
  EXPECT_EQ(get("/api/prints"), json::array());
}

TEST_F(ViewerPrints, SayWhereTheFileIsGone) {
  post("/api/prints?name=small.gcode", small_gcode());
  until("/api/prints/1", {"audited"});
  for (const auto& entry : std::filesystem::recursive_directory_iterator(api_.temporary()))
    if (entry.is_regular_file()) std::filesystem::remove(entry.path());
  EXPECT_EQ(get("/api/prints/1/gcode", 404).at("error").at("message"), "the file is gone");
}

TEST_F(ViewerPrints, SayWhyTheyFail) {
  post("/api/prints?name=bad.gcode", "G1 X1 Y\xff\n");
  const json bad = until("/api/prints/1", {"failed"});
  EXPECT_EQ(bad.at("error").get<std::string>().substr(0, 9), "bad.gcode");
  get("/api/prints/1/moves", 409);
  get("/api/prints/1/audit", 409);
}

TEST_F(ViewerPrints, TakeTheNozzlesFromTheQuery) {
  post("/api/prints?name=a.gcode&nozzle_offset=0x0,12x0&idle_nozzle=lifted", small_gcode());
  const json print = until("/api/prints/1", {"audited", "failed"});
  EXPECT_EQ(print.at("summary").at("nozzles").at(1).at("offset_mm"), json({12, 0}));
  EXPECT_EQ(print.at("summary").at("idle_nozzle"), "lifted");
  EXPECT_EQ(post("/api/prints?nozzle_offset=far", "G1", 400).at("error").at("field"), "nozzle_offset");
  EXPECT_EQ(post("/api/prints?printer=/etc/passwd", "G1", 400).at("error").at("field"), "printer");
}

TEST_F(ViewerPrints, CheckTheQueryBeforeTheUpload) {
  const std::string answer =
      raw(head(server_, "POST /api/prints?nozzle_offset=far") + "Content-Length: 90000\r\n\r\nG1");
  EXPECT_NE(answer.find(" 400 "), answer.npos) << answer;
  EXPECT_NE(answer.find("nozzle_offset"), answer.npos) << answer;
}

TEST(ViewerStore, TakesNoFurtherPrintWhereMuchIsKept) {
  Api api({.threads = 2, .most_kept_bytes = 1000});
  const TempFolder folder;
  std::ofstream(folder.path() / "a.gcode") << small_gcode();
  api.add_print(folder.path() / "a.gcode");
  const auto state = [&] {
    return json::parse(*api.answer({.method = "GET", .path = "/api/prints/1"}).body).at("state").get<std::string>();
  };
  for (int i = 0; i < 6000 && state() != "audited"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_ERROR(api.new_upload({.method = "POST", .path = "/api/prints"}), "forget a print first");
  EXPECT_EQ(api.answer({.method = "DELETE", .path = "/api/prints/1"}).status, 200);
  EXPECT_TRUE(api.new_upload({.method = "POST", .path = "/api/prints"}));
}

TEST(ViewerStore, JudgesAllThatWereAddedAtOnce) {
  Api api({.threads = 2});
  const TempFolder folder;
  std::ofstream(folder.path() / "a.gcode") << small_gcode();
  constexpr int count = 20;
  for (int i = 0; i < count; ++i) api.add_print(folder.path() / "a.gcode");
  EXPECT_EQ(api.answer({.method = "DELETE", .path = "/api/prints/7"}).status, 200);
  const auto audited = [&] {
    const json all = json::parse(*api.answer({.method = "GET", .path = "/api/prints"}).body);
    const auto drawn = std::ranges::count_if(all, [](const json& p) { return p.at("state") == "drawn"; });
    EXPECT_LE(drawn, PrintStore::most_unjudged);
    return std::ranges::count_if(all, [](const json& p) { return p.at("state") == "audited"; });
  };
  for (int i = 0; i < 12000 && audited() < count - 1; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(audited(), count - 1);
}

TEST_F(ViewerPrints, RefuseWhatIsTooLarge) {
  const json error = post("/api/prints?name=big.gcode", std::string(150'000, ';'), 413);
  EXPECT_EQ(error.at("error").at("message"), "too large: at most 100000 bytes are taken");
  post("/api/jobs", std::string(3'000, ' '), 413);
  EXPECT_EQ(get("/api/prints"), json::array());
  std::size_t left = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(api_.temporary()))
    left += entry.is_regular_file();
  EXPECT_EQ(left, 0u);
  // Also where the length is not told, or a lie.
  const std::string head = " /api/jobs HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.access().port) +
                           "\r\nAuthorization: Bearer " + server_.access().token + "\r\n";
  EXPECT_NE(raw("POST" + head + "Transfer-Encoding: chunked\r\n\r\nbb9\r\n" + std::string(3001, ' ') + "\r\n0\r\n\r\n")
                .find(" 413 "),
            std::string::npos);
  (void)raw("POST" + head + "Content-Length: 100\r\n\r\n" + job(1), /*ends=*/true);
  EXPECT_EQ(get("/api/jobs"), json::array());
}

TEST_F(ViewerPrints, RefuseFormsWrongMethodsAndUnknownAddresses) {
  const auto form =
      client_.Post("/api/prints", httplib::MultipartFormDataItems{{"file", "G1", "a.gcode", "text/plain"}});
  EXPECT_EQ(form->status, 415);
  const auto put = client_.Put("/api/prints", "G1", "text/plain");
  EXPECT_EQ(put->status, 405);
  EXPECT_EQ(put->get_header_value("Allow"), "GET, POST");
  EXPECT_EQ(client_.Post("/api/options", "", "text/plain")->status, 405);
  EXPECT_EQ(client_.Delete("/index.html")->status, 405);
  for (const char* path :
       {"/api", "/api/", "/api/print", "/api/prints/", "/api/prints/0", "/api/prints/-1", "/api/prints/1x",
        "/api/prints/99999999999999999999", "/api/prints/1/moves/x", "/api/jobs/1"})
    get(path, 404);
  EXPECT_EQ(client_.Head("/api/options")->status, 200);
}

using ViewerJobs = Served;

TEST_F(ViewerJobs, SliceWhatWasUploaded) {
  const int white = model("4-cones_white.stl"), black = model("4-cones_black.stl");
  EXPECT_EQ(get("/api/meshes").size(), 2u);
  const std::string body = json{
      {"meshes", {{{"id", white}, {"extruder", 0}}, {{"id", black}, {"extruder", 1}}}},
      {"printer", "replicator-dual"},
      {"settings",
       {{"effort", "fast"}}}}.dump();
  EXPECT_EQ(post("/api/jobs", body).at("id"), 1);
  remove("/api/meshes/" + std::to_string(white));  // the job keeps what it needs
  const json job = until("/api/jobs/1", {"done", "failed"});
  ASSERT_EQ(job.at("state"), "done") << job;
  EXPECT_GT(job.at("summary").at("layers"), 10);
  const std::string path = "/api/prints/" + job.at("print").dump();
  const json print = until(path, {"audited", "failed"});
  ASSERT_EQ(print.at("state"), "audited") << print;
  EXPECT_EQ(print.at("name"), "4-cones_white.gcode");
  EXPECT_EQ(print.at("summary").at("layers"), job.at("summary").at("layers"));
  EXPECT_EQ(print.at("summary").at("tool_changes"), job.at("summary").at("tool_changes"));
  EXPECT_EQ(print.at("summary").at("azimuth").at("exposure_s").size(), 360u);
  EXPECT_EQ(print.at("summary").at("azimuth").at("candidates_deg").size(), 360u);
  EXPECT_NE(client_.Get((path + "/gcode").c_str())->body.find("cleancolor"), std::string::npos);
  remove("/api/jobs/1");
  get("/api/jobs/1", 404);
}

TEST_F(ViewerJobs, WaitForEachOtherAndCanBeCancelled) {
  const int mesh = model("two-color-world-50mm_ocean.stl");
  const std::string slow = job(mesh, R"({"layer_height": "0.05", "first_layer_height": "0.05"})");
  for (int id = 1; id <= 3; ++id) EXPECT_EQ(post("/api/jobs", slow).at("id"), id);
  until("/api/jobs/1", {"running"});
  EXPECT_EQ(get("/api/jobs/2").at("state"), "queued");
  EXPECT_EQ(get("/api/jobs/2").at("position"), 1);
  EXPECT_EQ(get("/api/jobs/3").at("position"), 2);
  remove("/api/jobs/2");
  EXPECT_EQ(get("/api/jobs/2").at("state"), "cancelled");
  EXPECT_EQ(get("/api/jobs/3").at("position"), 1);
  remove("/api/jobs/1");
  EXPECT_EQ(until("/api/jobs/1", {"cancelled", "done", "failed"}).at("state"), "cancelled");
  until("/api/jobs/3", {"running"});
  remove("/api/jobs/3");
  until("/api/jobs/3", {"cancelled"});
  EXPECT_EQ(get("/api/prints"), json::array());
  EXPECT_EQ(get("/api/jobs").size(), 3u);
}

TEST_F(ViewerJobs, AreRefusedWhereTooManyWait) {
  const int mesh = model("two-color-world-50mm_ocean.stl");
  const std::string slow = job(mesh, R"({"layer_height": "0.05", "first_layer_height": "0.05"})");
  post("/api/jobs", slow);
  until("/api/jobs/1", {"running"});
  for (std::size_t i = 0; i < JobQueue::most_waiting; ++i) post("/api/jobs", slow);
  post("/api/jobs", slow, 503);
}

TEST_F(ViewerJobs, AreRefusedWhereTheirPrintWouldFindNoRoom) {
  const int mesh = model("two-color-world-50mm_ocean.stl");
  const std::string slow = job(mesh, R"({"layer_height": "0.05", "first_layer_height": "0.05"})");
  for (std::size_t i = 0; i < PrintStore::most_prints; ++i) post("/api/prints", "G1 X1 Y\xff\n");
  EXPECT_NE(post("/api/jobs", slow, 503).at("error").at("message").get<std::string>().find("forget a print first"),
            std::string::npos);
  remove("/api/prints/1");
  post("/api/jobs", slow);
  post("/api/jobs", slow, 503);
  post("/api/prints", "G1", 503);  // the place is the job's
  remove("/api/jobs/1");
  until("/api/jobs/1", {"cancelled"});
  post("/api/prints", "G1");
}

TEST_F(ViewerJobs, LeaveNothingWhereTheyAreCancelledAgainAndAgain) {
  const int mesh = model("two-color-world-50mm_ocean.stl");
  const std::string slow = job(mesh, R"({"layer_height": "0.05", "first_layer_height": "0.05"})");
  post("/api/jobs", slow);
  until("/api/jobs/1", {"running"});
  for (int i = 0; i < 200; ++i) remove("/api/jobs/" + post("/api/jobs", slow).at("id").dump());
  EXPECT_EQ(get("/api/jobs").size(), 1 + JobQueue::most_ended);
  const std::filesystem::directory_iterator folders(api_.temporary());
  EXPECT_LE(std::distance(begin(folders), end(folders)), 2);  // of the mesh, and of the job that runs
}

TEST_F(ViewerJobs, AreDoneOrCancelledButNeverBoth) {
  const int mesh = model("4-cones_white.stl");
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const std::string path = "/api/jobs/" + post("/api/jobs", job(mesh, R"({"layer_height": "0.3"})")).at("id").dump();
    std::this_thread::sleep_for(std::chrono::milliseconds(40 * i));
    const std::size_t before = get("/api/prints").size();
    remove(path);
    const auto left = client_.Get(path.c_str());
    if (left->status == 404) continue;  // it was done, and has been forgotten
    EXPECT_EQ(until(path, {"done", "failed", "cancelled"}).at("state"), "cancelled");
    EXPECT_EQ(get("/api/prints").size(), before);
  }
}

TEST_F(ViewerJobs, FindWhatProtectionStandsFor) {
  json levels = json::object();
  for (const json& profile : get("/api/profiles"))
    if (profile.at("group") == "protection") levels[profile.at("name").get<std::string>()] = profile;
  EXPECT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels.at("none").at("settings"), json({{"planner", "plain"}, {"rampart", "off"}}));
  EXPECT_EQ(levels.at("none").at("turns"), false);
  EXPECT_EQ(levels.at("rampart").at("settings"), json({{"planner", "plain"}}));
  EXPECT_EQ(levels.at("full").at("settings"), json::object());
  EXPECT_EQ(levels.at("full").at("turns"), true);
}

TEST_F(ViewerJobs, SayWhichFieldIsAtFault) {
  const int mesh = model("4-cones_white.stl");
  EXPECT_EQ(post("/api/jobs", job(mesh, R"({"layer_height": "9"})"), 400).at("error").at("field"), "layer_height");
  EXPECT_EQ(post("/api/jobs", job(mesh + 1), 400).at("error").at("field"), "meshes");
  EXPECT_FALSE(post("/api/jobs", "{", 400).at("error").contains("field"));
}

TEST_F(ViewerJobs, FailWithTheReasonWhereTheMeshIsNone) {
  const int mesh = post("/api/meshes?name=broken.stl", "solid nothing").at("id");
  post("/api/jobs", job(mesh));
  const json failed = until("/api/jobs/1", {"failed", "done"});
  EXPECT_EQ(failed.at("error").get<std::string>().substr(0, 10), "broken.stl") << failed;
}

}  // namespace
}  // namespace cleancolor
