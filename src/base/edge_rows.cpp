#include "base/edge_rows.hpp"

#include <algorithm>
#include <limits>

namespace cleancolor {
namespace {

// Pieces shorter than this are rounding at a border, not lines.
constexpr double shortest_mm = 1e-6;

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  return distance(p, nearest_on_segment(a, b, p));
}

}  // namespace

EdgeRows::EdgeRows(const std::vector<std::vector<Vec2>>& rings) {
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i)
      edges_.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], int(r), std::uint32_t(i)});
  sort_into_rows();
}

EdgeRows::EdgeRows(const Polygons& region) {
  for (std::size_t r = 0; r < region.size(); ++r)
    for (std::size_t i = 0; i < region[r].size(); ++i)
      edges_.push_back({to_mm(region[r][i]), to_mm(region[r][(i + 1) % region[r].size()]), int(r), std::uint32_t(i)});
  sort_into_rows();
}

void EdgeRows::sort_into_rows() {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Edge& e : edges_) {
    low = std::min({low, e.a.y, e.b.y});
    high = std::max({high, e.a.y, e.b.y});
  }
  if (edges_.empty()) low = high = 0;
  // About as many rows as edges keeps both the rows short and the lists of long edges bounded.
  const int rows = std::clamp(int(edges_.size()) / 2, 1, 1000);
  y0_ = low;
  height_mm_ = std::max((high - low) / rows, 1e-6);
  first_.assign(std::size_t(rows) + 2, 0);
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<std::uint32_t> next(first_.begin(), first_.end());
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      const auto [from, to] = std::minmax({row(edges_[i].a.y), row(edges_[i].b.y)});
      for (int r = from; r <= to; ++r) {
        if (pass == 0)
          ++first_[std::size_t(r) + 1];
        else
          in_row_[next[std::size_t(r)]++] = i;
      }
    }
    if (pass == 1) break;
    for (std::size_t r = 1; r < first_.size(); ++r) first_[r] += first_[r - 1];
    in_row_.resize(first_.back());
  }
}

int EdgeRows::row(double y) const {
  return int(std::clamp((y - y0_) / height_mm_, 0.0, double(first_.size()) - 2));
}

void EdgeRows::crossings(Vec2 a, Vec2 b, std::vector<double>& at) const {
  const Vec2 d = b - a;
  const auto [min_x, max_x] = std::minmax({a.x, b.x});
  const auto [from, to] = std::minmax({row(a.y), row(b.y)});
  const std::size_t begin = at.size();
  for (int r = from; r <= to; ++r)
    for (std::uint32_t i = first_[std::size_t(r)]; i < first_[std::size_t(r) + 1]; ++i) {
      const Edge& edge = edges_[in_row_[i]];
      if ((edge.a.x < min_x && edge.b.x < min_x) || (edge.a.x > max_x && edge.b.x > max_x)) continue;
      const Vec2 e = edge.b - edge.a;
      const double denominator = cross(d, e);
      if (denominator == 0) continue;
      const double t = cross(edge.a - a, e) / denominator;
      const double u = cross(edge.a - a, d) / denominator;
      if (t > 0 && t < 1 && u >= 0 && u <= 1) at.push_back(t);
    }
  // An edge that touches several rows is met in each of them.
  std::sort(at.begin() + std::ptrdiff_t(begin), at.end());
  at.erase(std::unique(at.begin() + std::ptrdiff_t(begin), at.end()), at.end());
}

bool EdgeRows::contains(Vec2 p) const {
  bool inside = false;
  const int r = row(p.y);
  for (std::uint32_t i = first_[std::size_t(r)]; i < first_[std::size_t(r) + 1]; ++i) {
    const Edge& e = edges_[in_row_[i]];
    if ((e.a.y <= p.y) == (e.b.y <= p.y)) continue;
    if (e.a.x + (e.b.x - e.a.x) * (p.y - e.a.y) / (e.b.y - e.a.y) > p.x) inside = !inside;
  }
  return inside;
}

const EdgeRows::Edge* EdgeRows::nearest(Vec2 p, double within_mm) const {
  const Edge* best = nullptr;
  double least = within_mm;
  for (int r = row(p.y - within_mm); r <= row(p.y + within_mm); ++r)
    for (std::uint32_t i = first_[std::size_t(r)]; i < first_[std::size_t(r) + 1]; ++i) {
      const Edge& e = edges_[in_row_[i]];
      const double d = distance_to_segment(p, e.a, e.b);
      if (d < least || (d == least && !best)) least = d, best = &e;
    }
  return best;
}

std::vector<std::vector<Vec2>> EdgeRows::clipped(const std::vector<Vec2>& line) const {
  std::vector<std::vector<Vec2>> result;
  std::vector<double> cuts;
  bool inside = false;  // does the piece at hand continue the last line of the result?
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i], b = line[i + 1];
    cuts.assign({0.0});
    crossings(a, b, cuts);
    cuts.push_back(1);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      const Vec2 from = lerp(a, b, cuts[c]), to = lerp(a, b, cuts[c + 1]);
      // Without a crossing nothing changes; after one, ask.
      const bool here = i > 0 && c == 0 ? inside : contains(lerp(from, to, 0.5));
      if (here && !inside) result.push_back({from});
      if (here) result.back().push_back(to);
      inside = here;
    }
  }
  std::erase_if(result, [](const std::vector<Vec2>& piece) {
    return distance(piece.front(), piece.back()) < shortest_mm && piece.size() < 3;
  });
  return result;
}

}  // namespace cleancolor
