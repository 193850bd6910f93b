#include "base/open_rays.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace cleancolor {
namespace {

constexpr int period = 8;  // steps after which a ray is in the middle of a voxel again

/// So many voxels in `period` steps; the largest of the three is the period itself.
struct Direction {
  int x = 0, y = 0, z = 0;

  /// The voxel after so many steps; exact where steps is a multiple of the period.
  Direction after(int steps) const {
    const auto rounded = [&](int c) { return int(std::lround(double(c) * steps / period)); };
    return {rounded(x), rounded(y), rounded(z)};
  }
};

/// All permutations and signs of four triples. No part is 0 and no two are equal, so that no ray runs along a wall of
/// the grid or of its diagonals: as many rays pass on either side. Of all sets of four such triples with an 8 this one
/// counts random corners, caps and walls over a bed best (RMS of the share of a half sphere 0.030, 0.017, 0.017), and
/// has the fewest rays along any one upright wall.
std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (std::array<int, 3> c : {std::array{1, 2, 8}, {1, 5, 8}, {3, 7, 8}, {4, 5, 8}}) {
    do {
      for (int s = 0; s < 8; ++s) all.push_back({s & 1 ? -c[0] : c[0], s & 2 ? -c[1] : c[1], s & 4 ? -c[2] : c[2]});
    } while (std::next_permutation(c.begin(), c.end()));
  }
  return all;
}
constexpr int direction_count = 192;
constexpr std::size_t digits = 8;  // of counts up to 192

/// Share of a surface's rays that the steps of the grid stop where the surface itself is smooth: the mean over walls
/// and slopes of all angles (0 where they run along the grid).
constexpr double hidden_by_steps = 0.04;

/// Steps of a ray of this length.
int steps_of(const Direction& d, double reach_mm, double voxel_mm) {
  const double step_mm = voxel_mm * length(Vec3{double(d.x), double(d.y), double(d.z)}) / period;
  return std::max(1, int(std::lround(reach_mm / step_mm)));
}

/// Words [first, first + to.size()) of the string |= the string shifted: bit i |= bit i + shift of from.
void or_shifted(std::span<std::uint64_t> to, std::int64_t first, std::span<const std::uint64_t> from,
                std::int64_t shift) {
  const std::int64_t q = first + (shift >> 6), size = std::int64_t(from.size()), count = std::int64_t(to.size());
  const int r = int(shift & 63);
  // The words that need no look at the ends of the string.
  const std::int64_t begin = std::clamp<std::int64_t>(-q, 0, count), end = std::clamp(size - 1 - q, begin, count);
  for (std::int64_t i = 0; i < begin; ++i) to[std::size_t(i)] |= shifted_word(from, first + i, shift);
  for (std::int64_t i = end; i < count; ++i) to[std::size_t(i)] |= shifted_word(from, first + i, shift);
  std::uint64_t* const out = to.data();
  const std::uint64_t* const in = from.data() + q;
  if (r == 0)
    for (std::int64_t i = begin; i < end; ++i) out[i] |= in[i];
  else
    for (std::int64_t i = begin; i < end; ++i) out[i] |= in[i] >> r | in[i + 1] << (64 - r);
}

/// Where rays of one direction meet plastic, for all voxels at once. Works on pieces of the string that stay in the
/// cache, and leaves out those where nothing is.
class Rays {
 public:
  explicit Rays(const Voxels& v) : v_(v), met_(v.solid.size()), solid_pieces_(pieces()), met_pieces_(pieces()) {
    for (std::int64_t k = 0; k < pieces(); ++k) {
      const auto first = v.solid.begin() + k * piece;
      solid_pieces_[std::size_t(k)] = std::any_of(first, first + length(k), [](std::uint64_t w) { return w != 0; });
    }
  }

  /// Bit i: a ray of n steps from voxel i meets plastic (the bed not counted).
  const BitWords& met(const Direction& d, int n) {
    first_steps(d, std::min(n, period));
    int done = std::min(n, period);
    for (; 2 * done <= n; done *= 2) join(d.after(done));
    if (done < n) join(d.after(n - done));
    return met_;
  }

 private:
  static constexpr std::int64_t piece = 256;  // words

