// viewer/page.hpp
//
// The page: the files that viewer/page/ builds to, part of the program itself.
#pragma once

#include <span>
#include <string_view>

namespace cleancolor {

struct PageFile {
  std::string_view path;  // "/index.html", "/assets/index-1a2b.js"
  std::string_view bytes;
};

/// By path. One text that says so where the program was built without the page.
std::span<const PageFile> page_files();

/// "text/html; charset=utf-8" of a path that ends in .html.
std::string_view content_type(std::string_view path);

}  // namespace cleancolor
