#include "model/weld.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace cleancolor {

namespace {

std::uint64_t mixed(std::uint64_t h) {
  // The finalizer of MurmurHash3: every input bit reaches every output bit.
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

std::uint64_t hash(const Vec3& p) {
  const auto x = std::bit_cast<std::uint64_t>(p.x);
  const auto y = std::bit_cast<std::uint64_t>(p.y);
  const auto z = std::bit_cast<std::uint64_t>(p.z);
  return mixed(x + 0x9e3779b97f4a7c15ULL * (y + 0x9e3779b97f4a7c15ULL * mixed(z)));
}

/// The cell of a grid, as one number; cells that share a number only cost a comparison more.
std::uint64_t cell_hash(std::int64_t x, std::int64_t y, std::int64_t z) {
  return mixed(std::uint64_t(x) * 73856093U ^ mixed(std::uint64_t(y) * 19349663U ^ mixed(std::uint64_t(z))));
}

}  // namespace

ExactWelder::ExactWelder(std::size_t expected_points) {
  points_.reserve(expected_points);
  slots_.resize(std::bit_ceil(std::max<std::size_t>(64, expected_points * 2)));
}

std::size_t ExactWelder::slot_of(const Vec3& p) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(p) & mask;
  while (slots_[slot] != 0 && !(points_[slots_[slot] - 1] == p)) slot = (slot + 1) & mask;
  return slot;
}

std::uint32_t ExactWelder::add(Vec3 p) {
  p = p + Vec3{};  // -0 + 0 is 0
  std::size_t slot = slot_of(p);
  if (slots_[slot] != 0) return slots_[slot] - 1;
  if ((points_.size() + 1) * 2 > slots_.size()) {
    grow();
    slot = slot_of(p);
  }
  points_.push_back(p);
  slots_[slot] = std::uint32_t(points_.size());
  return slots_[slot] - 1;
}

void ExactWelder::grow() {
  slots_.assign(slots_.size() * 2, 0);
  for (std::size_t i = 0; i < points_.size(); ++i) slots_[slot_of(points_[i])] = std::uint32_t(i + 1);
}

std::vector<std::uint32_t> merged_within(const std::vector<Vec3>& points, const std::vector<char>& candidate,
                                         double tolerance_mm) {
  std::vector<std::uint32_t> into(points.size());
  std::iota(into.begin(), into.end(), 0U);
  const auto count = std::size_t(std::count(candidate.begin(), candidate.end(), char(1)));

  // A grid of cells as wide as the tolerance: whatever is near lies in the same cell or one of its 26 neighbours.
  // Each cell holds a list of the points that stayed, chained through `next`.
  std::vector<std::uint32_t> first(std::bit_ceil(std::max<std::size_t>(64, count * 2)), 0);
  std::vector<std::uint32_t> next(points.size(), 0);
  const std::uint64_t mask = first.size() - 1;
  const auto cell = [&](double v) { return std::int64_t(std::floor(v / tolerance_mm)); };
  const auto find = [&](const Vec3& p) -> std::uint32_t {
    for (std::int64_t x = cell(p.x) - 1; x <= cell(p.x) + 1; ++x)
      for (std::int64_t y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y)
        for (std::int64_t z = cell(p.z) - 1; z <= cell(p.z) + 1; ++z)
          for (std::uint32_t i = first[cell_hash(x, y, z) & mask]; i != 0; i = next[i - 1])
            if (distance(points[i - 1], p) <= tolerance_mm) return i;
    return 0;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!candidate[i]) continue;
    if (const std::uint32_t found = find(points[i]); found != 0) {
      into[i] = found - 1;
      continue;
    }
    auto& head = first[cell_hash(cell(points[i].x), cell(points[i].y), cell(points[i].z)) & mask];
    next[i] = head;
    head = std::uint32_t(i + 1);
  }
  return into;
}

}  // namespace cleancolor
