// base/base64.hpp
//
// Base64: bytes as text, RFC 4648, with padding, without line breaks.
#pragma once

#include <string>
#include <string_view>

namespace cleancolor {

std::string base64(std::string_view bytes);

}  // namespace cleancolor