  std::int64_t pieces() const { return (std::int64_t(met_.size()) + piece - 1) / piece; }
  std::int64_t length(std::int64_t k) const { return std::min(piece, std::int64_t(met_.size()) - k * piece); }
  std::span<std::uint64_t> words(std::int64_t k) { return {met_.data() + k * piece, std::size_t(length(k))}; }
  std::int64_t shift(const Direction& d) const { return v_.index(d.x, d.y, d.z); }

  /// Whether one of the pieces that lie under piece k when it is shifted has anything.
  bool any(const std::vector<char>& has, std::int64_t k, std::int64_t shift) const {
    const std::int64_t q = k * piece + (shift >> 6);
    if (q + piece < 0 || q >= std::int64_t(met_.size())) return false;
    const std::int64_t first = std::max<std::int64_t>(q, 0) / piece;
    const std::int64_t last = std::min(pieces() - 1, (q + piece) / piece);
    return std::any_of(has.begin() + first, has.begin() + last + 1, [](char c) { return c != 0; });
  }

  void first_steps(const Direction& d, int n) {
    for (std::int64_t k = 0; k < pieces(); ++k) {
      char& has = met_pieces_[std::size_t(k)];
      const std::span<std::uint64_t> to = words(k);
      if (has) std::fill(to.begin(), to.end(), 0);
      has = 0;
      for (int i = 1; i <= n; ++i) {
        const std::int64_t by = shift(d.after(i));
        if (!any(solid_pieces_, k, by)) continue;
        or_shifted(to, k * piece, v_.solid, by);
        has = 1;
      }
    }
  }

  /// A ray that was as long as n steps goes on with the ray of the voxel d away. In place: pieces are done in the order
  /// in which they do not read what is done already.
  void join(const Direction& d) {
    const std::int64_t by = shift(d), count = pieces();
    std::array<std::uint64_t, piece> buffer;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t k = by > 0 ? i : count - 1 - i;
      if (!any(met_pieces_, k, by)) continue;
      const std::span<std::uint64_t> from = words(k), to(buffer.data(), from.size());
      std::copy(from.begin(), from.end(), to.begin());
      or_shifted(to, k * piece, met_, by);
      std::copy(to.begin(), to.end(), from.begin());
      met_pieces_[std::size_t(k)] = 1;
    }
  }

  const Voxels& v_;
  BitWords met_;
  std::vector<char> solid_pieces_, met_pieces_;  // whether any bit of the piece can be set
};

/// 64 counters in columns: digit k of counter b is bit b of word k.
using Counters = std::array<std::uint64_t, digits>;

void count(Counters& counters, std::uint64_t ones) {
  for (std::uint64_t& digit : counters) {
    const std::uint64_t carry = digit & ones;
    digit ^= ones;
    ones = carry;
  }
}

int counted(const Counters& counters, int b) {
  int n = 0;
  for (std::size_t k = 0; k < digits; ++k) n |= int(counters[k] >> b & 1) << k;
  return n;
}

/// A word of the grid with air that touches plastic.
struct SurfaceWord {
  std::int64_t word = 0;
  std::uint64_t bits = 0;
};

/// Open rays of all voxels of the surface, by every `stride`-th direction from `first` on.
std::vector<Counters> open_rays(const Voxels& v, std::span<const SurfaceWord> surface, std::span<const Direction> all,
                                double reach_mm, std::size_t first, std::size_t stride, const Progress& progress) {
  std::vector<Counters> open(surface.size(), Counters{});
  Rays rays(v);
  for (std::size_t k = first; k < all.size(); k += stride) {
    if (progress.interrupted()) throw Error("interrupted");
    const Direction d = all[k];
    const int n = steps_of(d, reach_mm, v.size_mm);
    const BitWords& met = rays.met(d, n);
    // The middle of level z is z + 0.5 voxels above the bed.
    const double falls = -double(d.z) * n / period;
    const int above_bed = int(std::clamp(std::ceil(falls - 0.5), 0., double(v.levels)));
    const std::int64_t begin = v.plane_bits / 64 * above_bed;
    auto at =
        std::partition_point(surface.begin(), surface.end(), [&](const SurfaceWord& s) { return s.word < begin; });
    for (; at != surface.end(); ++at)
      count(open[std::size_t(at - surface.begin())], at->bits & ~met[std::size_t(at->word)]);
  }
  return open;
}

}  // namespace

