#include "audit/exposed.hpp"

#include <algorithm>
#include <cmath>

#include "audit/part_voxels.hpp"

namespace cleancolor {
namespace {

constexpr double most_field_cells = 4e6, least_cells = 3e5,
                 cells_per_road = 5e3;  // few roads far apart get larger cells
constexpr double least_wipe_area_mm2 = 0.03;
constexpr double place_spacing_mm = 1;  // where a road is asked whether it faces the outside
constexpr int most_places = 64;

double half_width_mm(const LabelledRoad& r) {
  return std::clamp(double(r.width_mm), 0., widest_road_mm) / 2;
}

/// |= each cell's four neighbours, so often.
BitWords grown(const BitWords& cells, std::int64_t row_bits) {
  BitWords all = cells;
  for (std::size_t w = 0; w < all.size(); ++w)
    for (const std::int64_t shift : {std::int64_t(1), std::int64_t(-1), row_bits, -row_bits})
      all[w] |= shifted_word(cells, std::int64_t(w), shift);
  return all;
}

/// Whether at least half of the places along a road satisfy the condition.
template <class Condition>
bool mostly(const LabelledRoad& r, Condition condition) {
  const double l = distance(r.a_mm, r.b_mm);
  const int places = std::clamp(int(l / place_spacing_mm), 1, most_places);
  int yes = 0;
  for (int i = 0; i < places; ++i) yes += condition(lerp(r.a_mm, r.b_mm, (i + 0.5) / places));
  return 2 * yes >= places;
}

/// One of its sides faces the outside of the layer.
bool outermost(const LabelledRoad& r, const PartOutline& outline) {
  const double l = distance(r.a_mm, r.b_mm);
  const Vec2 along = l > 0 ? (r.b_mm - r.a_mm) * (1 / l) : Vec2{1, 0};
  // Three quarters of a cell beside the road lies no cell that its own plastic covers.
  const Vec2 aside = Vec2{-along.y, along.x} * (half_width_mm(r) + 0.75 * outline.cell_mm());
  return mostly(r, [&](Vec2 p) { return !outline.contains(p + aside) || !outline.contains(p - aside); });
}

bool open_top(const LabelledRoad& r, const PartOutline& above) {
  return mostly(r, [&](Vec2 p) { return !above.contains(p); });
}

}  // namespace

PartOutline::PartOutline(std::span<const LabelledRoad> roads) {
  Box<Vec2> box;
  for (const LabelledRoad& r : roads) {
    if (is_auxiliary(r.role)) continue;
    const double half = half_width_mm(r);
    for (const Vec2 p : {r.a_mm, r.b_mm}) {
      box.add(p - Vec2{half, half});
      box.add(p + Vec2{half, half});
    }
  }
  if (box.empty()) return;

  // Two empty cells around the part, one of which the closing of gaps may take.
  constexpr int border = 2;
  const double allowed = std::clamp(cells_per_road * double(roads.size()), least_cells, most_field_cells);
  for (;; cell_mm_ *= 1.05) {
    const double columns = std::ceil(box.size().x / cell_mm_) + 1 + 2 * border;
    const double rows = std::ceil(box.size().y / cell_mm_) + 1 + 2 * border;
    if (columns * rows > allowed) continue;
    columns_ = int(columns), rows_ = int(rows);
    break;
  }
  row_bits_ = columns_;
  origin_mm_ = box.min - Vec2{border * cell_mm_, border * cell_mm_};

  BitWords plastic(std::size_t((row_bits_ * rows_ + 63) / 64));
  std::vector<CellSpan> spans;
  for (const LabelledRoad& r : roads) {
    if (is_auxiliary(r.role)) continue;
    spans.clear();
    cells_of_road(
        {(r.a_mm - origin_mm_) * (1 / cell_mm_), (r.b_mm - origin_mm_) * (1 / cell_mm_), half_width_mm(r) / cell_mm_},
        columns_ - border, rows_ - border, spans);
    for (const CellSpan& s : spans) fill_bits(plastic, row_bits_ * s.y + s.first, row_bits_ * s.y + s.last, true);
  }

  // Flooded from the border past plastic that is a cell thicker; then the outside takes back the cell.
  const BitWords closed = grown(plastic, row_bits_);
  BitWords flooded(plastic.size());
  fill_bits(flooded, 0, row_bits_ - 1, true);
  flood(flooded, closed, row_bits_, 0);
  outside_ = grown(flooded, row_bits_);
  for (std::size_t w = 0; w < outside_.size(); ++w) outside_[w] &= ~plastic[w];
}

bool PartOutline::contains(Vec2 p_mm) const {
  const Vec2 p = (p_mm - origin_mm_) * (1 / cell_mm_);
  if (!(p.x >= 0 && p.y >= 0 && p.x < columns_ && p.y < rows_)) return false;
  return !bit(outside_, row_bits_ * std::int64_t(p.y) + std::int64_t(p.x));
}

std::vector<Exposure> exposures(std::span<const LabelledRoad> roads, const PartOutline& outline,
                                const PartOutline& above, ExposedBy by) {
  std::vector<Exposure> all(roads.size());
  for (std::size_t i = 0; i < roads.size(); ++i) {
    const LabelledRoad& r = roads[i];
    Exposure& e = all[i];
    if (is_auxiliary(r.role)) {
      e.wipes = double(r.area_mm2) >= least_wipe_area_mm2 && mostly(r, [&](Vec2 p) { return !outline.contains(p); });
      continue;
    }
    const bool labels = by != ExposedBy::geometry, geometry = by != ExposedBy::labels;
    e.outer = labels && r.role == Role::external_perimeter;
    if (!e.outer && (geometry || r.role == Role::overhang_perimeter)) e.outer = outermost(r, outline);
    e.visible = e.outer || (labels && (r.role == Role::top_solid_infill || r.role == Role::ironing)) ||
                (geometry && open_top(r, above));
  }
  return all;
}

}  // namespace cleancolor
