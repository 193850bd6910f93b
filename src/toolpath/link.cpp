#include "toolpath/link.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace cleancolor {
namespace {

/// One end of one line. Ends are numbered 2 x line (first) and 2 x line + 1 (last).
struct End {
  Border::Place place;
  int id = 0;
};

/// The arc from one end forwards to the next one on the same ring.
struct Arc {
  int a = 0, b = 0;  // ends
  double length_mm = 0;
  bool zigzag = false;
};

std::vector<Arc> arcs(const std::vector<BorderLine>& lines, const Border& border, double max_link_mm) {
  std::vector<End> ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ends.push_back({lines[i].first, int(2 * i)});
    ends.push_back({lines[i].last, int(2 * i + 1)});
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::tuple(a.place.ring, a.place.along_mm, a.id) < std::tuple(b.place.ring, b.place.along_mm, b.id);
  });
  std::vector<Arc> result;
  for (std::size_t i = 0; i < ends.size();) {
    std::size_t j = i;
    while (j < ends.size() && ends[j].place.ring == ends[i].place.ring) ++j;
    for (std::size_t k = i; k < j && j - i > 1; ++k) {
      const End &a = ends[k], &b = ends[k + 1 < j ? k + 1 : i];
      double arc = b.place.along_mm - a.place.along_mm;
      if (k + 1 == j) arc += border.perimeter_mm(a.place.ring);
      if (arc > max_link_mm || a.id / 2 == b.id / 2) continue;
      // A zigzag joins row 2n to 2n + 1 at their last ends and 2n + 1 to 2n + 2 at their first ones.
      const int row_a = lines[std::size_t(a.id / 2)].row, row_b = lines[std::size_t(b.id / 2)].row;
      const bool same_side = a.id % 2 == b.id % 2;
      const bool zigzag =
          same_side && std::abs(row_a - row_b) == 1 && (std::min(row_a, row_b) % 2 == 0) == (a.id % 2 == 1);
      result.push_back({a.id, b.id, arc, zigzag});
    }
    i = j;
  }
  std::stable_sort(result.begin(), result.end(), [](const Arc& x, const Arc& y) {
    return std::tuple(!x.zigzag, x.length_mm) < std::tuple(!y.zigzag, y.length_mm);
  });
  return result;
}

int root(std::vector<int>& parent, int i) {
  while (parent[std::size_t(i)] != i) i = parent[std::size_t(i)] = parent[std::size_t(parent[std::size_t(i)])];
  return i;
}

}  // namespace

Border::Border(const std::vector<std::vector<Vec2>>& rings) : rings_(rings) {
  for (const auto& ring : rings) {
    std::vector<double> along{0};
    for (std::size_t i = 0; i < ring.size(); ++i)
      along.push_back(along.back() + distance(ring[i], ring[(i + 1) % ring.size()]));
    along_.push_back(std::move(along));
  }
}

Border::Place Border::place(int ring, std::size_t edge, Vec2 on_edge) const {
  const auto r = std::size_t(ring);
  return {ring, along_[r][edge] + distance(rings_[r][edge], on_edge)};
}

std::vector<Vec2> Border::between(int ring, double from_mm, double to_mm) const {
  const auto& along = along_[std::size_t(ring)];
  const auto& points = rings_[std::size_t(ring)];
  std::vector<Vec2> result;
  const auto take = [&](double from, double to) {
    for (auto i = std::size_t(std::upper_bound(along.begin(), along.end(), from) - along.begin());
         i < points.size() && along[i] < to; ++i)
      result.push_back(points[i]);
  };
  if (from_mm <= to_mm) {
    take(from_mm, to_mm);
  } else {
    take(from_mm, along.back());
    if (to_mm > 0) result.push_back(points.front());
    take(0, to_mm);
  }
  return result;
}

std::vector<std::vector<Vec2>> linked(std::vector<BorderLine> lines, const Border& border, double max_link_mm) {
  // Choose the arcs: every end at most once, never both ends of one chain.
  std::vector<int> chain(lines.size());
  std::iota(chain.begin(), chain.end(), 0);
  struct Link {
    int to = -1;
    bool forwards = true;  // along the ring from here to there
  };
  std::vector<Link> links(2 * lines.size());
  for (const Arc& arc : arcs(lines, border, max_link_mm)) {
    if (links[std::size_t(arc.a)].to >= 0 || links[std::size_t(arc.b)].to >= 0) continue;
    const int x = root(chain, arc.a / 2), y = root(chain, arc.b / 2);
    if (x == y) continue;
    chain[std::size_t(std::max(x, y))] = std::min(x, y);
    links[std::size_t(arc.a)] = {arc.b, true};
    links[std::size_t(arc.b)] = {arc.a, false};
  }

  // Walk each chain from the free end with the smallest number.
  std::vector<std::vector<Vec2>> result;
  std::vector<char> used(lines.size(), 0);
  for (int start = 0; start < int(links.size()); ++start) {
    if (links[std::size_t(start)].to >= 0 || used[std::size_t(start / 2)]) continue;
    std::vector<Vec2> path;
    for (int end = start; end >= 0;) {
      BorderLine& line = lines[std::size_t(end / 2)];
      used[std::size_t(end / 2)] = 1;
      if (end % 2 == 0)
        path.insert(path.end(), line.points.begin(), line.points.end());
      else
        path.insert(path.end(), line.points.rbegin(), line.points.rend());
      const int out = end ^ 1;
      const Link link = links[std::size_t(out)];
      if (link.to < 0) break;
      const auto place_of = [&](int e) {
        return e % 2 ? lines[std::size_t(e / 2)].last : lines[std::size_t(e / 2)].first;
      };
      const Border::Place from = place_of(link.forwards ? out : link.to), to = place_of(link.forwards ? link.to : out);
      std::vector<Vec2> arc = border.between(from.ring, from.along_mm, to.along_mm);
      if (!link.forwards) std::reverse(arc.begin(), arc.end());
      path.insert(path.end(), arc.begin(), arc.end());
      end = link.to;
    }
    result.push_back(std::move(path));
  }
  return result;
}

}  // namespace cleancolor
