// base/progress.hpp
//
// Progress: how the library tells its caller what it does and what it mended. The library itself prints nothing.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cleancolor {

struct Progress {
  /// A warning: what was found, what was done about it and how much it is. Called from one thread at a time.
  std::function<void(const std::string&)> warn = [](const std::string&) {};

  /// Stage ("slicing", "toolpaths", ...) and how much of it is done, in [0, 1]. Called from one thread at a time.
  std::function<void(std::string_view stage, double done)> advance = [](std::string_view, double) {};

  /// Asked now and then, by several threads at a time; true: stop as soon as possible, leave no output, throw
  /// Error("interrupted").
  std::function<bool()> interrupted = [] { return false; };
};

}  // namespace cleancolor
