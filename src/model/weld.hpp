// model/weld.hpp
//
// Vertices that lie at the same place become one vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.hpp"

namespace cleancolor {

/// Collects points, each distinct one once. Equal means equal coordinates; -0 and 0 are the same.
///
/// Indices count up in the order of first appearance, so the same input gives the same mesh.
class ExactWelder {
 public:
  explicit ExactWelder(std::size_t expected_points = 0);

  /// The index of the point, new or known.  Requires: finite; fewer than 2^32 - 1 distinct points.
  std::uint32_t add(Vec3 p);

  const std::vector<Vec3>& points() const { return points_; }
  std::vector<Vec3> take() { return std::move(points_); }

 private:
  std::size_t slot_of(const Vec3& p) const;
  void grow();

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> slots_;  // open addressing; a power of two long; 1 + index, 0: free
};

/// For each point the index of the point it is merged into (itself where it stays): the first one seen within
/// tolerance_mm. Only points with candidate[i] set move or are moved to.  Cost: about linear.
std::vector<std::uint32_t> merged_within(const std::vector<Vec3>& points, const std::vector<char>& candidate,
                                         double tolerance_mm);

}  // namespace cleancolor
