#include "audit/visibility.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <optional>
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
std::vector<Counters> open_rays(const Voxels& v, std::span<const SurfaceWord> surface, double reach_mm,
                                std::size_t first, std::size_t stride, const Progress& progress) {
  std::vector<Counters> open(surface.size(), Counters{});
  const std::vector<Direction> all = directions();
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

/// What lies around a point.
struct Near {
  double open = 0;  // weighted sum of the open rays of the surface
  double weight = 0;
  bool plastic = false;
};

struct PrintedVisibility::Grid {
  Voxels fine;                       // shows which roads are bare
  double depth_mm = 0;               // of the centre line of a bare road below the fine air
  Voxels rays;                       // coarser
  BitWords surface;                  // air that touches plastic, of `rays`
  std::vector<std::uint32_t> first;  // by word: where its values begin
  std::vector<std::uint8_t> open;    // open rays of each voxel of the surface, in the order of their bits

  std::vector<SurfaceWord> find_surface();
  std::optional<Vec3> next_air(Vec3 p_mm) const;
  Near near(Vec3 p) const;
  int open_at(std::int64_t i) const {
    const std::uint64_t below = surface[std::size_t(i >> 6)] & ((std::uint64_t(1) << (i & 63)) - 1);
    return open[first[std::size_t(i >> 6)] + std::size_t(std::popcount(below))];
  }
};

namespace {

/// Voxels of an axis whose middle is at most reach (in voxels) from c.
struct Range {
  int first, last;
  Range(double c, double reach, int count) {
    c = std::clamp(c, -1e6, 1e9);
    first = std::max(0, int(std::ceil(c - reach - 0.5)));
    last = std::min(count - 1, int(std::floor(c + reach - 0.5)));
  }
};

/// Calls visit(x) for the bits set in columns [first, last] of the row that begins at bit `row`; at most 64 columns.
template <class Visit>
void for_bits(const BitWords& words, std::int64_t row, Range x, Visit visit) {
  if (x.first > x.last) return;
  std::uint64_t bits = shifted_word(words, 0, row + x.first);
  bits &= ~std::uint64_t(0) >> (63 - (x.last - x.first));
  for (; bits != 0; bits &= bits - 1) visit(x.first + std::countr_zero(bits));
}

}  // namespace

/// The point itself where it lies in the air, else the middle of the nearest fine voxel of air if that is near enough.
std::optional<Vec3> PrintedVisibility::Grid::next_air(Vec3 p_mm) const {
  const Vec3 p = (p_mm - fine.origin_mm) * (1 / fine.size_mm);
  const double inside = std::min({p.x, p.y, p.z, fine.columns - p.x, fine.rows - p.y, fine.levels - p.z});
  if (!(inside > 0) || bit(fine.outside, fine.index(int(p.x), int(p.y), int(p.z)))) return p_mm;
  const double reach = depth_mm / fine.size_mm;
  const Range x(p.x, reach, fine.columns), y(p.y, reach, fine.rows), z(p.z, reach, fine.levels);
  double best = reach * reach;
  std::optional<Vec3> found;
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j)
      for_bits(fine.outside, fine.index(0, j, k), x, [&](int i) {
        const Vec3 middle{i + 0.5, j + 0.5, k + 0.5};
        const double d = dot(middle - p, middle - p);
        if (d > best || (found && d == best)) return;
        best = d;
        found = middle;
      });
  if (found) found = *found * fine.size_mm + fine.origin_mm;
  return found;
}

/// Voxels of the surface weigh the more the nearer their middle is to p (in voxels): the mean over a width of 3.5
/// voxels, so that the steps of slanting walls even out.
Near PrintedVisibility::Grid::near(Vec3 p) const {
  constexpr double reach = 1.75;
  const auto weight = [&](double c, int i) { return reach - std::abs(i + 0.5 - c); };
  const Range x(p.x, reach, rays.columns), y(p.y, reach, rays.rows), z(p.z, reach, rays.levels);
  Near near;
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j) {
      const std::int64_t row = rays.index(0, j, k);
      for_bits(rays.solid, row, x, [&](int) { near.plastic = true; });
      for_bits(surface, row, x, [&](int i) {
        const double w = weight(p.x, i) * weight(p.y, j) * weight(p.z, k);
        near.open += w * open_at(row + i);
        near.weight += w;
      });
    }
  return near;
}

