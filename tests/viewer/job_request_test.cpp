#include "viewer/job_request.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support_errors.hpp"
#include "viewer/api_error.hpp"
#include "viewer/option_json.hpp"

namespace cleancolor {
namespace {

/// "field: message" of the refusal; "accepted" where there is none.
std::string refused(const std::string& body) {
  try {
    (void)job_request(body, {});
  } catch (const ApiError& e) {
    EXPECT_EQ(e.status(), 400);
    return e.field() + ": " + e.what();
  }
  return "accepted";
}

TEST(JobRequest, BecomesWhatIsToBeSliced) {
  const JobRequest job = job_request(
      R"({"meshes": [{"id": 7, "extruder": 1}, {"id": 3}], "printer": "replicator-dual", "materials": ["pla", "petg"],
          "print": "fine", "settings": {"layer_height": "0.15", "perimeters": 4, "thin_walls": false}, "protect": "none"})",
      {});
  ASSERT_EQ(job.meshes.size(), 2u);
  EXPECT_EQ(job.meshes[0].id, 7);
  EXPECT_EQ(job.meshes[0].extruder, 1);
  EXPECT_EQ(job.meshes[1].extruder, std::nullopt);
  EXPECT_EQ(job.azimuth_deg, 0);
  EXPECT_EQ(job.config.layer_height_mm, 0.15);
  EXPECT_EQ(job.config.perimeters, 4);
  EXPECT_FALSE(job.config.thin_walls);
  EXPECT_EQ(job.config.extruders[1].filament_type, "PETG");
  EXPECT_EQ(job.config.rampart, RampartShape::off);
  EXPECT_EQ(job.config.planner, Planner::plain);
}

TEST(JobRequest, ProtectsWhereNothingElseIsSaid) {
  const JobRequest job = job_request(R"({"meshes": [{"id": 1}], "printer": "replicator-dual"})", {});
  EXPECT_EQ(job.azimuth_deg, std::nullopt);
  EXPECT_EQ(job.config.planner, Planner::clean);
}

TEST(JobRequest, TurnsAsTheAzimuthSaysWhateverTheProtection) {
  const auto turned_by = [](const std::string& more) {
    return job_request(R"({"meshes": [{"id": 1}], "printer": "replicator-dual", )" + more + "}", {}).azimuth_deg;
  };
  EXPECT_EQ(turned_by(R"("azimuth": "auto", "protect": "none")"), std::nullopt);
  EXPECT_EQ(turned_by(R"("azimuth": "off", "protect": "full")"), 0);
  EXPECT_EQ(turned_by(R"("azimuth": "-37.5")"), -37.5);
  EXPECT_EQ(turned_by(R"("azimuth": 90)"), 90);
  EXPECT_EQ(turned_by(R"("azimuth": null, "protect": "none")"), 0);
}

TEST(JobRequest, NamesTheFieldAtFault) {
  const auto with = [](const std::string& more) { return refused(R"({"meshes": [{"id": 1}], )" + more + "}"); };
  EXPECT_EQ(with(R"("printer": "replicator-dual")"), "accepted");
  EXPECT_EQ(with(R"("settings": {"layer_height": "thick"})").substr(0, 27), "layer_height: layer_height:");
  EXPECT_EQ(with(R"("settings": {"layer_height": "99"})").substr(0, 13), "layer_height:");
  EXPECT_EQ(with(R"("settings": {"layer_hight": "0.2"})"),
            "layer_hight: there is no option 'layer_hight'; did you mean 'layer_height'?");
  EXPECT_EQ(with(R"("settings": {"perimeters": [1]})"), "perimeters: perimeters: a text is expected");
  EXPECT_EQ(with(R"("settings": {"layer_height": "0.39", "first_layer_height": "0.39", "extrusion_width": "0.3"})")
                .substr(0, 1),
            "e");  // extrusion_width, or whichever of them the check names first
  EXPECT_EQ(with(R"("printer": "typewriter")").substr(0, 8), "printer:");
  EXPECT_EQ(with(R"("printer": "bambu-h2d")").substr(0, 8), "printer:");
  EXPECT_EQ(with(R"("materials": ["iron"])").substr(0, 10), "materials:");
  EXPECT_EQ(with(R"("materials": ["pla", "pla", "pla"])").substr(0, 10), "materials:");
  EXPECT_EQ(with(R"("materials": "pla")"), "materials: materials: a list of texts is expected");
  EXPECT_EQ(with(R"("print": 5)"), "print: print: a text is expected");
  EXPECT_EQ(with(R"("protect": "some")").substr(0, 8), "protect:");
  EXPECT_EQ(with(R"("azimuth": "north")"), "azimuth: azimuth: 'north' is neither auto nor off nor an angle in degrees");
  EXPECT_EQ(with(R"("azimuth": "inf")").substr(0, 8), "azimuth:");
  EXPECT_EQ(with(R"("azimuth": true)").substr(0, 8), "azimuth:");
  EXPECT_EQ(with(R"("colour": "red")").substr(0, 7), "colour:");
}

TEST(JobRequest, RefusesMeshesThatAreNone) {
  for (const char* body :
       {"{}", R"({"meshes": []})", R"({"meshes": 1})", R"({"meshes": [1]})", R"({"meshes": [{}]})",
        R"({"meshes": [{"id": -1}]})", R"({"meshes": [{"id": 1.5}]})", R"({"meshes": [{"id": 18446744073709551615}]})",
        R"({"meshes": [{"id": 1, "extruder": 1}]})", R"({"meshes": [{"id": 1, "extruder": 99}]})",
        R"({"meshes": [{"id": 1, "path": "/etc/passwd"}]})"})
    EXPECT_EQ(refused(body).substr(0, 7), "meshes:") << body;
}

TEST(JobRequest, RefusesWhatIsNoJsonObject) {
  for (const std::string& body : {std::string(), std::string("{"), std::string("[]"), std::string("nul"),
                                  std::string("\xff"), std::string(100000, '[')})
    EXPECT_EQ(refused(body), ": the body is not a JSON object");
}

// Whoever may slice need not be allowed to read every file that the program can.
TEST(JobRequest, NamesNoFilesButThePrinterOfTheCommandLine) {
  const TestFolder folder;
  const std::string file =
      folder.file("own.toml", "inherits = \"replicator-dual\"\nbed_shape = [[0,0],[99,0],[99,99]]\n");
  const std::string body = R"({"meshes": [{"id": 1}], "printer": ")" + file + "\"}";
  EXPECT_EQ(refused(body).substr(0, 8), "printer:");
  EXPECT_EQ(job_request(body, OwnPrinters(file)).config.bed_shape_mm.size(), 3u);
  EXPECT_EQ(refused(R"({"meshes": [{"id": 1}], "print": "/etc/passwd"})").substr(0, 6), "print:");
  EXPECT_EQ(refused(R"({"meshes": [{"id": 1}], "materials": ["./a.toml"]})").substr(0, 10), "materials:");
}

TEST(OptionTable, HasWhatAFormNeeds) {
  const auto table = nlohmann::json::parse(options_json());
  for (const auto& option : table) {
    EXPECT_FALSE(option.at("help").get<std::string>().empty());
    EXPECT_EQ(option.at("kind") == "choice", !option.at("choices").empty()) << option;
  }
  const auto found = std::ranges::find_if(table, [](const auto& o) { return o.at("name") == "layer_height"; });
  ASSERT_NE(found, table.end());
  EXPECT_EQ(found->at("default"), "0.3");
  EXPECT_EQ(found->at("unit"), "mm");
}

}  // namespace
}  // namespace cleancolor
