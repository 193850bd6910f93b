#include "audit/offset_guess.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/bit_grid.hpp"

namespace cleancolor {
namespace {

constexpr double cell_mm = 0.25;
constexpr int beside_cells = 2;
constexpr std::size_t most_layers = 24;
constexpr double most_cells = 2e7;                // of one colour in one layer; larger ones are left out
constexpr std::int64_t most_points = 40'000'000;  // drawn in all; a real print has a tenth
constexpr std::int64_t work_per_word = 8;         // of a mask and what lies beside it, in points
constexpr int reach_cells = 320, across_cells = 4;
constexpr std::size_t most_search_words = 40'000;  // of all layers of a search

constexpr double clear_score = 0.04, clear_together = 0.5;  // so much better one form must be than the other
constexpr double least_score = 0.06;                        // of an offset that nobody told
constexpr int distinct_cells = 12;  // offsets that are closer are one: colours that meet along a line can slide

struct Cell {
  int x = 0, y = 0;
};

struct Segment {
  Vec2 a_mm, b_mm;
};

/// What each tool lays of the part, in a layer or in two that lie one upon the other.
using ToolRoads = std::vector<std::vector<Segment>>;

struct Sample {
  std::vector<ToolRoads> layers;
  bool one_layer = true;  // several tools print in each; false: tools change from layer to layer only
};

bool is_part(const GcodePrint& print, std::size_t i) {
  return lays_plastic(print, i) && !is_auxiliary(print.moves[i].role);
}

/// Evenly chosen out of all.
std::vector<std::uint32_t> some_of(const std::vector<std::uint32_t>& all) {
  if (all.size() <= most_layers) return all;
  std::vector<std::uint32_t> chosen;
  for (std::size_t k = 0; k < most_layers; ++k) chosen.push_back(all[k * all.size() / most_layers]);
  return chosen;
}

Sample sample_of(const GcodePrint& print) {
  std::vector<std::uint32_t> tools(print.layers.size(), 0);
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (is_part(print, i)) tools[print.moves[i].layer] |= std::uint32_t{1} << print.moves[i].tool;
  std::vector<std::uint32_t> several, changes;
  for (std::uint32_t k = 0; k < tools.size(); ++k) {
    if ((tools[k] & (tools[k] - 1)) != 0) several.push_back(k);
    if (k > 0 && tools[k] != 0 && tools[k - 1] != 0 && (tools[k] & tools[k - 1]) == 0) changes.push_back(k);
  }

  Sample sample;
  sample.one_layer = !several.empty();
  const std::vector<std::uint32_t> chosen = some_of(sample.one_layer ? several : changes);
  sample.layers.assign(chosen.size(), ToolRoads(std::size_t(print.tools)));
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> slot(print.layers.size() + 1, none);  // of the layer, and of the one above it
  for (std::uint32_t k = 0; k < chosen.size(); ++k) slot[chosen[k]] = k;
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (!is_part(print, i)) continue;
    const Vec3 a = print.moves[i - 1].to_mm, b = print.moves[i].to_mm;
    const std::uint32_t layer = print.moves[i].layer;
    for (const std::uint32_t k : {slot[layer], sample.one_layer ? none : slot[layer + 1]})
      if (k != none) sample.layers[k][print.moves[i].tool].push_back({{a.x, a.y}, {b.x, b.y}});
  }
  return sample;
}

Box<Vec2> box_of(const std::vector<Segment>& roads) {
  Box<Vec2> box;
  for (const Segment& s : roads) box.add(s.a_mm), box.add(s.b_mm);
  return box;
}

/// The cells of one colour in one layer.
struct Mask {
  Cell first;  // cell of bit (0, 0)
  int rows = 0, words = 0;
  BitWords bits;
  std::size_t count = 0;  // of cells

