#include "audit/offset_guess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cleancolor {
namespace {

constexpr double cell_mm = 0.5;
constexpr std::size_t most_layers = 24;  // samples of layers with several tools
constexpr std::size_t most_cells = 4'000'000;
constexpr double clearly_in = 0.04;      // so much better one form must fit than the other,
constexpr double clearly_offset = 0.15;  // and a shift out of many than none

/// Cells of one layer that each tool's part covers, without any shift.
struct Raster {
  Vec2 origin;
  int columns = 0, rows = 0;
  std::vector<std::vector<std::uint8_t>> covered;  // by tool; empty where it prints nothing here

  bool at(int tool, int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           covered[std::size_t(tool)][std::size_t(row) * std::size_t(columns) + std::size_t(column)] != 0;
  }
};

bool is_part(const GcodePrint& print, std::size_t i) {
  const GcodeMove& move = print.moves[i];
  return i > 0 && move.width_mm > 0 && move.known_start && !is_auxiliary(move.role) &&
         print.moves[i - 1].tool == move.tool;
}

/// Layers in which several tools print, evenly chosen.
std::vector<std::uint32_t> sampled_layers(const GcodePrint& print) {
  std::vector<std::uint32_t> tools(print.layers.size(), 0);
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (is_part(print, i)) tools[print.moves[i].layer] |= 1u << print.moves[i].tool;
  std::vector<std::uint32_t> several;
  for (std::uint32_t k = 0; k < tools.size(); ++k)
    if ((tools[k] & (tools[k] - 1)) != 0) several.push_back(k);
  if (several.size() <= most_layers) return several;
  std::vector<std::uint32_t> chosen;
  for (std::size_t k = 0; k < most_layers; ++k) chosen.push_back(several[k * several.size() / most_layers]);
  return chosen;
}

struct Piece {
  Vec2 a, b;
  int tool;
};

std::vector<std::vector<Piece>> pieces_of(const GcodePrint& print, const std::vector<std::uint32_t>& layers) {
  std::vector<int> slot(print.layers.size(), -1);
  for (std::size_t k = 0; k < layers.size(); ++k) slot[layers[k]] = int(k);
  std::vector<std::vector<Piece>> pieces(layers.size());
  for (std::size_t i = 1; i < print.moves.size(); ++i) {
    if (slot[print.moves[i].layer] < 0 || !is_part(print, i)) continue;
    const Vec3 a = print.moves[i - 1].to_mm, b = print.moves[i].to_mm;
    pieces[std::size_t(slot[print.moves[i].layer])].push_back({{a.x, a.y}, {b.x, b.y}, print.moves[i].tool});
  }
  return pieces;
}

Raster raster_of(const std::vector<Piece>& pieces, int tools) {
  Raster raster;
  Box<Vec2> box;
  for (const Piece& piece : pieces) box.add(piece.a), box.add(piece.b);
  raster.covered.resize(std::size_t(tools));
  if (box.empty()) return raster;
  const Vec2 size = box.size();
  if ((size.x / cell_mm + 3) * (size.y / cell_mm + 3) > double(most_cells)) return raster;
  raster.origin = box.min - Vec2{cell_mm, cell_mm};
  raster.columns = int(size.x / cell_mm) + 3;
  raster.rows = int(size.y / cell_mm) + 3;
  for (const Piece& piece : pieces) {
    auto& cells = raster.covered[std::size_t(piece.tool)];
    cells.resize(std::size_t(raster.columns) * std::size_t(raster.rows));
    const int steps = int(distance(piece.a, piece.b) / (cell_mm / 2)) + 1;
    for (int k = 0; k <= steps; ++k) {
      const Vec2 p = lerp(piece.a, piece.b, double(k) / steps) - raster.origin;
      cells[std::size_t(int(p.y / cell_mm)) * std::size_t(raster.columns) + std::size_t(int(p.x / cell_mm))] = 1;
    }
  }
  return raster;
}

std::vector<Raster> rasters_of(const GcodePrint& print) {
  std::vector<Raster> rasters;
  for (const auto& pieces : pieces_of(print, sampled_layers(print))) {
    Raster raster = raster_of(pieces, print.tools);
    if (raster.columns > 0) rasters.push_back(std::move(raster));
  }
  return rasters;
}

struct Cells {
  int x = 0, y = 0;
};

Cells in_cells(Vec2 shift_mm) {
  return {int(std::lround(shift_mm.x / cell_mm)), int(std::lround(shift_mm.y / cell_mm))};
}

/// Counts the cells of tool b, moved by `by`, that lie over tool a's and that touch it without lying over.
void count(const Raster& raster, int a, int b, Cells by, std::size_t& over, std::size_t& beside) {
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      if (!raster.at(b, column, row)) continue;
      const int x = column + by.x, y = row + by.y;
      if (raster.at(a, x, y)) {
        ++over;
      } else if (raster.at(a, x + 1, y) || raster.at(a, x - 1, y) || raster.at(a, x, y + 1) || raster.at(a, x, y - 1)) {
        ++beside;
      }
    }
  }
}

