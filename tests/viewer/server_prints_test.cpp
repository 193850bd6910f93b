// Prints of the viewer over the network of this machine: uploaded, read, audited, forgotten.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "array_reader.hpp"
#include "audit/report.hpp"
#include "served.hpp"

namespace cleancolor {
namespace {

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
  const json listed = get("/api/prints");
  EXPECT_EQ(listed.at(0).at("state"), "failed");
  EXPECT_EQ(listed.at(0).at("error"), bad.at("error"));
  remove("/api/prints/1");
  EXPECT_EQ(get("/api/prints"), json::array());
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

}  // namespace
}  // namespace cleancolor
