#include "slice/shared_border.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cleancolor {
namespace {

bool less(const Point& a, const Point& b) {
  return std::pair(a.X, a.Y) < std::pair(b.X, b.Y);
}

/// For each point of the layer, the set of regions (as bits; from the 64th on they share one) that have it.
class Owners {
 public:
  explicit Owners(const std::vector<Polygons>& regions) {
    for (std::size_t r = 0; r < regions.size(); ++r)
      for (const Ring& ring : regions[r])
        for (const Point& p : ring) entries_.push_back({p, std::uint64_t(1) << std::min<std::size_t>(r, 63)});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return less(a.point, b.point); });
    std::size_t n = 0;
    for (const Entry& e : entries_) {
      if (n > 0 && entries_[n - 1].point == e.point)
        entries_[n - 1].regions |= e.regions;
      else
        entries_[n++] = e;
    }
    entries_.resize(n);
  }

  std::uint64_t of(const Point& p) const {
    return std::lower_bound(entries_.begin(), entries_.end(), p,
                            [](const Entry& e, const Point& q) { return less(e.point, q); })
        ->regions;
  }

 private:
  struct Entry {
    Point point;
    std::uint64_t regions;
  };
  std::vector<Entry> entries_;
};

/// Indices of the points that must stay: both ends of every shared run, or, without any, the smallest point and the one
/// farthest from it. At least two for a ring of three points or more.
std::vector<std::size_t> anchors(const Ring& ring, const Owners* owners) {
  std::vector<std::size_t> result;
  const std::size_t n = ring.size();
  if (owners) {
    std::vector<std::uint64_t> sets(n);
    for (std::size_t i = 0; i < n; ++i) sets[i] = owners->of(ring[i]);
    // A run is shared by the regions that have both ends of its segments; where a neighbour lacks one, the run ends
    // here.
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t next = sets[(i + 1) % n], before = sets[(i + n - 1) % n];
      if ((sets[i] & ~next) || (sets[i] & ~before)) result.push_back(i);
    }
  }
  if (result.size() >= 2) return result;
  const std::size_t low =
      result.empty() ? std::size_t(std::min_element(ring.begin(), ring.end(), less) - ring.begin()) : result.front();
  std::size_t far = low;
  double farthest = -1;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = std::hypot(double(ring[i].X - ring[low].X), double(ring[i].Y - ring[low].Y));
    if (d > farthest || (d == farthest && less(ring[i], ring[far]))) farthest = d, far = i;
  }
  if (far == low) return {low};
  return {std::min(low, far), std::max(low, far)};
}

Ring thinned(const Ring& ring, const Owners* owners, double tolerance_mm) {
  const std::vector<std::size_t> stay = anchors(ring, owners);
  if (stay.size() < 2) return {};
  Ring result;
  for (std::size_t k = 0; k < stay.size(); ++k) {
    // One run from anchor to anchor, always looked at from its smaller end.
    std::vector<Vec2> run;
    const std::size_t from = stay[k], to = stay[(k + 1) % stay.size()];
    for (std::size_t i = from;; i = (i + 1) % ring.size()) {
      run.push_back({double(ring[i].X), double(ring[i].Y)});
      if (i == to) break;
    }
    const bool backwards = less(ring[to], ring[from]);
    if (backwards) std::reverse(run.begin(), run.end());
    run = simplified(run, tolerance_mm * nm_per_mm);
    if (backwards) std::reverse(run.begin(), run.end());
    for (std::size_t i = 0; i + 1 < run.size(); ++i) result.push_back({std::int64_t(run[i].x), std::int64_t(run[i].y)});
  }
  return result;
}

}  // namespace

std::vector<Polygons> simplified_together(const std::vector<Polygons>& regions, double tolerance_mm) {
  const auto filled = std::count_if(regions.begin(), regions.end(), [](const Polygons& r) { return !r.empty(); });
  std::vector<Polygons> result(regions.size());
  const Owners owners(filled > 1 ? regions : std::vector<Polygons>{});
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const Ring& ring : regions[r]) {
      Ring thin = thinned(ring, filled > 1 ? &owners : nullptr, tolerance_mm);
      if (thin.size() >= 3) result[r].push_back(std::move(thin));
    }
  return result;
}

}  // namespace cleancolor
