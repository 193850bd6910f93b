// The page of a program that was built with CLEANCOLOR_PAGE=OFF.

#include <array>

#include "viewer/page.hpp"

namespace cleancolor {

std::span<const PageFile> page_files() {
  static constexpr std::array<PageFile, 1> files = {
      {{"/index.html",
        "<!doctype html><html lang=en><title>cleancolor</title><p>This program was built without its page "
        "(CLEANCOLOR_PAGE=OFF). The API answers all the same: docs/viewer-api.md."}}};
  return files;
}

}  // namespace cleancolor
