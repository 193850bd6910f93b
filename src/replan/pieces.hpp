// replan/pieces.hpp
//
// Pieces: the roads of a run with both their ends, straight or arcs, to be cut, walked backwards and gone over again.
//
// A piece of an arc is an arc about the same centre; below 0.05 mm it is straight, for ends are rounded to 0.001 mm.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "reader/line.hpp"
#include "replan/recovered.hpp"

namespace cleancolor {

/// One road.
struct Piece {
  FilePoint from, to;
  std::int64_t filament_e5 = 0;
  double feed_mm_min = 0;
  std::uint32_t state = 0;
  std::optional<RoadArc> arc = {};
};

/// Of a line G2 or G3 with its centre, between two places of the file in mm; nothing where it is a whole circle, or
/// none.
std::optional<RoadArc> arc_of(const GcodeLine& line, Vec2 from_mm, Vec2 to_mm);

double length_um(FilePoint a, FilePoint b);
double length_um(const Piece& piece);

/// At a share of the way from a to b, or of the piece.
FilePoint between(FilePoint a, FilePoint b, double share);
FilePoint at_share(const Piece& piece, double share);

/// The place of the piece that is nearest to p, in mm of the file.
Vec2 nearest_mm(const Piece& piece, Vec2 p_mm);

std::vector<Piece> pieces_of(const RecoveredRun& run);
std::vector<Piece> backwards(std::vector<Piece> pieces);

/// Where they begin, and where each ends; arcs in steps of at most 10 degrees.
std::vector<FilePoint> points_of(const std::vector<Piece>& pieces);

/// Both parts of a piece, cut at a place on it.
std::pair<Piece, Piece> cut(const Piece& piece, FilePoint at);

/// Cuts so much off the end; returns the filament that went with it.
std::int64_t cut_end(std::vector<Piece>& pieces, double gap_um);

}  // namespace cleancolor
