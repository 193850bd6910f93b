// base/rows.hpp
//
// Rows: regions as lines that a comb would cut out of them.
//
//   region  ->  for each row of constant y the intervals of x inside, exact in x
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/polygon.hpp"

namespace cleancolor {

struct Interval {
  float begin_mm = 0, end_mm = 0;
};

/// Row r lies at first_mm + r * spacing_mm.
struct RowPlan {
  double first_mm = 0;
  double spacing_mm = 0.5;
  int count = 0;
};

/// The intervals of all rows, one row after the other.
class Rows {
 public:
  Rows() = default;
  /// By the even-odd rule, which for Clipper's results is the non-zero rule.
  /// Cost: edges x rows that each crosses.
  Rows(const Polygons& region, const RowPlan& plan);

  /// What lies in any of them.
  static Rows united(std::span<const Rows* const> all);

  /// Of row r, ascending and apart; empty beyond the first and last row.
  std::span<const Interval> row(int r) const {
    if (r < 0 || r + 1 >= int(first_.size())) return {};
    const std::size_t i = std::size_t(r);
    return {intervals_.data() + first_[i], intervals_.data() + first_[i + 1]};
  }
  int count() const { return first_.empty() ? 0 : int(first_.size()) - 1; }
  bool empty() const { return intervals_.empty(); }

 private:
  std::vector<std::uint32_t> first_;  // of each row; one more at the end
  std::vector<Interval> intervals_;
};

/// Length of what lies in both, the first moved by shift_mm.
double common_mm(std::span<const Interval> a, double shift_mm, std::span<const Interval> b);

}  // namespace cleancolor
