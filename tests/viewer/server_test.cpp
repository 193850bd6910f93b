// Who is let in, what is refused, and what slow clients come to: over the network of this machine.
#include "viewer/server.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "served.hpp"

namespace cleancolor {
namespace {

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
  SlowClient(const Server& server, const std::string& first) : socket_(connected_socket(server.access().port)) {
    const int small = 4096;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
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
  EXPECT_LT(std::chrono::steady_clock::now() - since, std::chrono::seconds(8));  // not their patience of 10 s
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

}  // namespace
}  // namespace cleancolor