  std::span<const std::uint64_t> row(int y) const {
    if (y < 0 || y >= rows) return {};
    return {bits.data() + std::size_t(y) * std::size_t(words), std::size_t(words)};
  }
  void set(Cell c) {
    std::uint64_t& word = bits[std::size_t(c.y - first.y) * std::size_t(words) + std::size_t((c.x - first.x) >> 6)];
    word |= std::uint64_t{1} << ((c.x - first.x) & 63);
  }
};

Cell cell_at(Vec2 p_mm) {
  return {int(std::floor(p_mm.x / cell_mm)), int(std::floor(p_mm.y / cell_mm))};
}

/// Empty where the colour is too large, or the points are used up.
Mask mask_of(const std::vector<Segment>& roads, Vec2 shift_mm, std::int64_t& points_left) {
  Mask mask;
  const Box<Vec2> box = box_of(roads);
  if (box.empty() || box.size().x / cell_mm * (box.size().y / cell_mm) > most_cells) return mask;
  const Cell low = cell_at(box.min + shift_mm), high = cell_at(box.max + shift_mm);
  // Room on every side for what lies beside.
  mask.first = {low.x - beside_cells, low.y - beside_cells};
  mask.rows = high.y - low.y + 1 + 2 * beside_cells;
  mask.words = (high.x - low.x + 2 * beside_cells) / 64 + 1;
  points_left -= std::int64_t(mask.rows) * mask.words * work_per_word;
  if (points_left < 0) return {};
  mask.bits.assign(std::size_t(mask.rows) * std::size_t(mask.words), 0);
  for (const Segment& s : roads) {
    const int steps = int(distance(s.a_mm, s.b_mm) / (cell_mm / 2)) + 1;
    points_left -= steps;
    if (points_left < 0) return {};
    for (int k = 0; k <= steps; ++k) mask.set(cell_at(lerp(s.a_mm, s.b_mm, double(k) / steps) + shift_mm));
  }
  for (const std::uint64_t word : mask.bits) mask.count += std::size_t(std::popcount(word));
  return mask;
}

/// The cells within beside_cells of the mask's, without these.
Mask halo_of(const Mask& mask) {
  Mask halo = mask;
  for (int y = 0; y < mask.rows; ++y) {
    for (int w = 0; w < mask.words; ++w) {
      std::uint64_t near = 0;
      for (int dy = -beside_cells; dy <= beside_cells; ++dy)
        for (int dx = -beside_cells; dx <= beside_cells; ++dx)
          if (dx * dx + dy * dy <= beside_cells * beside_cells) near |= shifted_word(mask.row(y + dy), w, dx);
      halo.bits[std::size_t(y) * std::size_t(mask.words) + std::size_t(w)] = near & ~mask.row(y)[std::size_t(w)];
    }
  }
  return halo;
}

/// Two colours of one layer. The smaller is the one that is counted.
struct Pair {
  Mask larger, halo, smaller;
  int sign = 1;  // of a shift of the second colour as one of the smaller
};

struct Count {
  std::size_t over = 0, beside = 0, of = 0;

  double touching() const { return of == 0 ? 0 : double(beside) / double(of); }
  double overlapping() const { return of == 0 ? 0 : double(over) / double(of); }
  double score() const { return touching() - 3 * overlapping(); }
};

std::optional<Pair> pair_of(const std::vector<Segment>& first, Vec2 first_shift_mm, const std::vector<Segment>& second,
                            Vec2 second_shift_mm, std::int64_t& points_left) {
  if (first.empty() || second.empty()) return std::nullopt;
  Pair pair;
  pair.larger = mask_of(first, first_shift_mm, points_left);
  pair.smaller = mask_of(second, second_shift_mm, points_left);
  if (pair.larger.count == 0 || pair.smaller.count == 0) return std::nullopt;
  if (pair.larger.count < pair.smaller.count) {
    std::swap(pair.larger, pair.smaller);
    pair.sign = -1;
  }
  pair.halo = halo_of(pair.larger);
  return pair;
}

/// Adds the cells of a pair, its second colour moved by `shift`.
void add(const Pair& pair, Cell shift, Count& count) {
  const Mask& b = pair.smaller;
  const int dx = b.first.x + pair.sign * shift.x - pair.larger.first.x;
  const int dy = b.first.y + pair.sign * shift.y - pair.larger.first.y;
  count.of += b.count;
  for (int y = std::max(0, -dy); y < std::min(b.rows, pair.larger.rows - dy); ++y) {
    const auto row = b.row(y), over = pair.larger.row(y + dy), beside = pair.halo.row(y + dy);
    for (int w = 0; w < b.words; ++w) {
      const std::uint64_t cells = row[std::size_t(w)];
      if (cells == 0) continue;
      count.over += std::size_t(std::popcount(cells & shifted_word(over, w, dx)));
      count.beside += std::size_t(std::popcount(cells & shifted_word(beside, w, dx)));
    }
  }
}

/// Share of the smaller box that lies in the larger; of boxes without an area, by length.
double shared(const Box<Vec2>& a, const Box<Vec2>& b) {
  const auto area = [](Vec2 size) { return std::max(size.x, cell_mm) * std::max(size.y, cell_mm); };
  const Vec2 low = {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)};
  const Vec2 high = {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)};
  if (low.x > high.x || low.y > high.y) return 0;
  return area(high - low) / std::min(area(a.size()), area(b.size()));
}

Vec2 shift_of(const std::vector<Vec2>& shift_mm, std::size_t tool) {
  return tool < shift_mm.size() ? shift_mm[tool] : Vec2{};
}

