// Reports of results made by hand, so that every number in them is known, and of small prints that are audited.

#include "audit/report.hpp"

#include <gtest/gtest.h>

#include "audit/comparison.hpp"
#include "audit/ooze_keys.hpp"
#include "audit/report_words.hpp"
#include "drawn.hpp"
#include "json_schema.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

using nlohmann::json;

/// A file of three layers and two nozzles whose figures are made up.
struct MadeUp {
  GcodePrint print;
  AuditMachine machine = drawn_machine({{0, 0}, {33, 0}});
  std::vector<Scenario> judged_by = scenarios();
  AuditResult result;

  explicit MadeUp(double part_mm3 = 1000) {
    Drawing drawing(machine);
    for (int layer = 0; layer < 3; ++layer)
      drawing.layer(layer).tool(0, true).wall().road({0, 0}, {10, 0}).tool(1, true).road({0, 1}, {10, 1});
    print = drawing.print();
    print.unknown = {{"M999", 3, 17}};
    machine.offsets_source = "--nozzle-offset";
    machine.offsets_in_source = "--offsets-in";
    result = audit(print, machine, {.scenarios = judged_by, .exposed = {}, .visibility = {}, .threads = 1});
    result.print_time_s = 3725;
    result.travel_mm = 12340;
    result.tool_changes = 5;
    result.nozzles = {{1000, 500, part_mm3 * 0.75, 100, 2.5, 1.25}, {400, 0, part_mm3 * 0.25, 0, 1, 0}};
    for (ScenarioResult& scenario : result.scenarios) {
      scenario.total = {};
      scenario.layers.assign(3, {});
      scenario.places.clear();
      scenario.pairs = {{0, 1, {}}, {1, 0, {}}};
    }
    ScenarioResult& worst = result.scenarios[0];
    worst.layers[1].smear_volume_travel = 1.5;
    worst.layers[2].smear_volume_print = 2.25;
    worst.layers[2].hole_volume = 0.125;
    for (const Figures& layer : worst.layers) worst.total += layer;
    worst.pairs[1].figures = worst.total;
    Place smear;
    smear.nozzle = 1;
    smear.mm3 = 2.25F;
    smear.visibility = 0.5F;
    smear.layer = 2;
    smear.at_mm = {12.34, 5.67};
    worst.places.push_back(smear);
  }

  AuditedFile file(const std::string& name = "a.gcode") const {
    return {name, &print, &machine, &result, &judged_by, {"a warning"}};
  }
};

std::string longest_line(const std::string& text) {
  std::string longest, line;
  for (std::istringstream lines(text); std::getline(lines, line);)
    if (line.size() > longest.size()) longest = line;
  return longest;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != text.npos;
}

TEST(AuditText, SaysWhatWasFoundAndWhere) {
  const std::string text = audit_text(MadeUp().file());
  for (const char* part : {"a.gcode\n", "PrusaSlicer 2.5.0", "3, up to 0.60 mm; 5 tool changes", "1 h 02 min",
                           "12.34 m of travel", "T1 at 33,0 mm, by --nozzle-offset", "the slicer, by --offsets-in",
                           "T0              1.00 m      2.50 g            0.50 m      1.25 g",
                           "smear_volume                              3.75        0.00 mm3",
                           "T1 over T0                                3.75        0.00 mm3",
                           "smear of T1 over T0            3      0.60      12.3       5.7     2.250  printing",
                           "unknown commands: M999 (3)"})
    EXPECT_TRUE(contains(text, part)) << part << "\nis not in\n" << text;
}

TEST(AuditText, EndsWithTheVerdict) {
  const std::string text = audit_text(MadeUp().file());
  EXPECT_TRUE(
      contains(text, "\nworst: smears: 3.75 mm3 in 2 of 3 layers, most in layer 3 (z 0.60 mm); holes: 0.12 mm3 in 1"))
      << text;
}

TEST(AuditText, FitsATerminalOf100Columns) {
  MadeUp made;
  made.print.facts.producer = std::string("A slicer with a long name ") + std::string(60, 'x');
  for (int i = 0; i < 50; ++i) made.print.unknown.push_back({fmt::format("COMMAND_{}", i), 1000000, 1});
  EXPECT_LE(longest_line(audit_text(made.file())).size(), 100u);
  const MadeUp other;
  const std::vector<AuditedFile> files(9, other.file());
  EXPECT_LE(longest_line(comparison_text(files)).size(), 100u);
}

TEST(AuditText, ShowsTheChosenScenarioFirst) {
  const std::string text = audit_text(MadeUp().file(), {.scenario = 1});
  EXPECT_TRUE(contains(text, "       model       worst\n")) << text;
  EXPECT_TRUE(contains(text, "\nmodel: no smears; no holes\n")) << text;
}

