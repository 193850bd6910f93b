// cli/console.hpp
//
// Console: progress and warnings as a person sees them, on standard error.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"

namespace cleancolor {

/// On a terminal one bar that is redrawn, "[#####     ] slicing 48%"; elsewhere a plain line at the start of each
/// stage. Warnings stand on lines of their own, each text once.
class Console {
 public:
  struct Style {
    bool terminal = false;
    bool quiet = false;  // warnings only
  };

  Console(std::ostream& out, Style style) : out_(out), style_(style) {}
  ~Console() { clear(); }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// What the library reports to.  The console must outlive it.
  Progress progress();

  /// Removes the bar, so that something else can be printed.
  void clear();

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void warn(const std::string& message);
  void advance(std::string_view stage, double done);

  std::ostream& out_;
  Style style_;
  std::string stage_;
  int percent_ = -1;
  std::size_t bar_length_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace cleancolor
