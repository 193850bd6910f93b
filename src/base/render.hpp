// base/render.hpp
//
// Render: a picture of coloured triangle meshes, for thumbnails and previews.
//
//   bodies, size  ->  PNG
//
// Orthographic, seen from the front, the right and above, all bodies fitted into the picture. Soft light from the upper
// left and from the sky; smooth where faces meet at a small angle, sharp at edges. Hidden surfaces by a z-buffer,
// smooth outlines by drawing at a multiple of the size. One thread: the same bytes on every run.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/vec.hpp"

namespace cleancolor {

struct Body {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::uint32_t, 3>> triangles;  // corners counterclockwise seen from outside
  std::uint32_t rgb = 0xFFFFFF;                             // 0xRRGGBB
};

struct View {
  int width_px = 220;
  int height_px = 124;
  double azimuth_rad = 0.5235987755982988;    // the viewer stands this far to the right of the front (-Y): 30 degrees
  double elevation_rad = 0.6154797086703874;  // and looks down this steeply: as in an isometric drawing
  double margin = 0.04;                       // free border, share of the picture
  bool transparent = true;                    // background; else white
};

/// The bytes of a PNG file; an empty scene gives the background alone.
/// Requires: sizes in [1, 8192]; indices < vertices.size(); finite vertices.
/// Cost: about 60 ns a triangle plus 15 ns for each of the (up to 16) samples of a pixel.
std::string rendered_png(std::span<const Body> bodies, const View& view = {});

}  // namespace cleancolor