TEST(AuditText, LetsNoFileMoveTheCursor) {
  MadeUp made;
  made.print.facts.producer = "evil\x1b[2J";
  made.print.unknown[0].name = "M1\x1b]0;";
  const std::string text = audit_text(made.file("\x1b[31mred.gcode"));
  EXPECT_FALSE(contains(text, "\x1b"));
  EXPECT_TRUE(contains(text, "?[31mred.gcode"));
}

TEST(Verdict, OfOneColourSpeaksOfNoSmears) {
  MadeUp made;
  made.result.nozzles.resize(1);
  made.result.scenarios[0].layers.assign(3, {});
  made.result.scenarios[0].total = {};
  EXPECT_EQ(verdict(made.print, made.result, 0), "one colour: nothing to smear; no holes");
}

TEST(WorstLayers, AreThoseWithMostSmearsAndHoles) {
  ScenarioResult s;
  s.layers.resize(5);
  s.layers[1].smear_volume_print = 1;
  s.layers[2].hole_volume = 3;
  s.layers[4].smear_volume_travel = 1;
  EXPECT_EQ(worst_layers(s, 9), (std::vector<std::uint32_t>{2, 1, 4}));  // of equals the lower one first
  EXPECT_EQ(worst_layers(s, 1), (std::vector<std::uint32_t>{2}));
}

TEST(Comparison, PutsTimeAndFilamentBesideTheFigures) {
  const MadeUp a, b(1020);
  const std::vector<AuditedFile> files = {a.file(), b.file("b.gcode")};
  const std::string text = comparison_text(files);
  for (const char* part :
       {"1  a.gcode, PrusaSlicer", "2  b.gcode", "smear_volume, mm3                        3.75         3.75",
        "time                               1 h 02 min   1 h 02 min",
        "part plastic, cm3                       1.000        1.020",
        "T0 auxiliary, g                          1.25         1.25"})
    EXPECT_TRUE(contains(text, part)) << part << "\nis not in\n" << text;
}

TEST(Comparison, SaysWhetherTheFilesPrintTheSamePart) {
  const MadeUp a, b(1029), c(1031);  // 2.9 % and 3.1 % more plastic
  const std::vector<AuditedFile> same = {b.file(), a.file()}, different = {a.file(), c.file()};
  EXPECT_NEAR(part_difference(same), 0.029, 1e-9);
  EXPECT_TRUE(contains(comparison_text(same), "\nThe files print the same part: its plastic differs by 2.9 %."));
  EXPECT_TRUE(
      contains(comparison_text(different), "\nThe files do not print the same part: its plastic differs by 3.1 %"));
}

TEST(Comparison, ShowsOnlyScenariosThatAllFilesHave) {
  const MadeUp a;
  MadeUp b;
  b.result.scenarios.pop_back();
  const std::vector<AuditedFile> files = {a.file(), b.file()};
  for (const ComparisonRow& row : comparison(files)) EXPECT_NE(row.group, "model");
}

JsonSchema schema() {
  return JsonSchema(json::parse(file_text(CLEANCOLOR_ROOT "/docs/audit.schema.json")));
}

TEST(AuditJson, HasExactlyTheMembersOfItsSchema) {
  const MadeUp made;
  const std::vector<AuditedFile> files = {made.file(), made.file("b.gcode")};
  const json value = json::parse(audit_json(files));
  EXPECT_EQ(schema().breaches(value), std::vector<std::string>());

  // The schema itself would notice.
  json more = value, less = value, wrong = value;
  more["files"][0]["scenarios"]["worst"]["layers"][0]["new"] = 1;
  less["files"][1]["print"]["nozzles"][0].erase("part_g");
  wrong["files"][0]["machine"]["offsets_in"] = "nowhere";
  for (const json& bad : {more, less, wrong}) EXPECT_EQ(schema().breaches(bad).size(), 1u);
}

/// Calls visit for every schema of an object with properties.
template <class Visit>
void for_objects(const json& node, const Visit& visit) {
  if (node.is_object() && node.contains("properties") && node["properties"].is_object() && node.contains("type"))
    visit(node);
  for (const json& child : node)
    if (child.is_structured()) for_objects(child, visit);
}

TEST(AuditJson, LeavesNothingOptional) {
  int objects = 0;
  for_objects(schema().root(), [&](const json& object) {
    ++objects;
    ASSERT_TRUE(object.contains("required") && object.contains("additionalProperties")) << object.dump();
    EXPECT_EQ(object["required"].size(), object["properties"].size());
    for (const json& name : object["required"]) EXPECT_TRUE(object["properties"].contains(name.get<std::string>()));
  });
  EXPECT_GE(objects, 10);
}

