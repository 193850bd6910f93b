// audit/html_parts.hpp
//
// What the HTML page is put together from: escaped texts, pictures inside the page, tables, the style.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/draw.hpp"

namespace cleancolor {

/// Text that came from somewhere else, as text of a page or of an attribute.
std::string html_text(std::string_view text);

/// A picture as part of the page: SVG where that is small, else PNG.
std::string html_picture(const Canvas& canvas, std::string_view description);
std::string html_png(std::string_view png, std::string_view description);

/// A table. Cells are HTML already. The first column and those in left_columns are texts, the others numbers.
struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> left_columns = {};
};
std::string html_table(const HtmlTable& table);

/// The one script that may run in a page. It stands in the page's body.
struct HtmlScript {
  std::string_view sha256;  // of its text, in base64; empty: none may run
  std::string_view style;   // CSS of what it draws
};

/// A whole page; class "sheet" gives its style to what is in it. Nothing in it is fetched from elsewhere, and no script
/// may run in it but the one that is named.
std::string html_page(std::string_view title, std::string_view body, const HtmlScript& script = {});

}  // namespace cleancolor
