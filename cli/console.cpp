#include "cli/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "cli/interrupt.hpp"

namespace cleancolor {
namespace {

constexpr int bar_cells = 30;

}  // namespace

Progress Console::progress() {
  return {.warn = [this](const std::string& message) { warn(message); },
          .advance = [this](std::string_view stage, double done) { advance(stage, done); },
          .interrupted = [] { return interrupted(); }};
}

void Console::clear() {
  if (bar_length_ == 0) return;
  out_ << '\r' << std::string(bar_length_, ' ') << '\r' << std::flush;
  bar_length_ = 0;
  percent_ = -1;
}

void Console::warn(const std::string& message) {
  if (std::ranges::find(warnings_, message) != warnings_.end()) return;
  warnings_.push_back(message);
  clear();
  out_ << "warning: " << message << std::endl;
}

void Console::advance(std::string_view stage, double done) {
  if (style_.quiet) return;
  const int percent = static_cast<int>(std::clamp(done, 0.0, 1.0) * 100);
  const bool is_new = stage != stage_;
  if (!is_new && (percent == percent_ || !style_.terminal)) return;
  stage_ = stage;
  percent_ = percent;
  if (!style_.terminal) {
    out_ << stage << std::endl;
    return;
  }
  const int full = percent * bar_cells / 100;
  std::string bar = fmt::format("[{}{}] {} {}%", std::string(static_cast<std::size_t>(full), '#'),
                                std::string(static_cast<std::size_t>(bar_cells - full), ' '), stage, percent);
  const std::size_t length = bar.size();
  if (length < bar_length_) bar.append(bar_length_ - length, ' ');
  out_ << '\r' << bar << std::flush;
  bar_length_ = length;
}

}  // namespace cleancolor
