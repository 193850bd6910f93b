#include "viewer/own_printers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "support_errors.hpp"
#include "viewer/api.hpp"
#include "viewer/job_request.hpp"

namespace cleancolor {
namespace {

using nlohmann::json;

/// A printer with two nozzles whose bed is so wide.
std::string toml_of(int bed_mm) {
  const std::string w = std::to_string(bed_mm);
  return "inherits = \"replicator-dual\"\nbed_shape = [[0,0],[" + w + ",0],[" + w + ",99]]\n";
}
std::string bed_text(int bed_mm) {
  const std::string w = std::to_string(bed_mm);
  return "0x0," + w + "x0," + w + "x99";
}

Answer sent(Api& api, const std::string& name, const std::string& toml) {
  return api.answer({.method = "POST", .path = "/api/profiles", .query = {{"name", name}}, .body = toml});
}
Answer forgotten(Api& api, const std::string& name) {
  return api.answer({.method = "DELETE", .path = "/api/profiles/" + name});
}
json listed(Api& api) {
  return json::parse(*api.answer({.method = "GET", .path = "/api/profiles"}).body);
}
std::vector<std::string> own_names(Api& api) {
  std::vector<std::string> names;
  for (const json& row : listed(api)) {
    const std::string name = row.at("name");
    if (name.ends_with(".toml")) names.push_back(name);
  }
  return names;
}

using Names = std::vector<std::string>;

/// What is wrong with a profile sent as my.toml.
std::string fault(const std::string& toml) {
  return error_of([&] { (void)check_printer(toml, "my.toml"); });
}

TEST(OwnPrinter, IsToldInWordsWhatIsWrongWithIt) {
  EXPECT_EQ(fault("inherits = \"replicator-dual\"\nbed_shape = [[0,0],[99,0],[99,99]]\n"), "no error");
  EXPECT_EQ(fault("# mine\nnozle_diameter = [0.4]\n").substr(0, 31), "my.toml:2: there is no option '");
  EXPECT_EQ(fault("nozzle_diameter = [[0.4\n").substr(0, 8), "my.toml:");
  EXPECT_EQ(fault("\n\nlayer_height = 0.2\n").substr(0, 11), "my.toml:3: ");
  EXPECT_EQ(fault("bed_shape = [[0,0],[99,0]]\n").substr(0, 9), "my.toml: ");
  EXPECT_EQ(fault("description = \"nothing\"\n"), "my.toml: no option of a printer is in it");
  EXPECT_EQ(error_of([] { (void)check_printer("nozzle_diameter = 0.4\n", "my.txt"); }).substr(0, 7), "my.txt:");
}

TEST(OwnPrinter, HasNoOtherFilesRead) {
  const TestFolder folder;
  const std::string file = folder.file("base.toml", "nozzle_diameter = [0.4, 0.4]\n");
  for (const std::string& name : {file, std::string("base.toml"), std::string("../base.toml")}) {
    EXPECT_EQ(fault("nozzle_diameter = 0.4\ninherits = \"" + name + "\"\n").substr(0, 21), "my.toml:2: inherits: ");
    EXPECT_EQ(fault("nozzle_diameter = 0.4\ndefault_print = \"" + name + "\"\n").substr(0, 24),
              "my.toml: default_print: ");
    EXPECT_EQ(fault("nozzle_diameter = 0.4\ndefault_material = \"" + name + "\"\n").substr(0, 27),
              "my.toml: default_material: ");
  }
}

TEST(ProfileTable, ListsTheUsersOwnPrintersFirst) {
  Api plain({}), chosen({.printer = "replicator-dual"});
  EXPECT_EQ(listed(plain).size(), listed(chosen).size());
  for (const json& p : listed(chosen)) {
    EXPECT_EQ(p.value("chosen", false), p.at("name") == "replicator-dual");
    EXPECT_EQ(p.contains("sent"), p.at("group") == "printer");
    EXPECT_FALSE(p.value("sent", false));
  }
  const TestFolder folder;
  const std::string file = folder.file("own.toml", "description = \"mine\"\n" + toml_of(99));
  Api api({.printer = file});
  EXPECT_EQ(sent(api, "sent.toml", toml_of(88)).status, 200);
  const json own = listed(api);
  EXPECT_EQ(own.size(), listed(plain).size() + 2);
  EXPECT_EQ(own[0].at("name"), file);
  EXPECT_EQ(own[0].at("description"), "mine");
  EXPECT_EQ(own[0].at("chosen"), true);
  EXPECT_EQ(own[0].at("sent"), false);
  EXPECT_EQ(own[0].at("extruders"), 2);
  EXPECT_EQ(own[0].at("settings").at("bed_shape"), bed_text(99));
  EXPECT_EQ(own[1].at("name"), "sent.toml");
  EXPECT_EQ(own[1].at("chosen"), false);
  EXPECT_EQ(own[1].at("sent"), true);
  EXPECT_EQ(own[1].at("settings").at("bed_shape"), bed_text(88));
}

TEST(OwnPrinters, AreThoseOfTheStartWhateverBecomesOfTheFile) {
  const TestFolder folder;
  const std::string file = folder.file("own.toml", toml_of(99));
  const std::string body = R"({"meshes": [{"id": 1}], "printer": ")" + file + "\"}";
  Api api({.printer = file});
  const OwnPrinters own(file);
  const json before = listed(api);
  const auto all_goes_on = [&] {
    EXPECT_EQ(sent(api, "sent.toml", toml_of(88)).status, 200);
    EXPECT_EQ(own_names(api), (Names{file, "sent.toml"}));
    EXPECT_EQ(forgotten(api, "sent.toml").status, 200);
    EXPECT_EQ(listed(api), before);
    EXPECT_EQ(job_request(body, own).config.bed_shape_mm[1].x, 99);
  };
  std::ofstream(file) << "bed_shape = [[";
  all_goes_on();
  std::ofstream(file) << toml_of(77);
  all_goes_on();
  std::filesystem::remove(file);
  all_goes_on();
}

TEST(OwnPrinters, AreReplacedByOneOfTheSameName) {
  OwnPrinters own;
  own.keep("my.toml", toml_of(99));
  const OwnPrinterHandle before = own.find("my.toml");
  own.keep("my.toml", toml_of(88));
  EXPECT_EQ(own.all().size(), 1u);
  EXPECT_EQ(json::parse(own.find("my.toml")->row).at("settings").at("bed_shape"), bed_text(88));
  const std::string body = R"({"meshes": [{"id": 1}], "printer": "my.toml"})";
  EXPECT_EQ(job_request(body, own).config.bed_shape_mm[1].x, 88);
  EXPECT_EQ(json::parse(before->row).at("settings").at("bed_shape"), bed_text(99));  // whoever has it keeps it
}

TEST(OwnPrinters, StayWhereTheirSuccessorCannotBeUsed) {
  Api api({});
  EXPECT_EQ(sent(api, "my.toml", toml_of(99)).status, 200);
  const json before = listed(api);
  for (const char* toml : {"", "bed_shape = [[", "nozle_diameter = 0.4\n", "bed_shape = [[0,0],[99,0]]\n"}) {
    EXPECT_EQ(sent(api, "my.toml", toml).status, 400) << toml;
    EXPECT_EQ(listed(api), before) << toml;
  }
}

TEST(OwnPrinters, AreSoManyAndNoMore) {
  const TestFolder folder;
  Api api({.printer = folder.file("own.toml", toml_of(99))});
  for (std::size_t i = 1; i < OwnPrinters::most; ++i)
    ASSERT_EQ(sent(api, std::to_string(i) + ".toml", toml_of(99)).status, 200);
  EXPECT_EQ(sent(api, "more.toml", toml_of(99)).status, 503);
  EXPECT_EQ(own_names(api).size(), OwnPrinters::most);
  EXPECT_EQ(sent(api, "7.toml", toml_of(88)).status, 200);  // in place of one
  EXPECT_EQ(sent(api, "more.toml", "bed_shape").status, 400);
  EXPECT_EQ(forgotten(api, "7.toml").status, 200);
  EXPECT_EQ(sent(api, "more.toml", toml_of(99)).status, 200);
}

TEST(OwnPrinters, LeaveThatOfTheCommandLineAsItIs) {
  const TestFolder folder;
  const std::filesystem::path here = std::filesystem::current_path(), file = folder.file("own.toml", toml_of(99));
  std::filesystem::current_path(file.parent_path());
  Api api({.printer = "own.toml"});
  std::filesystem::current_path(here);
  const json before = listed(api);
  const Answer refused = sent(api, "own.toml", toml_of(88));
  EXPECT_EQ(refused.status, 400);
  EXPECT_EQ(json::parse(*refused.body).at("error").at("field"), "printer");
  EXPECT_EQ(sent(api, "a/../own.toml", toml_of(88)).status, 400);
  EXPECT_EQ(forgotten(api, "own.toml").status, 404);
  EXPECT_EQ(listed(api), before);
}

TEST(OwnPrinters, AreNamedWithoutFolders) {
  Api api({});
  for (const char* name : {"../../etc/my.toml", "/my.toml", "a/b/../my.toml", "C:\\x\\my.toml", "...my.toml"}) {
    const Answer answer = sent(api, name, toml_of(99));
    EXPECT_EQ(answer.status, 200) << name;
    EXPECT_EQ(json::parse(*answer.body).at("name"), "my.toml") << name;
  }
  for (const char* name : {"", "..", "/", "../..", "my.toml/", "my.toml/.."})
    EXPECT_EQ(sent(api, name, toml_of(99)).status, 400) << name;
  EXPECT_EQ(own_names(api), Names{"my.toml"});
  for (const char* name : {"", "..", "../my.toml", "a/my.toml", "./my.toml", "/my.toml", "my.toml/", "../prints/1",
                           "replicator-dual", "none"})
    EXPECT_EQ(forgotten(api, name).status, 404) << name;
  EXPECT_EQ(own_names(api), Names{"my.toml"});
}

TEST(OwnPrinters, CanBeSentForgottenAndListedAllAtOnce) {
  const TestFolder folder;
  const std::string file = folder.file("own.toml", toml_of(99));
  Api api({.printer = file});
  std::atomic<int> sending = 3;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      const std::string own = std::to_string(t) + ".toml";
      for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(sent(api, own, toml_of(100 + i)).status, 200);
        EXPECT_EQ(sent(api, "shared.toml", toml_of(100 + t)).status, 200);
        EXPECT_EQ(forgotten(api, own).status, 200);
        EXPECT_EQ(forgotten(api, own).status, 404);
        (void)forgotten(api, "shared.toml");
      }
      --sending;
    });
  do {
    const json rows = listed(api);
    EXPECT_EQ(std::ranges::count(rows, true, [](const json& row) { return row.value("chosen", false); }), 1);
    for (const json& row : rows)
      if (row.value("sent", false)) {
        EXPECT_EQ(row.at("settings").at("bed_shape").get<std::string>().substr(0, 5), "0x0,1");
      }
  } while (sending > 0);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(own_names(api), Names{file});
}

}  // namespace
}  // namespace cleancolor
