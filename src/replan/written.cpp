#include "replan/written.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "audit/timeline.hpp"
#include "base/error.hpp"
#include "gcode/polyline.hpp"
#include "replan/dialect_words.hpp"
#include "replan/emitter.hpp"
#include "replan/filament_book.hpp"
#include "replan/pieces.hpp"
#include "replan/scene.hpp"

namespace cleancolor {
namespace {

constexpr double same_place_mm = 0.002;
constexpr double chord_mm = 0.011;  // between an arc and what is planned by
constexpr double same_way_um = 50;
constexpr std::int64_t unknown_way_um = 1'000'000'000;

/// Twice, > 0 counterclockwise.
template <class Points, class At>
double area_of(const Points& points, At at) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = at(points[i]), b = at(points[(i + 1) % points.size()]);
    sum += cross(a, b);
  }
  return sum;
}

/// Whether the closed path goes round the other way than the run.
bool is_turned(const Path& path, const RecoveredRun& run) {
  const double planned = area_of(path.points, [](Vec2 p) { return p; });
  const double sliced = area_of(points_of(pieces_of(run)), [](FilePoint p) {
    return Vec2{double(p.x_um), double(p.y_um)};
  });
  return (planned > 0) != (sliced > 0);
}

/// Drawing back over what was printed.
struct Wipe {
  std::int64_t before_e5 = 0;  // drawn back on the spot before
  std::vector<WipeMove> moves;
};

/// As long as that of the file and drawing back as much: a loop is gone over again from its start, an open path
/// backwards.  Requires: pieces are the run's, as they are printed.
Wipe wipe_after(const RecoveredRun& run, std::vector<Piece> pieces, bool closed) {
  if (run.wipe.empty()) return {};
  double sum_um = 0;
  std::int64_t filament = 0;
  FilePoint at = run.wipe_from.empty() ? run.roads.back().to : run.wipe_from.back();
  for (const WipeMove& move : run.wipe) {
    sum_um += length_um(at, move.to);
    filament += move.filament_e5;
    at = move.to;
  }
  if (sum_um < 1) return {};  // on the spot, like any drawing back
  at = pieces.back().to;
  if (!closed) pieces = backwards(std::move(pieces));
  const std::vector<FilePoint> way = points_of(pieces);
  std::vector<WipeMove> moves;
  std::vector<double> gone_um;
  for (std::size_t i = 0; i < way.size() && (gone_um.empty() || gone_um.back() < sum_um); ++i) {
    const double gone = gone_um.empty() ? 0 : gone_um.back(), length = length_um(at, way[i]);
    if (length < 1) continue;
    const FilePoint to = between(at, way[i], std::min(1., (sum_um - gone) / length));
    moves.push_back({to, 0, run.wipe.front().feed_mm_min});
    gone_um.push_back(std::min(sum_um, gone + length));
    at = to;
  }
  std::int64_t given = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    moves[i].filament_e5 = std::llround(double(filament) * gone_um[i] / gone_um.back()) - given;
    given += moves[i].filament_e5;
  }
  return {run.back_before_wipe_e5, std::move(moves)};
}

class Writing {
 public:
  Writing(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine, const Config& config,
          const std::string& header)
      : recovered_(recovered),
        print_(print),
        machine_(machine),
        config_(config),
        words_(*words_of(print)),
        out_(recovered, print, config, header),
        asked_mm_(config.extruders.size(), 0.),
        written_e5_(config.extruders.size(), 0) {
    find_plain_states();
    out_.forget(type_key);  // strokes and walls say theirs
  }

  std::string text(const std::vector<Layer>& layers) {
    for (std::size_t k = 0; k < layers.size(); ++k) layer(k, layers[k]);
    if (out_.tool() != recovered_.end_tool) {
      change_tool(recovered_.end_tool);
      if (recovered_.prints_after_end) push_forward();
    }
    wipe(recovered_.end_drawn_back_e5);
    return out_.finish();
  }

 private:
  /// Of each tool and layer the state of a wall: walls of the rampart are printed under it.
  void find_plain_states() {
    const std::size_t layers = recovered_.layers.size(), tools = config_.extruders.size();
    std::vector<std::optional<std::uint32_t>> last(tools);
    plain_state_.assign(layers, std::vector<std::uint32_t>(tools, recovered_.begin_state));
    way_state_ = plain_state_;
    std::vector<std::uint32_t> last_way(tools, recovered_.begin_state);
    for (const bool back : {true, false})  // what follows serves where nothing came before
      for (std::size_t i = 0; i < layers; ++i) {
        const std::size_t k = back ? layers - 1 - i : i;
        std::vector<std::optional<std::uint32_t>> own(tools);
        for (const RecoveredRun& run : recovered_.layers[k].runs) {
          const auto t = std::size_t(run.tool);
          if (!own[t] && !run.fixed) own[t] = run.roads.front().state, last_way[t] = run.way_state;
        }
        for (std::size_t t = 0; t < tools; ++t) {
          if (own[t]) last[t] = own[t];
          if (last[t]) plain_state_[k][t] = *last[t], way_state_[k][t] = last_way[t];
        }
      }
  }

