#include "model/view.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {

std::optional<double> view_direction_deg(std::string_view text) {
  const std::string_view word = trimmed(text);
  if (word == "none") return std::nullopt;
  const auto degrees = number<double>(word);
  if (!degrees || *degrees < 0 || *degrees > 360)
    throw Error(fmt::format("view_direction: '{}' is neither none nor degrees from 0 to 360", text));
  return degrees;
}

}  // namespace cleancolor
