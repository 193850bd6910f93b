// Slicing jobs of the viewer over the network of this machine.
#include <algorithm>

#include "served.hpp"

namespace cleancolor {
namespace {

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

TEST_F(ViewerJobs, TakePrintersThatWereSent) {
  const int mesh = model("4-cones_white.stl");
  const auto body = [&](const std::string& printer) {
    return json{{"meshes", {{{"id", mesh}}}}, {"printer", printer}, {"protect", "none"}}.dump();
  };
  EXPECT_EQ(post("/api/jobs", body("my.toml"), 400).at("error").at("field"), "printer");
  const std::string toml = "inherits = \"replicator-dual\"\nbed_shape = [[-99,-70],[99,-70],[99,70],[-99,70]]\n";
  EXPECT_EQ(post("/api/profiles?name=my.toml", toml).at("name"), "my.toml");
  EXPECT_EQ(post("/api/profiles?name=my.toml", toml).at("name"), "my.toml");  // in place of the one before
  const json own = get("/api/profiles").at(0);
  EXPECT_EQ(own.at("name"), "my.toml");
  EXPECT_EQ(own.at("extruders"), 2);
  EXPECT_NE(get("/api/profiles").at(1).at("name"), "my.toml");
  post("/api/jobs", body("my.toml"));
  const json job = until("/api/jobs/1", {"done", "failed"});
  ASSERT_EQ(job.at("state"), "done") << job;
  const json print = until("/api/prints/" + job.at("print").dump(), {"drawn", "audited", "failed"});
  EXPECT_EQ(print.at("summary").at("bed_mm").at(0), json({-99, -70}));
  EXPECT_TRUE(post("/api/prints?name=a.gcode&printer=my.toml", small_gcode()).contains("id"));
  remove("/api/profiles/my.toml");
  remove("/api/profiles/my.toml", 404);
  post("/api/jobs", body("my.toml"), 400);
}

TEST_F(ViewerJobs, SayWhatIsWrongWithAPrinterThatWasSent) {
  const json error = post("/api/profiles?name=my.toml", "nozle_diameter = 0.4\n", 400).at("error");
  EXPECT_EQ(error.at("field"), "printer");
  EXPECT_EQ(error.at("message").get<std::string>().substr(0, 31), "my.toml:1: there is no option '");
  EXPECT_EQ(post("/api/profiles?name=my.stl", "nozzle_diameter = 0.4\n", 400).at("error").at("field"), "printer");
  for (const json& profile : get("/api/profiles")) EXPECT_NE(profile.at("name"), "my.toml");
}

TEST_F(ViewerJobs, TakePrintersUpToALength) {
  std::string toml = "inherits = \"replicator-dual\"\nbed_shape = [[0,0],[99,0],[99,99]]\n";
  toml.append(64'000 - toml.size(), '#');
  EXPECT_EQ(post("/api/profiles?name=my.toml", toml).at("name"), "my.toml");
  post("/api/profiles?name=more.toml", toml + "#", 413);
  EXPECT_EQ(get("/api/profiles").at(0).at("name"), "my.toml");
  remove("/api/profiles/..%2fmy.toml", 404);
  remove("/api/profiles/%2e%2e/profiles/my.toml", 404);
  EXPECT_EQ(get("/api/profiles").at(0).at("sent"), true);
}

TEST_F(ViewerJobs, TellHowProfilesCanBeAskedFor) {
  const auto put = client_.Put("/api/profiles", "x", "text/plain");
  EXPECT_EQ(put->status, 405);
  EXPECT_EQ(put->get_header_value("Allow"), "GET, POST");
  const auto removed = client_.Delete("/api/profiles");
  EXPECT_EQ(removed->status, 405);
  EXPECT_EQ(removed->get_header_value("Allow"), "GET, POST");
  const auto one = client_.Get("/api/profiles/my.toml");
  EXPECT_EQ(one->status, 405);
  EXPECT_EQ(one->get_header_value("Allow"), "DELETE");
}

TEST_F(ViewerJobs, KeepPrintersFromWhoeverHasNoToken) {
  httplib::Client stranger("127.0.0.1", server_.access().port);
  for (const httplib::Headers& headers :
       {httplib::Headers{}, httplib::Headers{{"Authorization", "Bearer " + std::string(32, '0')}}}) {
    EXPECT_EQ(stranger.Get("/api/profiles", headers)->status, 401);
    EXPECT_EQ(stranger.Post("/api/profiles?name=my.toml", headers, "nozzle_diameter = 0.4\n", "text/plain")->status,
              401);
    EXPECT_EQ(stranger.Delete("/api/profiles/my.toml", headers)->status, 401);
  }
  EXPECT_EQ(get("/api/profiles").at(0).at("sent"), false);
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
