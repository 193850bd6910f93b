#include "audit/html_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/base64.hpp"
#include "base/printable.hpp"

namespace cleancolor {
namespace {

constexpr std::size_t largest_svg = 200'000;  // bytes

// Pictures are drawn on white; on a dark page they lie there like paper.
constexpr const char* style = R"(
:root { color-scheme: light dark; --page: #f5f6f8; --card: #fff; --ink: #1d2025; --pale: #666c76; --line: #e0e3e8;
  --accent: #b3261e; --notice: #fff4d6; }
@media (prefers-color-scheme: dark) {
  :root { --page: #15171b; --card: #1f2228; --ink: #e8eaed; --pale: #9aa1ac; --line: #343942; --accent: #ff8a80;
    --notice: #3a3118; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1240px; padding: 24px 16px 48px; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Noto Sans", sans-serif; }
body.several { max-width: 1800px; }
.sheet h1 { font-size: 1.5rem; margin: 0 0 .2rem; overflow-wrap: anywhere; }
.sheet h2 { font-size: 1.15rem; margin: 2rem 0 .6rem; }
.sheet h3 { font-size: 1rem; margin: 1.2rem 0 .4rem; }
.sheet p { margin: .3rem 0 .8rem; }
.sheet .pale { color: var(--pale); }
.sheet .verdict { font-size: 1.05rem; border-left: 4px solid var(--accent); padding-left: .8rem; margin: 1rem 0; }
.sheet .cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px; margin: 1rem 0; }
.sheet .card { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 12px 14px; }
.sheet .card b { display: block; font-size: 1.4rem; line-height: 1.3; white-space: nowrap; font-variant-numeric: tabular-nums; }
.sheet .card b small { font-size: .85rem; font-weight: 400; }
.sheet .card span { color: var(--pale); font-size: .85rem; display: block; }
.sheet .notice { background: var(--notice); border-radius: 10px; padding: 10px 14px; margin: 1rem 0; overflow-wrap: anywhere; }
.sheet .notice ul { margin: .2rem 0; padding-left: 1.2rem; }
.sheet .files { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 28px; }
.sheet .files article { min-width: 0; border-top: 3px solid var(--line); padding-top: 1rem; }
.sheet .layers { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 460px), 1fr)); gap: 14px;
  align-items: start; }
.sheet .layers figure { margin: 0; }
.sheet .sides { display: grid; grid-template-columns: repeat(4, 1fr); gap: 12px; }
.sheet .files .sides { grid-template-columns: repeat(2, 1fr); }
.sheet .sides figure { margin: 0; }
@media (max-width: 640px) { .sheet .sides { grid-template-columns: repeat(2, 1fr); } }
.sheet figure { margin: 0 0 14px; background: #fff; color: #444; border: 1px solid var(--line); border-radius: 10px;
  padding: 8px; text-align: center; }
.sheet figure img { max-width: 100%; height: auto; display: block; margin: 0 auto; }
.sheet figcaption { font-size: .85rem; }
.sheet .scroll { overflow-x: auto; background: var(--card); border: 1px solid var(--line); border-radius: 10px; }
.sheet table { border-collapse: collapse; width: 100%; font-size: .9rem; }
.sheet th, .sheet td { padding: 5px 12px; text-align: right; border-top: 1px solid var(--line); font-variant-numeric: tabular-nums;
  vertical-align: top; white-space: nowrap; }
.sheet td:first-child, .sheet td.left { white-space: normal; }
.sheet td:first-child { min-width: 10.5em; }
.sheet tr:first-child > * { border-top: 0; }
.sheet th { font-weight: 600; color: var(--pale); }
.sheet th:first-child, .sheet td:first-child, .sheet .left { text-align: left; }
.sheet td.group { font-weight: 600; padding-top: 12px; }
.sheet code { font-size: .92em; }
@media print, (scripting: none) { .scene { display: none; } }
)";

std::string data_picture(std::string_view type, std::string_view bytes, std::string_view description) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/{};base64,{}\">", html_text(description), type, base64(bytes));
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string escaped;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string html_picture(const Canvas& canvas, std::string_view description) {
  const std::string svg = canvas.svg();
  return svg.size() <= largest_svg ? data_picture("svg+xml", svg, description) : html_png(canvas.png(), description);
}

std::string html_png(std::string_view png, std::string_view description) {
  return data_picture("png", png, description);
}

std::string html_table(const HtmlTable& table) {
  std::string html = "<div class=\"scroll\"><table>\n";
  const auto add_row = [&](const std::vector<std::string>& cells, const char* tag) {
    html += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool left = std::ranges::find(table.left_columns, i) != table.left_columns.end();
      html += fmt::format("<{0}{1}>{2}</{0}>", tag, left ? " class=\"left\"" : "", cells[i]);
    }
    html += "</tr>\n";
  };
  add_row(table.head, "th");
  for (const auto& row : table.rows) {
    if (row.size() == 1)
      html += fmt::format("<tr><td class=\"group\" colspan=\"{}\">{}</td></tr>\n", table.head.size(), row.front());
    else
      add_row(row, "td");
  }
  return html + "</table></div>\n";
}

std::string html_page(std::string_view title, std::string_view body, const HtmlScript& script) {
  const std::string source = script.sha256.empty() ? "" : fmt::format("; script-src 'sha256-{}'", script.sha256);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}{}</style>\n</head>\n{}</html>\n",
      source, html_text(title), style, script.style, body);
}

}  // namespace cleancolor
