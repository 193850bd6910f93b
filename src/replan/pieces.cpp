#include "replan/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleancolor {
namespace {

constexpr double same_radius_mm = 0.05, least_apart_mm = 0.002;  // of an arc's ends
constexpr double least_arc_um = 50;
constexpr double step_rad = std::numbers::pi / 18;

/// From one place of an arc to another, about its centre: > 0 counterclockwise.
double sweep_rad(const RoadArc& arc, FilePoint from, FilePoint to) {
  const Vec2 a = mm_of(from) - mm_of(arc.center), b = mm_of(to) - mm_of(arc.center);
  double angle = std::atan2(cross(a, b), dot(a, b));
  if (arc.clockwise && angle > 0) angle -= 2 * std::numbers::pi;
  if (!arc.clockwise && angle < 0) angle += 2 * std::numbers::pi;
  return angle;
}

double share_at(const Piece& piece, FilePoint at) {
  if (piece.arc && at == piece.to) return 1;
  if (piece.arc) return sweep_rad(*piece.arc, piece.from, at) / sweep_rad(*piece.arc, piece.from, piece.to);
  const double whole = length_um(piece.from, piece.to);
  return whole > 0 ? length_um(piece.from, at) / whole : 0;
}

}  // namespace

std::optional<RoadArc> arc_of(const GcodeLine& line, Vec2 from_mm, Vec2 to_mm) {
  const Vec2 center = from_mm + Vec2{line.value_or('I', 0), line.value_or('J', 0)};
  const bool is_round = std::abs(distance(center, from_mm) - distance(center, to_mm)) <= same_radius_mm;
  if (!is_round || distance(from_mm, to_mm) < least_apart_mm) return std::nullopt;
  return RoadArc{file_point(center), line.number == 2};
}

double length_um(FilePoint a, FilePoint b) {
  return std::hypot(double(b.x_um - a.x_um), double(b.y_um - a.y_um));
}

double length_um(const Piece& piece) {
  if (!piece.arc) return length_um(piece.from, piece.to);
  return std::abs(sweep_rad(*piece.arc, piece.from, piece.to)) * length_um(piece.arc->center, piece.from);
}

namespace {

Piece straight_where_short(Piece piece) {
  if (piece.arc && length_um(piece) < least_arc_um) piece.arc.reset();
  return piece;
}

}  // namespace

FilePoint between(FilePoint a, FilePoint b, double share) {
  return {a.x_um + std::llround(double(b.x_um - a.x_um) * share),
          a.y_um + std::llround(double(b.y_um - a.y_um) * share)};
}

FilePoint at_share(const Piece& piece, double share) {
  if (!piece.arc) return between(piece.from, piece.to, share);
  if (share >= 1) return piece.to;
  const double angle = share * sweep_rad(*piece.arc, piece.from, piece.to), c = std::cos(angle), s = std::sin(angle);
  const FilePoint m = piece.arc->center;
  const double x = double(piece.from.x_um - m.x_um), y = double(piece.from.y_um - m.y_um);
  return {m.x_um + std::llround(c * x - s * y), m.y_um + std::llround(s * x + c * y)};
}

Vec2 nearest_mm(const Piece& piece, Vec2 p_mm) {
  const Vec2 from = mm_of(piece.from), to = mm_of(piece.to);
  if (!piece.arc) return nearest_on_segment(from, to, p_mm);
  const Vec2 center = mm_of(piece.arc->center), out = p_mm - center;
  const double radius = distance(center, from), apart = length(out);
  if (apart > 0) {
    const Vec2 on = center + out * (radius / apart);
    const FilePoint at = file_point(on);
    const double share = share_at(piece, at);
    if (share >= 0 && share <= 1) return on;
  }
  return distance(p_mm, from) <= distance(p_mm, to) ? from : to;
}

std::vector<Piece> pieces_of(const RecoveredRun& run) {
  std::vector<Piece> pieces;
  FilePoint from = run.from;
  for (const RunRoad& road : run.roads) {
    pieces.push_back({from, road.to, road.filament_e5, road.feed_mm_min, road.state, road.arc});
    from = road.to;
  }
  return pieces;
}

std::vector<Piece> backwards(std::vector<Piece> pieces) {
  std::ranges::reverse(pieces);
  for (Piece& p : pieces) {
    std::swap(p.from, p.to);
    if (p.arc) p.arc->clockwise = !p.arc->clockwise;
  }
  return pieces;
}

std::vector<FilePoint> points_of(const std::vector<Piece>& pieces) {
  std::vector<FilePoint> points;
  for (const Piece& piece : pieces) {
    if (points.empty()) points.push_back(piece.from);
    const double sweep = piece.arc ? std::abs(sweep_rad(*piece.arc, piece.from, piece.to)) : 0;
    const int steps = std::max(1, int(std::ceil(sweep / step_rad)));
    for (int i = 1; i <= steps; ++i) points.push_back(at_share(piece, double(i) / steps));
  }
  return points;
}

std::pair<Piece, Piece> cut(const Piece& piece, FilePoint at) {
  Piece first = piece, second = piece;
  first.to = second.from = at;
  first.filament_e5 = std::llround(double(piece.filament_e5) * share_at(piece, at));
  second.filament_e5 = piece.filament_e5 - first.filament_e5;
  return {straight_where_short(first), straight_where_short(second)};
}

std::int64_t cut_end(std::vector<Piece>& pieces, double gap_um) {
  std::int64_t filament = 0;
  while (!pieces.empty() && gap_um > 0.5) {
    Piece& last = pieces.back();
    const double length = length_um(last);
    if (length > gap_um + 0.5) {
      const auto [kept, rest] = cut(last, at_share(last, 1 - gap_um / length));
      filament += rest.filament_e5;
      last = kept;
      break;
    }
    filament += last.filament_e5;
    gap_um -= length;
    pieces.pop_back();
  }
  return filament;
}

}  // namespace cleancolor
