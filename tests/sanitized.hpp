// sanitized.hpp
//
// For tests that sanitizers make many times as slow: how much of them is enough there. What they find does not hang on
// how many models or drawn cases of one kind go through the same code; without them all of it runs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace cleancolor::test {

/// Sanitizers take memory and time that are not the program's.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Of so many drawn cases.
constexpr int trials(int count) {
  return sanitized ? std::max(1, count / 8) : count;
}

/// The models that take seconds without them. Names as in file names or tests.
inline bool is_large(std::string_view model) {
  for (const std::string_view large :
       {"crystal", "two-color-world", "two_color_world", "world", "dragon", "spot", "robot", "detachedmodel", "benchy",
        "wagon", "heartgears", "cube-gears", "pyramid-properties"})
    if (model.starts_with(large)) return true;
  return false;
}

}  // namespace cleancolor::test

/// Leaves the test.
#define SKIP_LARGE_WHERE_SANITIZED(model)                               \
  if (cleancolor::test::sanitized && cleancolor::test::is_large(model)) \
  GTEST_SKIP() << "takes minutes under sanitizers; the smaller models do not"
