#include "base/bit_grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace cleancolor {
namespace {

/// The cut of a stadium with horizontal lines. The ends are ordered: a below b.
class Stadium {
 public:
  explicit Stadium(const CellRoad& road) : a_(road.a), b_(road.b), r_(road.half_width) {
    if (a_.y > b_.y) std::swap(a_, b_);
    const double l = distance(a_, b_);
    along_ = l > 0 ? (b_ - a_) * (1 / l) : Vec2{1, 0};
    const double rise = b_.y - a_.y;
    slope_ = rise > 0 ? (b_.x - a_.x) / rise : 0;
    begin_ = a_ - along_ * r_;
    end_ = b_ + along_ * r_;
  }

  double lowest() const { return a_.y - r_; }
  double highest() const { return b_.y + r_; }

  /// Widens [left, right] to what the line at height y cuts out of the stadium.
  void cut(double y, double& left, double& right) const {
    if (y < lowest() || y > highest()) return;
    left = std::min(left, side(y, -1));
    right = std::max(right, side(y, 1));
  }

  /// Widens [left, right] to what the prolonged centre line covers between two heights.
  void line_between(double low, double high, double& left, double& right) const {
    if (end_.y < low || begin_.y > high) return;
    const double x0 = begin_.y < low ? begin_.x + slope_ * (low - begin_.y) : begin_.x;
    const double x1 = end_.y > high ? begin_.x + slope_ * (high - begin_.y) : end_.x;
    left = std::min({left, x0, x1});
    right = std::max({right, x0, x1});
  }

 private:
  /// The left (-1) or right (1) border at height y: the straight edge, or the round end below or above it.
  double side(double y, double sign) const {
    const Vec2 normal = Vec2{along_.y, -along_.x} * (sign * r_);
    if (y < a_.y + normal.y) return a_.x + sign * chord(y - a_.y);
    if (y > b_.y + normal.y) return b_.x + sign * chord(y - b_.y);
    return a_.x + normal.x + slope_ * (y - a_.y - normal.y);
  }
  double chord(double dy) const { return std::sqrt(std::max(0., r_ * r_ - dy * dy)); }

  Vec2 a_, b_, along_, begin_, end_;
  double r_, slope_;
};

/// Grows seeds through the runs of ones of `open` that they lie in; within one word.
std::uint64_t grown(std::uint64_t seeds, std::uint64_t open) {
  // The sum carries through every run from its seed upwards.
  const std::uint64_t up = ((open + seeds) ^ open) & open;
  std::uint64_t down = seeds | up;
  for (int k = 1; k < 64; k *= 2) {
    down |= open & down >> k;
    open &= open >> k;
  }
  return down;
}

/// Words whose neighbours have changed.
class Dirty {
 public:
  explicit Dirty(std::size_t count) : count_(std::int64_t(count)), words_((count + 63) / 64, ~std::uint64_t(0)) {
    if (count % 64 != 0) words_.back() = (std::uint64_t(1) << count % 64) - 1;
  }
  void mark(std::int64_t w) {
    if (w >= 0 && w < count_) words_[std::size_t(w >> 6)] |= std::uint64_t(1) << (w & 63);
  }
  /// Takes all marks in ascending or descending order, those that are made ahead of it too; false: there was none.
  template <class Visit>
  bool sweep(bool ascending, Visit visit) {
    bool any = false;
    for (std::size_t k = 0; k < words_.size(); ++k) {
      const std::size_t i = ascending ? k : words_.size() - 1 - k;
      std::uint64_t ahead = ~std::uint64_t(0);
      while (const std::uint64_t marks = words_[i] & ahead) {
        const int b = ascending ? std::countr_zero(marks) : 63 - std::countl_zero(marks);
        const std::uint64_t mask = std::uint64_t(1) << b;
        words_[i] &= ~mask;
        ahead &= ascending ? ~(mask | (mask - 1)) : mask - 1;
        visit(std::int64_t(i) * 64 + b);
        any = true;
      }
    }
    return any;
  }

 private:
  std::int64_t count_;
  BitWords words_;
};

}  // namespace

void fill_bits(std::span<std::uint64_t> words, std::int64_t first, std::int64_t last, bool value) {
  for (std::int64_t w = first >> 6; w <= last >> 6; ++w) {
    std::uint64_t mask = ~std::uint64_t(0);
    if (w == first >> 6) mask &= ~std::uint64_t(0) << (first & 63);
    if (w == last >> 6) mask &= ~std::uint64_t(0) >> (63 - (last & 63));
    std::uint64_t& word = words[std::size_t(w)];
    word = value ? word | mask : word & ~mask;
  }
}

void cells_of_road(const CellRoad& road, int columns, int rows, std::vector<CellSpan>& spans) {
  const Stadium stadium(road);
  const auto cell = [](double x, int count) { return int(std::floor(std::clamp(x, -1., double(count)))); };
  const int y0 = std::max(0, cell(stadium.lowest(), rows));
  const int y1 = std::min(rows - 1, cell(stadium.highest(), rows));
  for (int y = y0; y <= y1; ++y) {
    double left = INFINITY, right = -INFINITY;
    stadium.cut(y + 0.5, left, right);
    // A cell belongs to the cut where its centre does.
    left = std::ceil(left - 0.5), right = std::floor(right - 0.5);
    if (left > right) left = INFINITY, right = -INFINITY;
    stadium.line_between(y, y + 1, left, right);
    if (left > right) continue;
    const int first = std::max(0, cell(left, columns)), last = std::min(columns - 1, cell(right, columns));
    if (first <= last) spans.push_back({y, first, last});
  }
}

void flood(std::span<std::uint64_t> reached, std::span<const std::uint64_t> solid, std::int64_t row_bits,
           std::int64_t plane_bits) {
  assert(reached.size() == solid.size() && row_bits >= 1 && plane_bits % 64 == 0);
  Dirty dirty(reached.size());
  const std::array<std::int64_t, 6> shifts = {1, -1, row_bits, -row_bits, plane_bits, -plane_bits};
  const std::size_t neighbours = plane_bits > 0 ? 6 : 4;
  const auto visit = [&](std::int64_t w) {
    std::uint64_t& word = reached[std::size_t(w)];
    const std::uint64_t open = ~solid[std::size_t(w)];
    if (word == open) return;
    std::uint64_t seeds = word;
    for (std::size_t k = 0; k < neighbours; ++k) seeds |= shifted_word(reached, w, shifts[k]);
    seeds &= open;
    if (seeds == 0) return;
    seeds = grown(seeds, open);
    if (seeds == word) return;
    word = seeds;
    // The neighbours along the row within the word are reached already; those in other rows can lie in it too.
    for (std::size_t k = 0; k < neighbours; ++k) {
      const std::int64_t near = w + (shifts[k] >> 6);
      if (near != w || k >= 2) dirty.mark(near);
      if ((shifts[k] & 63) != 0 && (near + 1 != w || k >= 2)) dirty.mark(near + 1);
    }
  };
  for (bool ascending = true; dirty.sweep(ascending, visit);) ascending = !ascending;
}

}  // namespace cleancolor
