// slice/contours.hpp
//
// Contours: where planes cut a mesh, as closed rings.
#pragma once

#include <span>
#include <vector>

#include "base/polygon.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// Which triangles each of many planes cuts, found in one pass over the mesh.
class PlaneCuts {
 public:
  /// z_mm ascending. Requires: the mesh outlives the object.
  PlaneCuts(const Mesh& mesh, std::span<const double> z_mm);

  /// The rings in which plane `plane` cuts the mesh, the inside on their left, not simplified, not united.
  Polygons rings(std::size_t plane) const;

 private:
  const Mesh& mesh_;
  std::vector<double> z_mm_;
  double top_mm_ = 0;
  std::vector<std::uint32_t> first_;  // triangles_[first_[k] .. first_[k + 1]) may cut plane k
  std::vector<std::uint32_t> triangles_;
};

}  // namespace cleancolor