  void draw_back() { draw_back(extruder().retract_length_mm, extruder().retract_lift_mm); }
  void draw_back_for_change() {
    draw_back(extruder().retract_length_toolchange_mm, std::max(extruder().retract_lift_mm, recovered_.change_lift_mm));
  }

  void draw_back(double length_mm, double lift_mm) {
    const std::int64_t to_e5 = e5_of(length_mm);
    wipe(to_e5);
    out_.draw_back(to_e5);
    if (lift_mm > 0) out_.lift(lift_mm);
  }

  void change_tool(int tool) {
    draw_back_for_change();
    out_.change_tool(tool);
    if (!words_.pushes_at_change) return;
    out_.push_forward(e5_of(extruder().retract_length_mm));
    out_.lower();
  }

  const Extruder& extruder() const { return config_.extruders[std::size_t(out_.tool())]; }

  /// What can be drawn back over the path just printed.
  void wipe(std::int64_t most_e5) {
    const Wipe wipe = std::exchange(wipe_, {});
    std::int64_t sum_e5 = wipe.before_e5;
    for (const WipeMove& move : wipe.moves) sum_e5 += move.filament_e5;
    if (wipe.moves.empty() || out_.drawn_back_e5() > 0 || sum_e5 > most_e5) return;
    out_.draw_back(wipe.before_e5);
    out_.wipe(wipe.moves);
  }

  void layer(std::size_t k, const Layer& planned) {
    const RecoveredLayer& source = recovered_.layers[k];
    layer_ = k;
    last_ = nullptr;
    std::vector<char> is_written(source.runs.size(), 0);
    out_.begin_layer(source.header);
    if (extruder().retract_layer_change) draw_back();
    out_.set_z(source.z_mm);
    for (std::size_t i = 0; i < planned.paths.size(); ++i) {
      const Path& path = planned.paths[i];
      if (path.source < 0) {
        // A stroke inside the part is printed as the wall that it leads to.
        const bool in_part = path.island >= 0;
        const int next = in_part && i + 1 < planned.paths.size() ? planned.paths[i + 1].source : -1;
        if (in_part && next < 0) fail("a stroke leads nowhere");
        own_path(path, in_part ? recovered_.states[source.runs.at(std::size_t(next)).roads.front().state]
                               : state_of_wall(source, recovered_.states[plain_state_[k][std::size_t(path.extruder)]],
                                               path.extruder));
        continue;
      }
      const RecoveredRun& run = source.runs.at(std::size_t(path.source));
      if (std::exchange(is_written[std::size_t(path.source)], char(1)) != 0) fail("a path is planned twice");
      run.fixed ? fixed_path(path, run) : recovered_path(path, run);
    }
    out_.end_layer();
    if (std::ranges::find(is_written, 0) != is_written.end()) fail("a path is not planned");
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(fmt::format("{}: layer {}: {}; the file cannot be re-planned; please report it", print_.name,
                            layer_ + 1, what));
  }

  FilePoint in_file(Vec2 place, int tool) const {
    if (machine_.offsets_in == OffsetsIn::slicer) place = place - nozzle_offset_mm(machine_, tool);
    return file_point(place);
  }

  void go(const Path& path, FilePoint start, const RecoveredRun* run) {
    const bool changes = path.extruder != out_.tool();
    double way_um = out_.is_known() ? 0 : double(unknown_way_um);
    FilePoint from = out_.at();
    std::vector<FilePoint> way;
    for (const Vec2 p : path.travel) way.push_back(in_file(p, path.extruder));
    way.push_back(start);
    for (const FilePoint p : way) way_um += length_um(from, p), from = p;
    const auto next = run != nullptr ? run->way_state : way_state_[layer_][std::size_t(path.extruder)];
    const bool drives_otherwise = recovered_.drives_otherwise && way_um > 0;
    if (changes) {
      if (drives_otherwise && path.travel_before_change > 0) out_.set(of_moving(recovered_.states[next]));
      drive_before_change(path);
      way.erase(way.begin(), way.begin() + std::ptrdiff_t(path.travel_before_change));
      change_tool(path.extruder);
    }
    if (drives_otherwise) out_.set(of_moving(recovered_.states[next]));
    const Extruder& e = config_.extruders[std::size_t(path.extruder)];
    const bool draws_back = way_um > e.retract_before_travel_mm * 1e3 - 1;
    if (draws_back && !(run != nullptr && goes_so_in_file(*run, way_um))) draw_back();
    if (out_.is_known()) out_.rises_over(way_um);
    for (const FilePoint p : way) out_.travel(p);
  }

