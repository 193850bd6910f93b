#include "viewer/report_scene.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

#include "audit/html_parts.hpp"
#include "base/base64.hpp"
#include "viewer/moves.hpp"
#include "viewer/places.hpp"
#include "viewer/summary.hpp"

namespace cleancolor {
namespace {

/// In zlib's format.
std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(uLong(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                uLong(bytes.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();  // all else is ruled out by the size that was asked for
  packed.resize(size);
  return packed;
}

/// JSON as text of a script: nothing in it can end the script or begin a comment.
std::string json_script(std::size_t print, const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return fmt::format("<script type=\"application/json\" id=\"cleancolor-{}-summary\">{}</script>\n", print, text);
}

std::string bytes_script(std::size_t print, std::string_view what, const std::string& bytes) {
  return fmt::format(
      "<script type=\"application/octet-stream\" id=\"cleancolor-{}-{}\" data-encoding=\"deflate\">{}</script>\n",
      print, what, base64(deflated(bytes)));
}

std::string print_scripts(std::size_t number, const AuditedFile& file, const Config* printer, int threads) {
  const Timeline& time = *file.result->time;
  const MoveArrays moves = move_arrays(*file.print, *file.machine, time, threads);
  const PlaceArrays places = place_arrays(*file.print, *file.machine, *file.result, threads);
  const ReadPrint read{.print = file.print,
                       .machine = file.machine,
                       .time = &time,
                       .moves = &moves,
                       .printer = printer,
                       .warnings = file.warnings};
  return json_script(number, print_summary(read)) + bytes_script(number, "moves", moves_file(moves)) +
         bytes_script(
             number, "audit",
             places_file(places, file.result->scenarios.front().total, file.scenarios->front(), *file.machine));
}

/// "" where there is none.
std::string_view page_bytes(std::span<const PageFile> page, std::string_view path) {
  const auto found = std::ranges::find(page, path, &PageFile::path);
  return found == page.end() ? std::string_view() : found->bytes;
}

std::string section(std::string_view scenario, std::string_view html) {
  return fmt::format(
      "<section class=\"scene\">\n<div class=\"sheet\"><h2>In three dimensions <span class=\"pale\">(scenario "
      "{})</span></h2></div>\n{}</section>\n",
      html_text(scenario), html);
}

}  // namespace

ReportScene report_scene(std::span<const AuditedFile> files, const Config* printer, int threads, std::size_t most_moves,
                         std::span<const PageFile> page) {
  const std::string_view script = page_bytes(page, "/report.js"), sha256 = page_bytes(page, "/report.sha256");
  if (files.empty() || script.empty() || sha256.empty()) return {};
  const std::string& scenario = files.front().result->scenarios.front().name;
  std::size_t moves = 0;
  for (const AuditedFile& file : files) moves += file.print->moves.size();
  ReportScene scene;
  if (moves > most_moves) {
    scene.place =
        section(scenario, fmt::format("<div class=\"sheet\"><p class=\"pale\">Left out, for there are {} moves "
                                      "to draw, more than {}: <code>cleancolor view</code> shows "
                                      "them.</p></div>\n",
                                      moves, most_moves));
    return scene;
  }
  std::string names;
  for (const AuditedFile& file : files) names += (names.empty() ? "" : "&#10;") + html_text(file.name);
  scene.place = section(scenario, fmt::format("<div id=\"cleancolor-report\" data-names=\"{}\"></div>\n", names));
  for (std::size_t i = 0; i < files.size(); ++i) scene.scripts += print_scripts(i, files[i], printer, threads);
  scene.scripts += fmt::format("<script>{}</script>\n", script);
  scene.script_sha256 = sha256;
  scene.style = page_bytes(page, "/report.css");
  return scene;
}

}  // namespace cleancolor