TEST(AuditJson, OfVariantsFollowsTheSchemaToo) {
  MadeUp made;
  made.judged_by = scenarios(/*sensitivity=*/true);
  made.result = audit(made.print, made.machine, {.scenarios = made.judged_by, .exposed = {}, .visibility = {}});
  const std::vector<AuditedFile> files = {made.file()};
  const json value = json::parse(audit_json(files));
  EXPECT_EQ(schema().breaches(value), std::vector<std::string>());
  EXPECT_EQ(value["files"][0]["scenarios"].size(), made.judged_by.size());
}

TEST(AuditJson, TellsFiguresPlacesAndWhatWasAssumed) {
  const MadeUp made;
  const std::vector<AuditedFile> files = {made.file()};
  const json file = json::parse(audit_json(files))["files"][0];
  const json& worst = file["scenarios"]["worst"];
  EXPECT_EQ(worst["figures"]["smear_volume"], 3.75);
  EXPECT_EQ(worst["layers"][2]["layer"], 3);
  EXPECT_EQ(worst["layers"][2]["hole_volume"], 0.125);
  EXPECT_EQ(worst["pairs"][1]["nozzle"], 1);
  EXPECT_EQ(worst["pairs"][1]["figures"]["smear_volume_print"], 2.25);
  EXPECT_EQ(worst["places"][0]["at_mm"], json({12.34, 5.67}));
  EXPECT_EQ(worst["places"][0]["layer"], 3);
  EXPECT_EQ(worst["ooze"][0]["touch_height_mm"], nullptr);
  EXPECT_EQ(worst["ooze"][0]["volume_mm3"], 2);
  EXPECT_EQ(file["machine"]["nozzles"][1]["offset_mm"], json({33, 0}));
  EXPECT_EQ(file["print"]["nozzles"][0]["part_mm3"], 750);
  EXPECT_EQ(file["unknown_commands"][0], json({{"name", "M999"}, {"count", 3}, {"first_line", 17}}));
  EXPECT_EQ(file["warnings"], json({"a warning"}));
}

TEST(AuditJson, ListsAsManyPlacesAsAskedFor) {
  MadeUp made;
  Place& first = made.result.scenarios[0].places.front();
  for (int i = 1; i < 8; ++i) {
    Place other = first;
    other.at_mm.x += 20 * i;
    made.result.scenarios[0].places.push_back(other);
  }
  const std::vector<AuditedFile> files = {made.file()};
  for (const std::size_t count : {0u, 3u, 8u})
    EXPECT_EQ(json::parse(audit_json(files, {.places = count}))["files"][0]["scenarios"]["worst"]["places"].size(),
              count);
}

TEST(AuditJson, IsUtf8WhateverTheFileSays) {
  MadeUp made;
  made.print.facts.producer = "\xff\xfe\x01";
  const std::vector<AuditedFile> files = {made.file("caf\xe9.gcode")};
  EXPECT_EQ(schema().breaches(json::parse(audit_json(files))), std::vector<std::string>());
}

TEST(AuditHtml, EscapesWhateverComesFromFiles) {
  MadeUp made;
  const std::string evil = "<script>alert(1)</script>\"'><img src=x onerror=alert(1)>";
  made.print.facts.producer = evil;
  made.print.unknown[0].name = evil;
  made.machine.offsets_source = evil;
  made.machine.offsets_in_source = evil;
  AuditedFile file = made.file(evil + ".gcode");
  file.warnings = {evil};
  for (const std::size_t count : {1u, 2u}) {
    const std::string html = audit_html(std::vector<AuditedFile>(count, file));
    EXPECT_FALSE(contains(html, "<script"));
    EXPECT_FALSE(contains(html, "<img src=x"));
    EXPECT_FALSE(contains(html, "\"'>"));
    EXPECT_TRUE(contains(html, "&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;&gt;"));
  }
}

TEST(AuditHtml, FetchesNothing) {
  const MadeUp made;
  for (const std::size_t count : {1u, 3u}) {
    const std::string html = audit_html(std::vector<AuditedFile>(count, made.file()));
    for (const char* outside : {"http://", "https://", "url(", "<link", "@import", "<iframe", "src=\"/"})
      EXPECT_FALSE(contains(html, outside)) << outside;
    EXPECT_TRUE(contains(html, "src=\"data:image/"));
    EXPECT_TRUE(contains(html, "default-src 'none'"));
  }
}