OffsetFit fit_of(const Sample& sample, const std::vector<Vec2>& shift_mm) {
  Count count;
  double together = 0;
  int pairs = 0;
  std::int64_t points_left = most_points;
  for (const ToolRoads& layer : sample.layers) {
    for (std::size_t a = 0; a < layer.size(); ++a) {
      for (std::size_t b = a + 1; b < layer.size(); ++b) {
        if (layer[a].empty() || layer[b].empty()) continue;
        Box<Vec2> box_a = box_of(layer[a]), box_b = box_of(layer[b]);
        const Vec2 shift_a = shift_of(shift_mm, a), shift_b = shift_of(shift_mm, b);
        box_a = {box_a.min + shift_a, box_a.max + shift_a};
        box_b = {box_b.min + shift_b, box_b.max + shift_b};
        together += shared(box_a, box_b);
        ++pairs;
        if (!sample.one_layer) continue;
        if (const auto pair = pair_of(layer[a], shift_a, layer[b], shift_b, points_left)) add(*pair, {}, count);
      }
    }
  }
  return {count.touching(), count.overlapping(), pairs == 0 ? 0 : together / pairs};
}

/// Pairs of tool 0 and another, of so many layers that a search stays quick.
std::vector<Pair> pairs_for_search(const Sample& sample, std::size_t tool) {
  std::vector<Pair> pairs;
  if (!sample.one_layer) return pairs;
  std::int64_t points_left = most_points;
  std::size_t words = 0;
  // Every second layer first, so that what does not fit in is spread over the print.
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
    for (std::size_t k = first; k < sample.layers.size(); k += 2) {
      auto pair = pair_of(sample.layers[k][0], {}, sample.layers[k][tool], {}, points_left);
      if (!pair) continue;
      words += pair->smaller.bits.size();
      if (words > most_search_words) return pairs;
      pairs.push_back(std::move(*pair));
    }
  }
  return pairs;
}

std::optional<Vec2> guessed_offset_mm(const std::vector<Pair>& pairs) {
  struct Place {
    Cell at;
    double score = 0;
  };
  std::vector<Place> places;
  const auto try_place = [&](Cell at) {
    Count count;
    for (const Pair& pair : pairs) add(pair, at, count);
    places.push_back({at, count.score()});
  };
  for (int along = -reach_cells; along <= reach_cells; ++along) {
    for (int across = -across_cells; across <= across_cells; ++across) {
      try_place({along, across});
      if (std::abs(along) > across_cells) try_place({across, along});
    }
  }
  const Place best = *std::ranges::max_element(places, {}, &Place::score);
  const auto far = [](Cell a, Cell b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) > distinct_cells; };
  if (best.score < least_score || !far(best.at, {})) return std::nullopt;
  // Where several places are as good, which are close then, the one amid them.
  double x = 0, y = 0;
  int equals = 0;
  for (const Place& place : places) {
    if (far(place.at, best.at) && 2 * place.score > best.score) return std::nullopt;
    if (place.score < best.score) continue;
    x += place.at.x, y += place.at.y;
    ++equals;
  }
  const auto middle_mm = [&](double sum) { return std::round(sum / equals * cell_mm * 100) / 100; };
  return Vec2{middle_mm(x), middle_mm(y)};
}

}  // namespace

OffsetFit offset_fit(const GcodePrint& print, const std::vector<Vec2>& shift_mm) {
  return fit_of(sample_of(print), shift_mm);
}

std::optional<OffsetsIn> guessed_offsets_in(const GcodePrint& print, const std::vector<Vec2>& nozzle_offset_mm) {
  const Sample sample = sample_of(print);
  const OffsetFit slicer = fit_of(sample, nozzle_offset_mm), firmware = fit_of(sample, {});
  const auto score = [](const OffsetFit& fit) { return fit.touching - 3 * fit.overlapping; };
  double better = score(slicer) - score(firmware);
  if (std::abs(better) < clear_score) {
    better = slicer.together - firmware.together;
    if (std::abs(better) < clear_together) return std::nullopt;
  }
  return better > 0 ? OffsetsIn::slicer : OffsetsIn::firmware;
}

std::vector<Vec2> guessed_offsets_mm(const GcodePrint& print) {
  const Sample sample = sample_of(print);
  std::vector<Vec2> offsets_mm = {{0, 0}};
  for (std::size_t tool = 1; tool < std::size_t(print.tools); ++tool) {
    const std::vector<Pair> pairs = pairs_for_search(sample, tool);
    const std::optional<Vec2> offset = pairs.empty() ? std::nullopt : guessed_offset_mm(pairs);
    if (!offset) return {};
    offsets_mm.push_back(*offset);
  }
  return offsets_mm;
}

}  // namespace cleancolor