VoxelRange::VoxelRange(double c, double reach, int count) {
  c = std::clamp(c, -1e6, 1e9);
  first = std::max(0, int(std::ceil(c - reach - 0.5)));
  last = std::min(count - 1, int(std::floor(c + reach - 0.5)));
}

/// What lies around a point.
struct OpenRays::Near {
  double open = 0;  // weighted sum of the open rays of the surface
  double weight = 0;
  bool plastic = false;
};

int OpenRays::open_at(std::int64_t i) const {
  const std::uint64_t below = surface_[std::size_t(i >> 6)] & ((std::uint64_t(1) << (i & 63)) - 1);
  return open_[first_[std::size_t(i >> 6)] + std::size_t(std::popcount(below))];
}

/// Voxels of the surface weigh the more the nearer their middle is to p (in voxels): the mean over a width of 3.5
/// voxels, so that the steps of slanting walls even out.
OpenRays::Near OpenRays::near(Vec3 p) const {
  constexpr double reach = 1.75;
  const auto weight = [&](double c, int i) { return reach - std::abs(i + 0.5 - c); };
  const VoxelRange x(p.x, reach, voxels_.columns), y(p.y, reach, voxels_.rows), z(p.z, reach, voxels_.levels);
  Near near;
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j) {
      const std::int64_t row = voxels_.index(0, j, k);
      for_bits(voxels_.solid, row, x, [&](int) { near.plastic = true; });
      for_bits(surface_, row, x, [&](int i) {
        const double w = weight(p.x, i) * weight(p.y, j) * weight(p.z, k);
        near.open += w * open_at(row + i);
        near.weight += w;
      });
    }
  return near;
}

OpenRays::OpenRays(Voxels voxels, double reach_mm, int threads, const Progress& progress, const ViewBias& view)
    : voxels_(std::move(voxels)), surface_(voxels_.solid.size()), first_(voxels_.solid.size()) {
  std::vector<SurfaceWord> found;
  std::uint32_t values = 0;
  for (std::size_t w = 0; w < surface_.size(); ++w) {
    surface_[w] = voxels_.surface(std::int64_t(w));
    first_[w] = values;
    values += std::uint32_t(std::popcount(surface_[w]));
    if (surface_[w] != 0) found.push_back({std::int64_t(w), surface_[w]});
  }
  open_.resize(values);

  // Each worker needs a string and counters of its own: few where these are large.
  const double worker_mb = double(voxels_.solid.size()) * 8e-6 + double(found.size() * sizeof(Counters)) * 1e-6;
  const int workers = std::clamp(int(60 / std::max(worker_mb, 1e-3)), 1, std::clamp(thread_count(threads), 1, 16));
  const auto add = [&](std::span<const Direction> rays, double share) {
    std::vector<std::vector<Counters>> open{std::size_t(workers)};
    parallel_for(workers, threads, [&](int i) {
      open[std::size_t(i)] = open_rays(voxels_, found, rays, reach_mm, std::size_t(i), std::size_t(workers), progress);
    });
    std::size_t value = 0;
    for (std::size_t s = 0; s < found.size(); ++s)
      for (std::uint64_t bits = found[s].bits; bits != 0; bits &= bits - 1, ++value) {
        int sum = 0;
        for (const auto& part : open) sum += counted(part[s], std::countr_zero(bits));
        open_[value] += std::uint8_t(std::lround(share * sum));
      }
  };
  std::vector<Direction> all = directions();
  const auto leads_there = [&](const Direction& d) {
    return view.weight <= 0 || dot(view.from, {double(d.x), double(d.y)}) > 0;
  };
  const auto away = std::stable_partition(all.begin(), all.end(), leads_there);
  add({all.begin(), away}, 1);
  if (away != all.end()) add({away, all.end()}, 1 - view.weight);
}

double OpenRays::at(Vec3 p_mm) const {
  if (voxels_.levels == 0) return 1;
  const Near n = near((p_mm - voxels_.origin_mm) * (1 / voxels_.size_mm));
  if (n.weight == 0) return n.plastic ? 0 : 1;
  return std::min(1., 2 / (1 - hidden_by_steps) * n.open / (n.weight * direction_count));
}

}  // namespace cleancolor