std::size_t covered_cells(const Raster& raster, int tool) {
  return std::size_t(std::ranges::count(raster.covered[std::size_t(tool)], std::uint8_t{1}));
}

OffsetFit fit_of(const std::vector<Raster>& rasters, const std::vector<Vec2>& shift_mm) {
  std::size_t over = 0, beside = 0, smaller = 0;
  for (const Raster& raster : rasters) {
    const int tools = int(raster.covered.size());
    for (int a = 0; a < tools; ++a) {
      for (int b = a + 1; b < tools; ++b) {
        const std::size_t cells_a = covered_cells(raster, a), cells_b = covered_cells(raster, b);
        if (cells_a == 0 || cells_b == 0) continue;
        smaller += std::min(cells_a, cells_b);
        const Vec2 sa = std::size_t(a) < shift_mm.size() ? shift_mm[std::size_t(a)] : Vec2{};
        const Vec2 sb = std::size_t(b) < shift_mm.size() ? shift_mm[std::size_t(b)] : Vec2{};
        if (cells_b <= cells_a) {
          count(raster, a, b, in_cells(sb - sa), over, beside);
        } else {
          count(raster, b, a, in_cells(sa - sb), over, beside);
        }
      }
    }
  }
  if (smaller == 0) return {};
  return {double(beside) / double(smaller), double(over) / double(smaller)};
}

/// Touching counts for, lying over against; but roads along a common border share some cells.
double score(const OffsetFit& fit) {
  return fit.touching - fit.overlapping / 2;
}

}  // namespace

OffsetFit offset_fit(const GcodePrint& print, const std::vector<Vec2>& shift_mm) {
  return fit_of(rasters_of(print), shift_mm);
}

std::optional<OffsetsIn> guessed_offsets_in(const GcodePrint& print, const std::vector<Vec2>& nozzle_offset_mm) {
  const std::vector<Raster> rasters = rasters_of(print);
  if (rasters.empty()) return std::nullopt;
  const double slicer = score(fit_of(rasters, nozzle_offset_mm)), firmware = score(fit_of(rasters, {}));
  if (slicer > firmware + clearly_in) return OffsetsIn::slicer;
  if (firmware > slicer + clearly_in) return OffsetsIn::firmware;
  return std::nullopt;
}

std::vector<Vec2> guessed_offsets_mm(const GcodePrint& print) {
  const std::vector<Raster> rasters = rasters_of(print);
  if (rasters.empty() || print.tools != 2) return {};
  const auto strict_score = [&](const std::vector<Vec2>& shift_mm) {
    const OffsetFit fit = fit_of(rasters, shift_mm);
    return fit.touching - fit.overlapping;
  };
  const double as_it_is = strict_score({});
  // Printers have their nozzles side by side along one axis, some almost so: the search is along X, then along Y.
  double best = as_it_is + clearly_offset;
  std::vector<Vec2> found;
  for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
    for (double mm = -80; mm <= 80; mm += cell_mm) {
      const double s = strict_score({{}, axis * mm});
      if (s > best) best = s, found = {{}, axis * mm};
    }
  }
  return found;
}

}  // namespace cleancolor
