#include "gcode/text.hpp"

#include <algorithm>

namespace cleancolor {

void Text::put(std::string_view text) {
  while (!text.empty()) {
    if (used_ == capacity) flush();
    const std::size_t n = std::min(text.size(), capacity - used_);
    std::copy_n(text.data(), n, buffer_.data() + used_);
    used_ += n;
    text.remove_prefix(n);
  }
}

void Text::flush() {
  sink_.write({buffer_.data(), used_});
  flushed_ += used_;
  used_ = 0;
}

}  // namespace cleancolor
