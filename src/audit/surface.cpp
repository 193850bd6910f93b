#include "audit/surface.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cleancolor {
namespace {

constexpr double smallest_cell_mm = 1;
constexpr double widest_half_mm = 2.5;
constexpr double cells_along_road = 8;       // of a road as long as the mean
constexpr double cells_across_box = 1024;    // a way across the whole layer goes through so many
constexpr std::uint32_t longest_side = 256;  // of the table
constexpr double nothing = 1e-12;            // a share of the way that is only touched

double half_width_mm(const SurfaceRoad& r) {
  return std::clamp(double(r.half_width_mm), 0., widest_half_mm);
}

Share united(Share a, Share b) {
  if (a.begin > a.end) return b;
  if (b.begin > b.end) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

/// The share of p + t d, t in [0, 1], with low <= p + t d <= high.
Share share_between(double p, double d, double low, double high) {
  if (d == 0) return p >= low && p <= high ? Share{0, 1} : Share{};
  const double t0 = (low - p) / d, t1 = (high - p) / d;
  return {std::max(0., std::min(t0, t1)), std::min(1., std::max(t0, t1))};
}

Share share_in_disc(Vec2 from_middle, Vec2 d, double radius) {
  const double a = dot(d, d), b = dot(from_middle, d), c = dot(from_middle, from_middle) - radius * radius;
  if (a == 0) return c <= 0 ? Share{0, 1} : Share{};
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const double root = std::sqrt(discriminant);
  return {std::max(0., (-b - root) / a), std::min(1., (-b + root) / a)};
}

/// Lower lies on top: part before auxiliary, foreign before own, visible before inner, early before late.
std::uint64_t rank(const SurfaceRoad& r, int nozzle) {
  const std::uint64_t kind = !r.part ? 4 : (r.nozzle == nozzle ? 2 : 0) + (r.visible ? 0 : 1);
  return kind << 32 | r.drive_order;
}

}  // namespace

Share share_over(Vec2 a_mm, Vec2 b_mm, const SurfaceRoad& road) {
  const Vec2 d = b_mm - a_mm, axis = road.b_mm - road.a_mm, q = a_mm - road.a_mm;
  const double h = half_width_mm(road), l = length(axis);
  if (l == 0) return share_in_disc(q, d, h);
  const Vec2 u = axis * (1 / l);
  const double beside = cross(u, q), beside_end = beside + cross(u, d);
  if (std::min(beside, beside_end) > h || std::max(beside, beside_end) < -h) return {};
  const double along = dot(u, q), along_end = along + dot(u, d);
  if (std::min(along, along_end) > l + h || std::max(along, along_end) < -h) return {};
  // The stadium is convex: what its rectangle and its two discs cover of a line is one interval.
  const Share across = share_between(beside, beside_end - beside, -h, h);
  const Share lengthwise = share_between(along, along_end - along, 0, l);
  Share share{std::max(across.begin, lengthwise.begin), std::min(across.end, lengthwise.end)};
  if (std::min(along, along_end) < 0) share = united(share, share_in_disc(q, d, h));
  if (std::max(along, along_end) > l) share = united(share, share_in_disc(a_mm - road.b_mm, d, h));
  return share;
}

struct LayerSurface::Cells {
  std::vector<SurfaceRoad> roads;
  Box<Vec2> box;
  double cell_mm = smallest_cell_mm;
  std::uint32_t columns = 1, rows = 1;  // of the table: powers of 2
  std::vector<std::uint32_t> first;     // by bucket: where its roads begin; one more at the end
  std::vector<std::uint32_t> entries;   // indices of roads

  std::size_t bucket(std::int64_t x, std::int64_t y) const {
    return (std::uint64_t(y) & (rows - 1)) * columns + (std::uint64_t(x) & (columns - 1));
  }
  Vec2 in_cells(Vec2 p_mm) const { return (p_mm - box.min) * (1 / cell_mm); }

