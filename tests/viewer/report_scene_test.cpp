// The report's scene, of hand-written prints; tests/page/report.mjs opens a whole report in a browser.
#include "viewer/report_scene.hpp"

#include <gtest/gtest.h>

#include <array>

#include "../audit/drawn.hpp"
#include "support_errors.hpp"

namespace cleancolor {
namespace {

constexpr std::array<PageFile, 4> page = {{{"/index.html", "<!doctype html>"},
                                           {"/report.css", "#cleancolor-report { color: red; }"},
                                           {"/report.js", "draw();"},
                                           {"/report.sha256", "abc="}}};
const std::string evil = "</script><script>alert(1)</script><!-- \"'>\n&";

struct Audited {
  GcodePrint print;
  AuditMachine machine = drawn_machine({{0, 0}, {10, 0}});
  std::vector<Scenario> judged_by = scenarios();
  AuditResult result;

  Audited() {
    Drawing d(machine);
    d.layer(0).wall().go({20, 20}).lay({30, 20}).tool(1).go({40, 20}).lay({40, 30});
    print = d.print();
    result = audit(print, machine, {.scenarios = judged_by, .exposed = {}, .visibility = {}, .threads = 1});
  }
  AuditedFile file(const std::string& name) const { return {name, &print, &machine, &result, &judged_by, {}}; }
};

ReportScene scene_of(const std::vector<AuditedFile>& files, std::size_t most_moves = 1000) {
  return report_scene(files, nullptr, 1, most_moves, page);
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ReportScene, HoldsSummaryMovesAndAuditOfEveryFileAndThenTheScript) {
  const Audited one;
  const ReportScene scene = scene_of({one.file("a.gcode"), one.file("b & c.gcode")});
  EXPECT_NE(scene.place.find("<div id=\"cleancolor-report\" data-names=\"a.gcode&#10;b &amp; c.gcode\"></div>"),
            scene.place.npos)
      << scene.place;
  std::size_t last = 0;
  for (const char* part :
       {"<script type=\"application/json\" id=\"cleancolor-0-summary\">{\"name\":",
        "<script type=\"application/octet-stream\" id=\"cleancolor-0-moves\" data-encoding=\"deflate\">eJ",
        "<script type=\"application/octet-stream\" id=\"cleancolor-0-audit\" data-encoding=\"deflate\">eJ",
        "cleancolor-1-summary", "cleancolor-1-moves", "cleancolor-1-audit", "<script>draw();</script>"}) {
    const std::size_t at = scene.scripts.find(part);
    ASSERT_NE(at, scene.scripts.npos) << part;
    EXPECT_GE(at, last) << part;
    last = at;
  }
  EXPECT_EQ(count(scene.scripts, "<script"), 7u);
  EXPECT_EQ(scene.style, page[1].bytes);
  EXPECT_EQ(scene.script_sha256, "abc=");
}

TEST(ReportScene, LetsNothingFromFilesOutOfItsPlace) {
  Audited one;
  one.print.name = evil;
  one.print.facts.producer = evil;
  one.print.facts.config.push_back({"filament_type", evil});
  one.machine.offsets_source = evil;
  AuditedFile file = one.file(evil);
  file.warnings = {evil, "\xff\xfe"};
  const ReportScene scene = scene_of({file, file});
  EXPECT_EQ(count(scene.scripts, "<script"), 7u);
  EXPECT_EQ(count(scene.scripts, "</script"), 7u);
  EXPECT_EQ(count(scene.scripts, "<!--"), 0u);
  EXPECT_NE(scene.scripts.find("\\u003c/script>\\u003cscript>alert(1)"), scene.scripts.npos);
  EXPECT_EQ(count(scene.place, "<script"), 0u);
  EXPECT_EQ(count(scene.place, "&#10;"), 1u) << "a line break in a name does not make two of it";
  EXPECT_NE(scene.place.find("&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!-- &quot;&#39;&gt;?&amp;"),
            scene.place.npos)
      << scene.place;
}

TEST(ReportScene, IsLeftOutWithASentenceWhereThereAreTooManyMoves) {
  const Audited one;
  const std::size_t moves = one.print.moves.size();
  EXPECT_NE(scene_of({one.file("a"), one.file("b")}, 2 * moves).scripts, "");
  const ReportScene scene = scene_of({one.file("a"), one.file("b")}, 2 * moves - 1);
  EXPECT_EQ(scene.scripts + scene.script_sha256 + scene.style, "");
  EXPECT_NE(scene.place.find(fmt::format("there are {} moves", 2 * moves)), scene.place.npos) << scene.place;
}

TEST(ReportScene, IsEmptyWithoutThePage) {
  const Audited one;
  const std::vector<AuditedFile> files = {one.file("a.gcode")};
  const ReportScene scene = report_scene(files, nullptr, 1, 1000, std::span(page).first(1));
  EXPECT_EQ(scene.place + scene.scripts + scene.script_sha256 + scene.style, "");
}

}  // namespace
}  // namespace cleancolor
