// audit/visibility.hpp
//
// PrintedVisibility: how plainly each place of the printed part can be seen, from the printed material alone.
//
//   roads of the part, all layers  ->  value in [0, 1] at any point of its surface
//
// 1: nothing hides it; 0: buried. The share of the open half sphere above the surface that reaches the outside within
// 25 mm, all directions counting alike; the bed is opaque. Auxiliary plastic hides nothing: it is thrown away.
// Differs from audit to audit only by the file: directions are fixed, no random numbers.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/progress.hpp"
#include "base/vec.hpp"

namespace cleancolor {

struct PartRoad {
  Vec2 a_mm, b_mm;
  float width_mm = 0;
  std::uint8_t nozzle = 0;
};

struct PartLayer {
  double bottom_mm = 0, top_mm = 0;
  std::vector<PartRoad> roads;
};

struct VisibilityOptions {
  double voxel_mm = 0.5;
  int directions = 64;  // over the whole sphere
  double reach_mm = 25;
};

class PrintedVisibility {
 public:
  /// layer(i): the roads of layer i, ascending; called once for each, from several threads.
  /// Same values for any number of threads.
  PrintedVisibility(int layers, const std::function<PartLayer(int)>& layer, const VisibilityOptions& options,
                    int threads, const Progress& progress = {});
  ~PrintedVisibility();
  PrintedVisibility(PrintedVisibility&&) noexcept;

  /// At a point of the surface (within a voxel or so); 0 deep inside the part, and 1 far away from it.
  double at(Vec3 p_mm) const;

  /// The faces of the printed part that look outside, for pictures: see audit/sides.hpp.
  struct Face {
    std::array<Vec3, 4> corners_mm;  // counterclockwise seen from outside
    std::uint8_t nozzle = 0;
  };
  std::vector<Face> faces() const;

  double voxel_mm() const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace cleancolor