/// Fills surface and first.
std::vector<SurfaceWord> PrintedVisibility::Grid::find_surface() {
  std::vector<SurfaceWord> found;
  surface.resize(rays.solid.size());
  first.resize(rays.solid.size());
  std::uint32_t values = 0;
  for (std::size_t w = 0; w < surface.size(); ++w) {
    surface[w] = rays.surface(std::int64_t(w));
    first[w] = values;
    values += std::uint32_t(std::popcount(surface[w]));
    if (surface[w] != 0) found.push_back({std::int64_t(w), surface[w]});
  }
  open.resize(values);
  return found;
}

PrintedVisibility::PrintedVisibility(int layers, const PartLayers& layer, const VisibilityOptions& options, int threads,
                                     const Progress& progress)
    : grid_(std::make_unique<Grid>()) {
  Grid& g = *grid_;
  {
    const PartRoads part = part_roads(layers, layer, threads, progress);
    g.fine = cleancolor::voxels(part, {.size_mm = options.fine_mm, .most = 2e8}, threads, progress);
    // Further away than its own half and a good voxel is the air only where another road lies in front of this one.
    g.depth_mm = part.mean_width_mm / 2 + 1.25 * g.fine.size_mm;
    g.fine.solid = {};
    g.rays = cleancolor::voxels(
        part, {.size_mm = options.voxel_mm, .reach_mm = options.reach_mm, .most = 6e7, .nozzles = true}, threads,
        progress);
  }
  const std::vector<SurfaceWord> surface = g.find_surface();

  // Each worker needs a string and counters of its own: few where these are large.
  const double worker_mb = double(g.rays.solid.size()) * 8e-6 + double(surface.size() * sizeof(Counters)) * 1e-6;
  const int workers = std::clamp(int(60 / std::max(worker_mb, 1e-3)), 1, std::clamp(thread_count(threads), 1, 16));
  std::vector<std::vector<Counters>> open{std::size_t(workers)};
  parallel_for(workers, threads, [&](int i) {
    open[std::size_t(i)] = open_rays(g.rays, surface, options.reach_mm, std::size_t(i), std::size_t(workers), progress);
  });

  std::size_t value = 0;
  for (std::size_t s = 0; s < surface.size(); ++s)
    for (std::uint64_t bits = surface[s].bits; bits != 0; bits &= bits - 1, ++value)
      for (const auto& part : open) g.open[value] += std::uint8_t(counted(part[s], std::countr_zero(bits)));
}

PrintedVisibility::~PrintedVisibility() = default;
PrintedVisibility::PrintedVisibility(PrintedVisibility&&) noexcept = default;

double PrintedVisibility::voxel_mm() const {
  return grid_->rays.size_mm;
}

double PrintedVisibility::at(Vec3 p_mm) const {
  const Grid& g = *grid_;
  if (g.rays.levels == 0) return 1;
  const std::optional<Vec3> air_mm = g.next_air(p_mm);
  if (!air_mm) return 0;
  const Near near = g.near((*air_mm - g.rays.origin_mm) * (1 / g.rays.size_mm));
  if (near.weight == 0) return near.plastic ? 0 : 1;
  return std::min(1., 2 / (1 - hidden_by_steps) * near.open / (near.weight * direction_count));
}

double PrintedVisibility::at(Vec3 p_mm, Vec2 a_mm, Vec2 b_mm) const {
  const Vec2 ab = b_mm - a_mm, p{p_mm.x, p_mm.y};
  const double l2 = length_squared(ab);
  const Vec2 q = a_mm + ab * (l2 > 0 ? std::clamp(dot(p - a_mm, ab) / l2, 0., 1.) : 0);
  return at({q.x, q.y, p_mm.z});
}

const Voxels& PrintedVisibility::voxels() const {
  return grid_->rays;
}

}  // namespace cleancolor