  void size_up();
  void fill();
  template <class Visit>
  void for_cells(const SurfaceRoad& road, Visit visit) const;
  template <class Visit>
  void for_cells(Vec2 a_mm, Vec2 b_mm, Visit visit) const;
};

void LayerSurface::Cells::size_up() {
  double length_mm = 0, width_mm = 0;
  for (const SurfaceRoad& r : roads) {
    const double h = half_width_mm(r);
    length_mm += distance(r.a_mm, r.b_mm);
    width_mm += 2 * h;
    for (const Vec2 p : {r.a_mm, r.b_mm}) {
      box.add(p - Vec2{h, h});
      box.add(p + Vec2{h, h});
    }
  }
  const Vec2 size = box.size();
  const double count = double(roads.size());
  cell_mm = std::max({smallest_cell_mm, length_mm / count / cells_along_road, 2 * width_mm / count,
                      std::max(size.x, size.y) / cells_across_box});
  const auto side = [&](double mm) { return std::min(longest_side, std::bit_ceil(std::uint32_t(mm / cell_mm) + 1)); };
  columns = side(size.x);
  rows = side(size.y);
}

/// The cells that a road may touch, row by row.
template <class Visit>
void LayerSurface::Cells::for_cells(const SurfaceRoad& road, Visit visit) const {
  const Vec2 a = in_cells(road.a_mm), b = in_cells(road.b_mm);
  const double h = half_width_mm(road) / cell_mm + 1e-9;
  const auto first_row = std::int64_t(std::floor(std::min(a.y, b.y) - h));
  const auto last_row = std::int64_t(std::floor(std::max(a.y, b.y) + h));
  for (std::int64_t y = first_row; y <= last_row; ++y) {
    // The part of the centre line that is near enough to the row, and so much on either side.
    const Share near = share_between(a.y, b.y - a.y, double(y) - h, double(y + 1) + h);
    const double x0 = a.x + (b.x - a.x) * near.begin, x1 = a.x + (b.x - a.x) * near.end;
    const auto last = std::int64_t(std::floor(std::max(x0, x1) + h));
    for (auto x = std::int64_t(std::floor(std::min(x0, x1) - h)); x <= last; ++x) visit(bucket(x, y));
  }
}

void LayerSurface::Cells::fill() {
  first.assign(std::size_t(columns) * rows + 1, 0);
  for (const SurfaceRoad& r : roads) for_cells(r, [&](std::size_t b) { ++first[b]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first) f = sum += f;
  // From the last to the first: each bucket's roads come out in ascending order.
  entries.resize(sum);
  for (std::size_t i = roads.size(); i-- > 0;)
    for_cells(roads[i], [&](std::size_t b) { entries[--first[b]] = std::uint32_t(i); });
}

/// The cells that a way goes through, from one to the next.
template <class Visit>
void LayerSurface::Cells::for_cells(Vec2 a_mm, Vec2 b_mm, Visit visit) const {
  const Share in_x = share_between(a_mm.x, b_mm.x - a_mm.x, box.min.x, box.max.x);
  const Share in_y = share_between(a_mm.y, b_mm.y - a_mm.y, box.min.y, box.max.y);
  const double begin = std::max(in_x.begin, in_y.begin), end = std::min(in_x.end, in_y.end);
  if (begin > end) return;
  const Vec2 a = in_cells(lerp(a_mm, b_mm, begin)), b = in_cells(lerp(a_mm, b_mm, end)), d = b - a;
  std::int64_t x = std::int64_t(std::floor(a.x)), y = std::int64_t(std::floor(a.y));
  const std::int64_t to_x = std::int64_t(std::floor(b.x)), to_y = std::int64_t(std::floor(b.y));
  const int step_x = to_x > x ? 1 : -1, step_y = to_y > y ? 1 : -1;
  std::int64_t left_x = std::abs(to_x - x), left_y = std::abs(to_y - y);
  // When the way reaches the next column and the next row.
  const double each_x = left_x > 0 ? 1 / std::abs(d.x) : 0, each_y = left_y > 0 ? 1 / std::abs(d.y) : 0;
  double next_x = (step_x > 0 ? double(x + 1) - a.x : a.x - double(x)) * each_x;
  double next_y = (step_y > 0 ? double(y + 1) - a.y : a.y - double(y)) * each_y;
  visit(bucket(x, y));
  while (left_x > 0 || left_y > 0) {
    if (left_y == 0 || (left_x > 0 && next_x < next_y)) {
      x += step_x, next_x += each_x, --left_x;
    } else {
      y += step_y, next_y += each_y, --left_y;
    }
    visit(bucket(x, y));
  }
}

LayerSurface::LayerSurface(std::vector<SurfaceRoad> roads) : cells_(std::make_unique<Cells>()) {
  cells_->roads = std::move(roads);
  if (cells_->roads.empty()) return;
  cells_->size_up();
  cells_->fill();
}

LayerSurface::~LayerSurface() = default;
LayerSurface::LayerSurface(LayerSurface&&) noexcept = default;
LayerSurface& LayerSurface::operator=(LayerSurface&&) noexcept = default;

std::span<const SurfaceRoad> LayerSurface::roads() const {
  return cells_->roads;
}

namespace {

/// What is on top, from the begin of the way to its end. Takes the covers apart.
void envelope(SurfaceScratch& scratch, std::span<const SurfaceRoad> roads, std::vector<SurfacePiece>& pieces) {
  using Cover = SurfaceScratch::Cover;
  auto& covers = scratch.covers;
  auto& open = scratch.open;
  std::ranges::sort(
      covers, [](const Cover& a, const Cover& b) { return a.begin != b.begin ? a.begin < b.begin : a.road < b.road; });
  const auto below = [](const Cover& a, const Cover& b) {
    return a.rank != b.rank ? a.rank > b.rank : a.road > b.road;
  };
  open.clear();
  const std::size_t old_pieces = pieces.size();
  double at = 0;
  for (std::size_t next = 0; next < covers.size() || !open.empty();) {
    if (open.empty()) at = std::max(at, covers[next].begin);
    for (; next < covers.size() && covers[next].begin <= at; ++next) {
      open.push_back(covers[next]);
      std::ranges::push_heap(open, below);
    }
    const Cover top = open.front();
    if (top.end <= at) {
      std::ranges::pop_heap(open, below);
      open.pop_back();
      continue;
    }
    const double end = next < covers.size() ? std::min(top.end, covers[next].begin) : top.end;
    if (pieces.size() > old_pieces && pieces.back().road == top.road && pieces.back().end == float(at)) {
      pieces.back().end = float(end);
    } else if (float(end) > float(at)) {
      const SurfaceRoad& r = roads[top.road];
      pieces.push_back({float(at), float(end), r.nozzle, r.part, r.part && r.visible, top.road});
    }
    at = end;
  }
}

}  // namespace

void LayerSurface::along(const SurfaceWay& way, SurfaceScratch& scratch, std::vector<SurfacePiece>& pieces) const {
  const Cells& cells = *cells_;
  if (cells.roads.empty()) return;
  if (scratch.met.size() < cells.roads.size()) scratch.met.resize(cells.roads.size(), 0);
  if (++scratch.call == 0) {  // after 4 billion calls the marks of the first could be mistaken for ours
    std::ranges::fill(scratch.met, 0);
    scratch.call = 1;
  }
  scratch.covers.clear();
  cells.for_cells(way.a_mm, way.b_mm, [&](std::size_t bucket) {
    const std::uint32_t first = cells.first[bucket], last = cells.first[bucket + 1];
    scratch.work += 1 + last - first;
    for (std::uint32_t e = first; e < last; ++e) {
      const std::uint32_t i = cells.entries[e];
      if (scratch.met[i] == scratch.call) continue;
      scratch.met[i] = scratch.call;
      const SurfaceRoad& r = cells.roads[i];
      if (!r.part && r.drive_order >= way.move) continue;
      const Share s = share_over(way.a_mm, way.b_mm, r);
      if (s.end - s.begin > nothing) scratch.covers.push_back({s.begin, s.end, rank(r, way.nozzle), i});
    }
  });
  envelope(scratch, cells.roads, pieces);
}

}  // namespace cleancolor