  /// The former tool, drawn back, to where the new one is taken.
  void drive_before_change(const Path& path) {
    if (path.travel_before_change == 0) return;
    draw_back_for_change();
    for (std::size_t i = 0; i < path.travel_before_change; ++i) out_.travel(in_file(path.travel[i], out_.tool()));
  }

  /// Whether the file goes between this run and the one printed last, this way or the other, no shorter and without
  /// drawing back.
  bool goes_so_in_file(const RecoveredRun& run, double way_um) const {
    if (last_ == nullptr || last_->tool != run.tool) return false;
    const bool forward = &run == last_ + 1;
    if (!forward && &run + 1 != last_) return false;
    const RecoveredRun &before = forward ? *last_ : run, &after = forward ? run : *last_;
    if (after.drawn_back || before.fixed || after.fixed) return false;
    double sliced_um = 0;
    FilePoint at = before.roads.back().to;
    for (const FilePoint p : after.way) sliced_um += length_um(at, p), at = p;
    sliced_um += length_um(at, after.from);
    return way_um <= sliced_um + same_way_um;
  }

  void push_forward() {
    out_.lower();
    out_.push_forward();
  }

  void recovered_path(const Path& path, const RecoveredRun& run) {
    std::vector<Piece> pieces = begun(path, run);
    go(path, pieces.front().from, &run);
    out_.lines(run.notes);
    push_forward();
    for (const Piece& p : pieces) {
      out_.set_known(p.state);
      out_.road(p.to, p.filament_e5, p.feed_mm_min, p.arc);
    }
    wipe_ = wipe_after(run, std::move(pieces), path.closed);
    last_ = &run;
  }

  void fixed_path(const Path& path, const RecoveredRun& run) {
    if (!run.fixed->lays) draw_back_for_change();
    go(path, run.from, &run);
    out_.lines(run.notes);
    if (run.fixed->lays) {
      push_forward();
      out_.set_known(run.fixed->state);
    }
    out_.fixed(*run.fixed);
    last_ = nullptr;
    wipe_ = {};
  }