TEST(AuditHtml, RunsNoScriptButThatOfItsScene) {
  const MadeUp made;
  const ReportScene scene{.place = "<div id=\"scene\"></div>\n",
                          .scripts = "<script>draw()</script>\n",
                          .script_sha256 = "abc=",
                          .style = "#scene { height: 9px; }"};
  for (const std::size_t count : {1u, 2u}) {
    const std::vector<AuditedFile> files(count, made.file());
    const std::string without = audit_html(files), html = audit_html(files, {}, scene);
    EXPECT_FALSE(contains(without, "script-src"));
    EXPECT_TRUE(contains(html, "style-src 'unsafe-inline'; script-src 'sha256-abc='\">"));
    EXPECT_TRUE(contains(html, "#scene { height: 9px; }</style>"));
    EXPECT_TRUE(contains(html, "<script>draw()</script>\n</body>"));
    EXPECT_LT(html.find("<h1>"), html.find("<div id=\"scene\">"));
    EXPECT_LT(html.find("<div id=\"scene\">"), html.find("From four sides"));
  }
}

/// Tags that are opened and not closed, or closed and not opened.
std::vector<std::string> unbalanced_tags(const std::string& html) {
  std::vector<std::string> open, faults;
  for (std::size_t at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    const bool closes = html[at + 1] == '/';
    const std::size_t begin = at + 1 + closes;
    const std::string name = html.substr(begin, html.find_first_of(" >\n", begin) - begin);
    if (name == "!doctype" || name == "meta" || name == "img") continue;
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      faults.push_back("/" + name);
    } else {
      open.pop_back();
    }
  }
  faults.insert(faults.end(), open.begin(), open.end());
  return faults;
}

TEST(AuditHtml, ClosesEveryTag) {
  const MadeUp made;
  for (const std::size_t count : {1u, 2u})
    EXPECT_EQ(unbalanced_tags(audit_html(std::vector<AuditedFile>(count, made.file()))), std::vector<std::string>());
}

TEST(AuditHtml, ShowsOneFileWithHelpAndSeveralSideBySide) {
  const MadeUp made;
  const std::string one = audit_html(std::vector{made.file()});
  const std::string two = audit_html(std::vector{made.file(), made.file("b.gcode")});
  for (const char* part : {"3.75", "1 h 02 min", "smear of T1 over T0", "a warning", "M999", "--nozzle-offset"}) {
    EXPECT_TRUE(contains(one, part)) << part;
    EXPECT_TRUE(contains(two, part)) << part;
  }
  EXPECT_TRUE(contains(one, "ooze left on visible plastic of another colour"));
  EXPECT_TRUE(contains(two, "The files print the same part"));
  EXPECT_TRUE(contains(two, "<h1>b.gcode</h1>"));
}

TEST(AuditDocs, ListEveryFigure) {
  std::string table = "<!-- figures -->\n| figure | unit | what it is |\n|---|---|---|\n";
  for (const FigureInfo& f : figure_table())
    table += fmt::format("| `{}` | {} | {} |\n", f.name, f.unit == "1" ? "" : f.unit, f.help);
  table += "<!-- end -->\n";
  EXPECT_TRUE(contains(file_text(CLEANCOLOR_ROOT "/docs/audit.md"), table)) << "docs/audit.md should have\n" << table;
}

TEST(AuditDocs, ListTheNumbersOfBothScenarios) {
  std::string table = "<!-- scenarios -->\n| `--ooze` | unit | worst | model | what it is |\n|---|---|---|---|---|\n";
  for (const OozeKey& key : ooze_keys())
    table += fmt::format("| `{}` | {} | {:g} | {:g} | {} |\n", key.name, key.unit, key.of(worst_ooze()),
                         key.of(model_ooze()), key.help);
  table += "<!-- end -->\n";
  EXPECT_TRUE(contains(file_text(CLEANCOLOR_ROOT "/docs/audit.md"), table)) << "docs/audit.md should have\n" << table;
}

TEST(AuditDocs, NameEveryMemberOfTheJson) {
  const std::string docs = file_text(CLEANCOLOR_ROOT "/docs/audit.md");
  const JsonSchema documented = schema();
  for (const char* part : {"file", "place"})
    for (const auto& [name, unused] : documented.root()["$defs"][part]["properties"].items())
      EXPECT_TRUE(contains(docs, "`" + name + "`")) << name;
  for (const char* part : {"machine", "print"})
    for (const auto& [name, unused] : documented.root()["$defs"]["file"]["properties"][part]["properties"].items())
      EXPECT_TRUE(contains(docs, "`" + name + "`")) << name;
}

TEST(OozeKeys, ReachEveryNumber) {
  for (const OozeKey& key : ooze_keys()) {
    OozeParameters ooze = worst_ooze();
    const double other = key.of(ooze) == 1 ? 0 : 1;
    key.set(ooze, other);
    EXPECT_EQ(key.of(ooze), other) << key.name;
    for (const OozeKey& rest : ooze_keys()) {
      if (rest.name == key.name) continue;
      EXPECT_EQ(rest.of(ooze), rest.of(worst_ooze())) << key.name << " sets " << rest.name;
    }
  }
  EXPECT_EQ(find_ooze_key("nonesuch"), nullptr);
}

}  // namespace
}  // namespace cleancolor
