// base/printable.hpp
//
// Text from a file, made fit to be shown: on a terminal, in a picture, on a page.
#pragma once

#include <string>
#include <string_view>

namespace cleancolor {

/// Valid UTF-8 without control characters: each control character, and each byte that is no UTF-8, becomes '?'. So no
/// file name or comment can move the cursor of a terminal or break a page.
std::string printable(std::string_view text);

}  // namespace cleancolor