  /// The roads of the run as the path walks them.
  std::vector<Piece> begun(const Path& path, const RecoveredRun& run) const {
    std::vector<Piece> pieces = pieces_of(run);
    const auto apart_mm = [&](FilePoint at, Vec2 place) { return distance(place_mm(at, run.tool, machine_), place); };
    if (!path.closed) {
      if (apart_mm(pieces.front().from, path.points.front()) <= same_place_mm) return pieces;
      pieces = backwards(std::move(pieces));
      if (apart_mm(pieces.front().from, path.points.front()) > same_place_mm) fail("a path begins elsewhere");
      return pieces;
    }
    // Walls may be walked either way; loops of the part stay as they were sliced.
    if (path.road().role == Role::rampart && is_turned(path, run)) pieces = backwards(std::move(pieces));
    std::size_t best = 0;
    double least = INFINITY;
    Vec2 on;
    const double gap_um = length_um(pieces.back().to, pieces.front().from);
    // The seam itself is a place to begin, too.
    const Vec2 in_gap = nearest_on_segment(place_mm(pieces.back().to, run.tool, machine_),
                                           place_mm(pieces.front().from, run.tool, machine_), path.start());
    if (distance(in_gap, path.start()) <= same_place_mm) return pieces;
    const Vec2 offset = place_mm({}, run.tool, machine_);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Vec2 q = nearest_mm(pieces[i], path.start() - offset) + offset;
      const double off = std::max(0., distance(q, path.start()) - (pieces[i].arc ? chord_mm : 0));
      if (off < least) least = off, best = i, on = q;
    }
    if (least > same_place_mm) fail("a loop begins beside itself");
    return begun_at(std::move(pieces), best, in_file(on, run.tool), gap_um);
  }

  std::vector<Piece> begun_at(std::vector<Piece> pieces, std::size_t index, FilePoint at, double gap_um) const {
    const auto [before, after] = cut(pieces[index], at);
    std::vector<Piece> turned;
    if (after.from != after.to) turned.push_back(after);
    turned.insert(turned.end(), pieces.begin() + std::ptrdiff_t(index) + 1, pieces.end());
    std::vector<Piece> rest(pieces.begin(), pieces.begin() + std::ptrdiff_t(index));
    if (before.from != before.to) rest.push_back(before);
    // A road too short to be cut keeps its filament in one part.
    if (before.from == before.to && after.from != after.to) turned.front().filament_e5 = pieces[index].filament_e5;
    if (after.from == after.to && before.from != before.to) rest.back().filament_e5 = pieces[index].filament_e5;
    const Piece& last = pieces.back();
    Piece seam{last.to, pieces.front().from, 0, last.feed_mm_min, last.state};
    if (gap_um > 0.5) {
      const auto kind = [&](const Piece& p, std::string_view key) {
        const auto found = recovered_.states[p.state].find(key);
        return found == recovered_.states[p.state].end() ? std::string() : found->second;
      };
      double length = 0;
      for (const Piece& p : rest) length += length_um(p);
      bool alike = !rest.empty() && length > 2 * gap_um;  // all that the gap takes the plastic of
      double back_um = 0;
      for (std::size_t i = rest.size(); i-- > 0 && back_um < gap_um; back_um += length_um(rest[i]))
        alike = alike && kind(last, type_key) == kind(rest[i], type_key);
      if (alike) seam.filament_e5 = cut_end(rest, gap_um);
      turned.push_back(seam);
    }
    turned.insert(turned.end(), rest.begin(), rest.end());
    return turned;
  }

  /// Where a tool prints nothing of its own in the layer, fan and accelerations are those of the others.
  ModalState state_of_wall(const RecoveredLayer& layer, ModalState state, int tool) const {
    const auto prints = [](const RecoveredRun& run) { return !run.fixed && !run.roads.empty(); };
    const auto is_own = [&](const RecoveredRun& run) { return prints(run) && run.tool == tool; };
    const auto other = std::ranges::find_if(layer.runs, prints);
    if (other != layer.runs.end() && std::ranges::none_of(layer.runs, is_own)) {
      const ModalState& here = recovered_.states[other->roads.front().state];
      ModalState shared = of_moving(here);
      if (const auto fan = here.find("fan"); fan != here.end()) shared.insert(*fan);
      for (auto& [key, text] : shared) state[key] = text;
    }
    return of_no_object(std::move(state));
  }

  /// Walls of the rampart, their brim, refills; printed under a state.
  void own_path(const Path& path, ModalState state) {
    const auto tool = std::size_t(path.extruder);
    const Extruder& e = config_.extruders[tool];
    Polyline line;
    lay_out(path, config_.gcode_resolution_mm, config_.seam_gap_distance.of(e.nozzle_diameter_mm), line);
    if (line.points.size() < 2) return;
    go(path, in_file(line.points.front(), path.extruder), nullptr);
    push_forward();
    const bool refills = path.road().role == Role::refill;
    const double filament_mm2 = filament_area_mm2(machine_, path.extruder);
    std::size_t next = 0;
    Road road;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      if (next < line.stretches.size() && line.stretches[next].first_segment <= i) {
        road = line.stretches[next++].road;
        state[std::string(type_key)] = words_.own_type;
        if (!words_.own_object.empty()) state[std::string(mesh_key)] = words_.own_object;
        if (words_.tells_sizes) {
          state[std::string(width_key)] = fmt::format("{}{:.6g}", words_.width, road.width_mm);
          state[std::string(height_key)] = fmt::format("{}{:.6g}", words_.height, road.height_mm);
        }
        out_.set(state);
        if (i == 0) out_.line(refills ? ";REFILL_START" : ";RAMPART_WALL");
      }
      const double mm = distance(line.points[i], line.points[i + 1]);
      asked_mm_[tool] += mm * road.area_mm2 * e.extrusion_multiplier / filament_mm2;
      const std::int64_t filament = e5_of(asked_mm_[tool]) - written_e5_[tool];
      written_e5_[tool] += filament;
      out_.road(in_file(line.points[i + 1], path.extruder), filament, road.speed_mm_s * 60);
    }
    if (refills) out_.line(";REFILL_END");
    last_ = nullptr;
    out_.forget(type_key);  // what follows may be of the same type, but it is no wall
    wipe_ = {};
  }

  const RecoveredPrint& recovered_;
  const GcodePrint& print_;
  const AuditMachine& machine_;
  const Config& config_;
  const DialectWords& words_;
  Emitter out_;
  std::size_t layer_ = 0;
  const RecoveredRun* last_ = nullptr;                   // printed last, in this layer
  Wipe wipe_;                                            // that the path printed last may be left with
  std::vector<std::vector<std::uint32_t>> plain_state_;  // [layer][tool]
  std::vector<std::vector<std::uint32_t>> way_state_;    // likewise, of ways to what is ours
  std::vector<double> asked_mm_;                         // of rampart and refills, by tool
  std::vector<std::int64_t> written_e5_;
};

}  // namespace

std::string written(const RecoveredPrint& recovered, const GcodePrint& print, const AuditMachine& machine,
                    const Config& config, const std::vector<Layer>& layers, const std::string& header) {
  return Writing(recovered, print, machine, config, header).text(layers);
}

}  // namespace cleancolor
