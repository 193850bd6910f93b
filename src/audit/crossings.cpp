#include "audit/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace cleancolor {
namespace {

constexpr float thinnest_road_mm = 0.05F;
constexpr std::uint64_t work_per_move = 2000, least_work = 1'000'000;
constexpr std::uint64_t work_of_visibility = 16;  // roads looked at in the time of one look at the visibility

/// Finds the crossings of one tip after the other.
class Tips {
 public:
  Tips(const CrossingInput& input, Crossings& result) : input_(input), result_(result) {}

  void pass(const Drive& drive, int nozzle);
  std::uint64_t work() const { return scratch_.work; }

 private:
  void add(const Drive& drive, int nozzle, const SurfacePiece& piece);

  const CrossingInput& input_;
  Crossings& result_;
  SurfaceScratch scratch_;
  std::vector<SurfacePiece> pieces_;
  std::size_t begin_ = 0;  // of this tip's crossings
};

void Tips::pass(const Drive& drive, int nozzle) {
  const Vec2 offset = nozzle_offset_mm(input_.machine, nozzle);
  pieces_.clear();
  begin_ = result_.all.size();
  input_.plastic[drive.layer]->surface.along({drive.from_mm + offset, drive.to_mm + offset, nozzle, drive.move},
                                             scratch_, pieces_);
  for (const SurfacePiece& piece : pieces_) add(drive, nozzle, piece);
}

void Tips::add(const Drive& drive, int nozzle, const SurfacePiece& piece) {
  const LayerPlastic& plastic = *input_.plastic[drive.layer];
  const SurfaceRoad& road = plastic.surface.roads()[piece.road];
  Crossing c;
  c.begin = piece.begin, c.end = piece.end;
  c.nozzle = std::uint8_t(nozzle);
  c.over = piece.nozzle;
  c.what = !piece.part ? Crossing::Over::auxiliary : piece.visible ? Crossing::Over::visible : Crossing::Over::inner;
  c.printed = road.drive_order < drive.move;
  auto& all = result_.all;
  if (c.what != Crossing::Over::visible) {
    if (all.size() > begin_ && all.back().end == c.begin && all.back().what == c.what && all.back().over == c.over &&
        all.back().printed == c.printed) {
      all.back().end = c.end;
    } else {
      all.push_back(c);
    }
    return;
  }
  const Vec2 offset = nozzle_offset_mm(input_.machine, nozzle);
  const double length_mm = double(c.end - c.begin) * distance(drive.from_mm, drive.to_mm);
  const int steps = std::max(1, int(std::ceil(length_mm / input_.step_mm - 1e-6)));
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](double step) {
      return i + step == steps ? piece.end
                               : float(std::lerp(double(piece.begin), double(piece.end), (i + step) / steps));
    };
    c.begin = i == 0 ? piece.begin : c.end;
    c.end = at(1);
    const Vec2 tip = lerp(drive.from_mm, drive.to_mm, double(at(0.5))) + offset;
    c.visibility = float(input_.visibility.at({tip.x, tip.y, plastic.z_mm}, road.a_mm, road.b_mm));
    all.push_back(c);
  }
  scratch_.work += work_of_visibility * std::uint64_t(steps);
}

}  // namespace

LayerMoves layer_moves(const GcodePrint& print, const Timeline& time) {
  LayerMoves result;
  const std::size_t layers = print.layers.size();
  result.ranges.resize(layers);
  std::vector<char> part(layers);
  for (std::uint32_t i = 0; i < print.moves.size(); ++i) {
    const GcodeMove& m = print.moves[i];
    auto& ranges = result.ranges[m.layer];
    if (!ranges.empty() && ranges.back().last == i) {
      ++ranges.back().last;
    } else {
      ranges.push_back({i, i + 1});
    }
    if (time.pushed_mm3[i] > 0 && !is_auxiliary(m.role) && lays_plastic(print, i)) part[m.layer] = 1;
  }
  result.above.resize(layers);
  auto above = std::uint32_t(layers);
  for (std::size_t l = layers; l-- > 0;) {
    result.above[l] = part[l] ? above : std::uint32_t(layers);
    if (part[l]) above = std::uint32_t(l);
  }
  return result;
}

LayerRoads layer_roads(const GcodePrint& print, const AuditMachine& machine, const Timeline& time,
                       std::span<const LayerMoves::Range> ranges) {
  LayerRoads layer;
  for (const LayerMoves::Range& range : ranges)
    for (const Drive& d : drives(print, machine, time, range.first, range.last)) {
      if (!d.lays) continue;
      const Vec2 offset = nozzle_offset_mm(machine, d.feeds);
      const double area_mm2 = d.pushed_mm3 / distance(d.from_mm, d.to_mm);
      const float width_mm = std::max(thinnest_road_mm, print.moves[d.move].width_mm);
      layer.roads.push_back({d.from_mm + offset, d.to_mm + offset, width_mm, float(area_mm2), d.role});
      layer.moves.push_back(d.move);
      layer.nozzles.push_back(d.feeds);
    }
  return layer;
}

LayerPlastic layer_plastic(const LayerRoads& layer, const LayerRoads& above, double z_mm, ExposedBy by) {
  const std::vector<Exposure> exposed = exposures(layer.roads, PartOutline(layer.roads), PartOutline(above.roads), by);
  LayerPlastic plastic;
  plastic.z_mm = z_mm;
  plastic.outer.reserve(layer.roads.size());
  std::vector<SurfaceRoad> surface;
  surface.reserve(layer.roads.size());
  for (std::size_t i = 0; i < layer.roads.size(); ++i) {
    const LabelledRoad& r = layer.roads[i];
    plastic.outer.push_back(exposed[i].outer);
    const bool part = !is_auxiliary(r.role);
    if (!part && !exposed[i].wipes) continue;
    surface.push_back({r.a_mm, r.b_mm, r.width_mm / 2, layer.moves[i], layer.nozzles[i], part, exposed[i].visible});
  }
  plastic.surface = LayerSurface(std::move(surface));
  return plastic;
}

Crossings crossings(const CrossingInput& input, LayerMoves::Range moves) {
  Crossings result;
  result.drives = drives(input.print, input.machine, input.time, moves.first, moves.last);
  result.first.reserve(result.drives.size() + 1);
  const std::uint64_t most_work = least_work + work_per_move * (moves.last - moves.first);
  const bool others_touch = input.machine.idle_nozzle == IdleNozzle::same_height;
  Tips tips(input, result);
  for (const Drive& d : result.drives) {
    result.first.push_back(std::uint32_t(result.all.size()));
    if (!d.known) continue;
    for (int n = 0; n < int(input.time.used.size()); ++n) {
      const bool idle = !(d.extrudes() && n == d.feeds);
      if (!input.time.used[std::size_t(n)] || !idle || (!others_touch && n != d.tool)) continue;
      if (tips.work() > most_work) {
        result.cut_short = true;
        continue;
      }
      tips.pass(d, n);
    }
  }
  result.first.push_back(std::uint32_t(result.all.size()));
  return result;
}

}  // namespace cleancolor
