#include "replan/recovered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "replan/dialect_words.hpp"
#include "replan/driven_way.hpp"
#include "replan/filament_book.hpp"
#include "replan/file_cursor.hpp"
#include "replan/file_parts.hpp"
#include "replan/gap.hpp"
#include "replan/pieces.hpp"
#include "replan/refusals.hpp"

namespace cleancolor {
namespace {

constexpr std::string_view no_extra_length =
    "set the extra length on restart (retract_restart_extra; Cura: retraction_extra_prime_amount) to 0 in the slicer";
constexpr std::size_t most_settings = 64;           // that a print is under at once
constexpr std::size_t most_state_bytes = 64 << 20;  // of all that held at some time

class Recovery {
 public:
  Recovery(const GcodePrint& print, const DialectWords& words) : print_(print), words_(words), text_(*print.text) {}

  RecoveredPrint result() && {
    const LayersText layers = layers_text(print_, words_);
    require_no_own_changes(print_, layers);
    r_.begin = layers.begin, r_.end = layers.end, r_.prints_after_end = layers.prints_after;
    for (const GcodeMove& move : print_.moves)
      if (move.offset < r_.begin) r_.begin_z_mm = move.to_mm.z;
    r_.e_of_each_tool = habits_.e_of_each_tool, r_.says_on_and_off = habits_.says_on_and_off;
    book_ = FilamentBook(print_.tools, r_.e_of_each_tool);
    while (in_.next() < r_.begin) before_layers();
    begin_layers();
    while (in_.next() < r_.end) in_layers();
    part_headers(r_, changed_, print_, words_);
    if (r_.lift_slope > 0 && habits_.travel_slope > 0) r_.lift_slope = habits_.travel_slope;
    finish();
    r_.states = std::move(states_).all();
    return std::move(r_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { in_.refuse(what); }

  void take_state(const ModalLine& what) {
    if (states_.bytes() > most_state_bytes)
      refuse("what holds for roads changes too often for so long names; shorten the names of objects");
    states_.take(what, in_.raw());
    if (states_.size() > most_settings)
      refuse(
          fmt::format("'{}': more than {} things are set by lines like this; take it out of the slicer's custom "
                      "G-code",
                      shown(trimmed(in_.raw())), most_settings));
  }

  void count_e() {
    book_.count(line_, tool_, r_.relative_e);
    if (line_.letter == 'G' && line_.number <= 3 && line_.has_value('F')) feed_ = line_['F'];
  }

  void take_moves() {
    for (std::size_t i = in_.first_move(); i < in_.behind_moves(); ++i) book_.move(print_.moves[i]);
  }

  void before_layers() {
    in_.read();
    if (line_.letter == 'M' && (line_.number == 82 || line_.number == 83)) r_.relative_e = line_.number == 83;
    count_e();
    if (const auto tool = tool_taken(line_); tool && *tool >= 0 && *tool < max_tools) use(*tool);
    if (const auto what = modal_line(line_)) take_state(*what);
    take_moves();
  }

  void begin_layers() {
    r_.begin_tool = tool_;
    is_timed_[std::size_t(tool_)] = true;
    for (std::size_t i = in_.behind_moves(); i < print_.moves.size() && print_.moves[i].offset < r_.end; ++i)
      if (lays_plastic(print_, i)) is_timed_[print_.moves[i].feeds] = true;
    // A wall of a rampart says what it is; what follows must say again that it does not.
    if (print_.facts.dialect == Dialect::slic3r)
      for (const auto& [key, line] :
           {std::pair(type_key, ";TYPE:Unknown"), {width_key, ";WIDTH:0"}, {height_key, ";HEIGHT:0"}})
        states_.set_first(key, line);
    r_.begin_state = states_.index();
    states_.set_first("fan", "M107");
    if (words_.begins_drawn_back) book_.take_first_pushes(print_, in_.behind_moves());
    book_.begin_layers();
    r_.begin_count_e5 = book_.counts();
    breaks_ = true;
  }

  void in_layers() {
    before_ = std::exchange(speed_alone_, {});
    in_.read();
    if (in_.raw().starts_with(";WIPE_SCRIPT_BEGIN"))
      refuse("nozzles are wiped between layers, which is not re-planned; switch off clean_between_layers in Cura");
    if (in_.raw().starts_with(words_.tower)) return tower();
    count_e();
    if (line_.letter == 0 && line_.word.empty() && line_.present == 0) return comment();
    if (const auto what = modal_line(line_)) return take_state(*what);
    if (line_.letter == 'G') return command_g();
    if (const auto tool = tool_taken(line_)) return change_to(*tool);
    if (line_.letter == 'M' && line_.number == 73 && (line_.has('P') || line_.has('Q'))) {
      std::string& first = line_.has('P') ? r_.progress_line : r_.silent_progress_line;
      if (first.empty() && in_.raw().starts_with(line_.has('P') ? "M73 P" : "M73 Q")) first = in_.raw();
      return;
    }
    if (r_.says_on_and_off && line_.letter == 'M' && (line_.number == 101 || line_.number == 103)) return;
    if (line_.letter == 'P') return dock();
    if (line_.letter == 0 && line_.word.empty())
      refuse("a move without its G command among the layers is not re-planned");
    command();
  }

  void comment() {
    if (!line_.has_comment || in_.raw() == words_.wipe_begins || in_.raw() == words_.wipe_ends) return;
    if (!words_.elapsed.empty() && in_.raw().starts_with(words_.elapsed)) {
      r_.tells_elapsed = true;
      return;
    }
    if (std::ranges::find(words_.of_ways, in_.raw()) != words_.of_ways.end()) return;
    if (begins_with_one_of(in_.raw(), words_.layer_begins)) {
      const auto is_told_again = [&](std::string_view mark) {
        const auto begins = [&](const GapLine& line) { return line.text.starts_with(mark); };
        return in_.raw().starts_with(mark) && !mark.empty() && std::ranges::any_of(gap_.header(), begins);
      };
      if (std::ranges::any_of(words_.layer_begins, is_told_again)) refuse("a layer without roads");
      if (!gap_.has_layer()) mark_layer();
      gap_.add({in_.raw(), in_.at(), false});
      return;
    }
    if (const auto what = modal_line(line_)) {
      take_state(*what);
      if (gap_.has_layer() && !gap_.has_tool() && !left_header_ && what->key == height_key)
        gap_.add({in_.raw(), in_.at(), false});
      return;
    }
    keep(false);
  }

  /// Of tool changers: the tool in use is put down.
  void dock() {
    gap_.dock();
    if (!before_.empty()) gap_.add({before_, in_.at(), false});
    keep(true);
  }

  /// A line that stays.
  void keep(bool is_command) {
    if (travelled_after_tool_) refuse("the carriage is moved by the code of this tool change; it cannot be re-planned");
    gap_.add({in_.raw(), in_.at(), is_command});
  }

  /// What was driven since the last road is no way to the next.
  void leave_run(std::size_t places) {
    LeftWay nothing;
    way_.leave(places, gap_.has_layer() ? left_in_layer_ : has_run() ? run().leaving : nothing);
  }
  void leave_run() { leave_run(way_.places.size()); }

  void mark_layer() {
    if (gap_.has_tool()) refuse("a layer begins after a tool change without a road between them");
    leave_run(words_.rises_before_layer ? way_.rises_after.value_or(way_.places.size()) : way_.places.size());
    gap_.begin_layer();
    left_header_ = false;
    breaks_ = true;
  }

  bool is_timed(double tool) const { return tool >= 0 && tool < max_tools && is_timed_[std::size_t(tool)]; }

  void command() {
    const bool asks = line_.letter == 'M' && line_.number == 105;  // how hot it is
    const bool heats = line_.letter == 'M' && (line_.number == 104 || line_.number == 109);
    if (words_.times_heaters && (asks || (heats && is_timed(line_.value_or('T', tool_))))) return;
    if (words_.times_heaters && gap_.has_tool() && line_.letter == 'M' && line_.number == 116) return keep(true);
    if (const auto fault = fault_of_command(line_, in_.raw(), gap_.has_tool() || print_.tools <= 1)) refuse(*fault);
    keep(true);
  }

  void use(int tool) {
    states_.change_tool(tool_, tool);
    tool_ = tool;
  }

  int known_tool(int tool) const {
    if (tool < 0 || tool >= max_tools) refuse("a tool change that is not understood");
    return tool;
  }

  void change_to(int tool) {
    known_tool(tool);
    if (gap_.has_tool()) refuse("two tool changes without a road between them");
    if (moved_among_notes_ > 0 && !(habits_.stands_aside && moved_among_notes_ == 1))
      refuse("the carriage is moved by the code before this tool change; it cannot be re-planned");
    if (habits_.stands_aside && !way_.places.empty()) stand_ = way_.take_last();
    fed_low_ = way_.fed_low;
    leave_run();
    gap_.begin_tool(tool);
    breaks_ = true;
    from_tool_ = tool_;
    use(tool);
    if (words_.lifts_at_change && !gap_.has_layer() && !r_.layers.empty())
      r_.change_lift_mm = std::max(r_.change_lift_mm, way_.rise_mm);
    gap_.add({in_.raw(), in_.at(), false});
  }

  void command_g() {
    if (line_.number == 17) return;  // the plane of arcs is no other one anywhere
    if (is_spiral()) {
      if (way_.spiral.empty() && !before_.empty()) way_.spiral.emplace_back(before_);
      way_.spiral.emplace_back(in_.raw());
      breaks_ = true;
      return;
    }
    if (line_.number == 4 && gap_.has_tool()) return keep(true);  // a wait
    if (const auto fault = fault_of_g(line_, in_.raw())) refuse(*fault);
    if (line_.number == 92) return;
    if (line_.number == 10) return keep(true);  // a temperature
    if (line_.number == 2 || line_.number == 3) return lay_arc();
    const auto index = in_.move();
    if (!index) {
      speed_alone_ = in_.raw();
      return;
    }
    const GcodeMove& move = print_.moves[*index];
    const Vec3 from = *index > 0 ? print_.moves[*index - 1].to_mm : Vec3{};
    if (lays_plastic(print_, *index)) return lay(*index, move, from);
    go(move, from);
  }

  /// Whether the line is of a lift that goes round and comes back to where it began.
  bool is_spiral() {
    if (in_.moves() && behind_spiral_ <= in_.first_move()) behind_spiral_ = behind_spiral(print_, in_.first_move());
    return in_.moves() && in_.first_move() < behind_spiral_;
  }

  void go(const GcodeMove& move, Vec3 from) {
    const bool across = from.x != move.to_mm.x || from.y != move.to_mm.y || (!move.known_start && move.names_xy);
    if (!breaks_ && move.names_xy && !across && move.filament_mm > 0) {  // a road too short to be told
      RunRoad& road = run().roads.back();
      road.filament_e5 += e5_of(move.filament_mm);
      road.at_end_e5 += e5_of(move.filament_mm);
      return;
    }
    breaks_ = true;
    way_.top_z_mm = std::max(way_.top_z_mm, move.to_mm.z);
    if (across && gap_.has_tool()) travelled_after_tool_ = true;
    if (move.filament_mm < 0 && across) return wipe(move);
    if (move.filament_mm > 0 && across) refuse("filament is pushed on the way");
    if (across && !gap_.has_tool() && !gap_.all().empty()) ++moved_among_notes_;
    if (gap_.has_layer()) left_header_ = left_header_ || across;
    if (move.to_mm.z != from.z && !way_.rises_after) way_.rises_after = way_.places.size();
    if (!r_.layers.empty()) way_.rise_mm = std::max(way_.rise_mm, move.to_mm.z - r_.layers.back().z_mm);
    if (move.filament_mm > 0) {
      const std::int64_t beyond = e5_of(move.filament_mm) - book_.back_of(move.feeds);
      if (beyond > filament_rounding_e5)
        refuse(fmt::format("{:g} mm more filament are pushed forward than were drawn back; {}", double(beyond) * 1e-5,
                           no_extra_length));
    }
    if (move.filament_mm != 0) way_.move_filament(e5_of(move.filament_mm));
    if (line_.has('A') || line_.has('B') || move.feeds != move.tool)
      refuse("filament of another tool than the one in use is moved");
    book_.move(move);
    if (!across) return;
    way_.drive_to(move.to_mm, states_.index());
    if (way_.places.size() == 1 && road_state_ && *road_state_ != way_.state)
      r_.drives_otherwise = r_.drives_otherwise || of_moving(states_.now()) != road_moving_;
    if (const double rise = move.to_mm.z - from.z; rise > 0 && move.known_start) {
      way_.rises = true;
      const double slope = rise / std::hypot(move.to_mm.x - from.x, move.to_mm.y - from.y);
      r_.lift_slope = r_.lift_slope > 0 ? std::min(r_.lift_slope, slope) : slope;
    }
  }

  /// Drawing back on the way, over what was just printed.
  void wipe(const GcodeMove& move) {
    const bool follows = !gap_.has_tool() && has_run() && !run().fixed;
    if (!follows || move.feeds != move.tool) refuse("filament is drawn back on the way, but not after a road");
    if (run().wipe.empty()) {
      // A layer may begin between the road and its wipe.
      way_.leave(way_.places.size(), run().leaving);
      run().wipe_from = std::exchange(run().leaving, {}).places;
      const std::int64_t back = book_.back_of(move.feeds);
      run().back_before_wipe_e5 = back > filament_rounding_e5 ? back : 0;
    } else if (!way_.places.empty()) {
      refuse("filament is drawn back on the way, but not after a road");
    }
    run().wipe.push_back({file_point(move.to_mm), -e5_of(move.filament_mm), feed_});
    book_.move(move);
    way_.drawn_back = true;
    way_.back_after = 0;
  }

  /// A piece of a wipe tower: all from its first comment to its last road stays as it is.
  void tower() {
    if (!r_.relative_e) refuse("a wipe tower with absolute E is not re-planned; switch on relative E");
    if (in_.first_move() == 0 || gap_.has_tool())
      refuse("a wipe tower that begins with a tool change is not re-planned");
    const Vec3 from = print_.moves[in_.first_move() - 1].to_mm;
    const TowerPiece piece = tower_piece(print_, in_.next_plastic(), from.z);
    if (!piece.last_road) return comment();  // it says so, and lays none
    if (book_.back_of(tool_) > filament_rounding_e5) refuse("a wipe tower that begins while filament is drawn back");
    FixedLines fixed{.lines = {}, .lays = true, .state = states_.index(), .drawn_back_e5 = book_.back()};
    close_gap(from);
    const std::size_t end =
        behind_wipe(text_, line_end(text_, print_.moves[*piece.last_road].offset), piece.next_road_at, words_);
    for (;; in_.read()) {
      count_e();
      fixed.lines.emplace_back(in_.raw());
      // M220 holds for the tower alone.
      if (const auto what = modal_line(line_); what && line_.number != 220) take_state(*what);
      if (const auto tool = tool_taken(line_)) use(known_tool(*tool));
      take_moves();
      if (in_.next() >= end) break;
    }
    for (std::size_t t = 0; t < book_.back().size(); ++t)
      fixed.drawn_back_e5[t] = book_.back()[t] - fixed.drawn_back_e5[t];
    const Vec3 to = print_.moves[in_.behind_moves() - 1].to_mm;
    fixed.tool_after = tool_;
    fixed.to = file_point(to);
    run().fixed = std::move(fixed);
    r_.keeps_tools = breaks_ = true;
  }

  /// An arc of plastic, in chords.
  void lay_arc() {
    const std::size_t first = in_.first_move(), behind = in_.behind_moves();
    if (first == behind || first == 0 || !print_.moves[first].arc || !lays_plastic(print_, first))
      refuse("an arc that lays no plastic is not re-planned; switch off arcs in the slicer");
    const Vec3 from = print_.moves[first - 1].to_mm, to = print_.moves[behind - 1].to_mm;
    const auto arc = arc_of(line_, {from.x, from.y}, {to.x, to.y});
    if (!arc) refuse("an arc that is a whole circle, or none, is not re-planned; switch off arc fitting in the slicer");
    lay(first, print_.moves[behind - 1], from);
    RunRoad& road = run().roads.back();
    road.moves = std::uint32_t(behind - first);
    road.arc = arc;
    double filament_mm = 0;
    for (std::size_t i = first; i < behind; ++i) filament_mm += print_.moves[i].filament_mm;
    road.filament_e5 = e5_of(filament_mm);
  }

  /// index: of the first move of its line, move: the last.
  void lay(std::size_t index, const GcodeMove& move, Vec3 from) {
    if (const auto fault = fault_of_road(move, from, tool_, words_)) refuse(*fault);
    if (move.role == Role::wipe_tower) r_.keeps_tools = true;
    require_pushed_forward();
    const Role before = breaks_ ? move.role : print_.moves[run().roads.back().move].role;
    // Supports and ironing have their own place in the order.
    const bool differ = is_auxiliary(before) != is_auxiliary(move.role);
    if (breaks_ || differ || (before == Role::ironing) != (move.role == Role::ironing)) close_gap(from);
    for (const GapLine& line : gap_.all()) {
      if (line.is_command) refuse_line(print_, line.offset, "a command in the middle of a road: it cannot be moved");
      run().notes.emplace_back(line.text);
    }
    gap_ = {};
    if (habits_.says_roles_behind) states_.set(type_key, fmt::format(";TYPE:{}", role_name(move.role)));
    const std::uint32_t state = states_.index();
    if (road_state_ != state) road_state_ = state, road_moving_ = of_moving(states_.now());
    run().roads.push_back({.to = file_point(move.to_mm),
                           .filament_e5 = e5_of(move.filament_mm),
                           .feed_mm_min = feed_,
                           .state = state,
                           .move = std::uint32_t(index)});
  }

  void require_pushed_forward() {
    if (const std::int64_t back = book_.begin_road(tool_); back > filament_rounding_e5)
      refuse(
          fmt::format("a road while {:g} mm of filament are drawn back: less is pushed forward than was drawn back; {}",
                      double(back) * 1e-5, no_extra_length));
  }

  bool has_run() const { return !r_.layers.empty() && !r_.layers.back().runs.empty(); }
  RecoveredRun& run() { return r_.layers.back().runs.back(); }

  /// What lies between two runs: ends of what was printed, a new layer, another tool, the way.
  void close_gap(Vec3 from) {
    if (gap_.has_layer()) begin_layer(from);
    if (r_.layers.empty()) refuse("a road before the first layer");
    if (std::abs(r_.layers.back().z_mm - from.z) > same_height_mm)
      refuse("roads of several heights in one layer are not re-planned yet");
    if (gap_.has_tool()) change_in_gap();
    RecoveredRun begun = way_.leads_to(from);
    begun.tool = tool_;
    if (!gap_.has_tool() || gap_.has_layer()) begun.notes = notes_of(gap_.before(), print_);
    if (gap_.has_tool()) begun.drawn_back = true, begun.back_after = 0;
    r_.layers.back().runs.push_back(std::move(begun));
    gap_ = {};
    breaks_ = left_header_ = travelled_after_tool_ = false;
    moved_among_notes_ = 0;
  }

  void begin_layer(Vec3 from) {
    RecoveredLayer& layer = r_.layers.emplace_back();
    layer.z_mm = from.z;
    layer.header = texts_of(gap_.header());
    layer.leaving = std::exchange(left_in_layer_, {});
    layer.fed_low = fed_low_;
    const auto told = std::ranges::find_if(layer.header, [&](const auto& l) { return l.starts_with(words_.height); });
    std::optional<double> height_mm;
    if (told != layer.header.end()) height_mm = number<double>(trimmed(told->substr(words_.height.size())));
    layer.height_mm = height_mm.value_or(print_.layers[print_.moves[in_.behind_moves() - 1].layer].height_mm);
  }

  void change_in_gap() {
    // Where a layer begins, what stands before it is none of the change.
    const std::vector<std::string> enter = texts_of(gap_.enter());
    const std::vector<std::string> leave = gap_.has_layer() ? std::vector<std::string>{} : texts_of(gap_.before());
    if (gap_.has_layer()) changed_.push_back({r_.layers.size() - 1, from_tool_, gap_.enter().front().offset});
    if (stand_) return stand_aside(leave, enter);
    require_as_before(r_.changes.take_enter(tool_, enter, r_.layers.size() == 1), tool_);
    if (!gap_.has_layer()) require_as_before(r_.changes.take_leave(from_tool_, leave), from_tool_);
  }

  void require_as_before(bool is_same, int tool) const {
    if (is_same) return;
    refuse(
        fmt::format("the change of tool T{} before this line is not as it was before: only changes that are the same "
                    "each time can be moved; look at the custom G-code of tool and filament",
                    tool));
  }

  /// The change of tools as a stop on the way: where it stands, and its lines.
  void stand_aside(const std::vector<std::string>& leave, const std::vector<std::string>& enter) {
    FixedLines fixed{
        .lines = leave, .tool_at = leave.size(), .tool_after = tool_, .to = *stand_, .state = states_.index()};
    fixed.lines.insert(fixed.lines.end(), enter.begin(), enter.end());
    RecoveredRun stop;
    stop.tool = from_tool_;
    stop.from = *stand_;
    stop.fixed = std::move(fixed);
    stop.drawn_back = true;
    r_.layers.back().runs.push_back(std::move(stop));
    if (!gap_.has_layer()) r_.changes.take_leave(from_tool_, leave);
    r_.keeps_tools = true;
    stand_.reset();
  }

  void finish() {
    leave_run();
    r_.end_tool = tool_;
    r_.end_state = states_.index();
    r_.end_count_e5 = book_.count_of(tool_);
    r_.end_drawn_back_e5 = book_.back_of(tool_);
    r_.begin_drawn_back_e5 = book_.begin_back();
    r_.end_feed_mm_min = feed_;
    require_rising(r_, print_);
  }

  const GcodePrint& print_;
  const DialectWords& words_;
  std::string_view text_;
  const FileHabits habits_ = habits_of_file(print_);
  RecoveredPrint r_;

  FileCursor in_{print_};
  const GcodeLine& line_ = in_.line();
  StateLog states_;
  std::optional<std::uint32_t> road_state_;  // of the last road
  ModalState road_moving_;
  int tool_ = 0, from_tool_ = 0;
  double feed_ = 0;
  FilamentBook book_{max_tools, false};
  std::array<bool, max_tools> is_timed_{};  // its heater, where the dialect times them: it prints among the layers

  std::string_view speed_alone_, before_;  // the line, and the one before, where they are one

  // Since the last road:
  Gap gap_;  // lines to be kept
  DrivenWay way_;
  LeftWay left_in_layer_;          // that begins
  std::size_t fed_low_ = 0;        // of it, before it rises
  std::size_t behind_spiral_ = 0;  // move
  bool breaks_ = false, left_header_ = false;
  bool travelled_after_tool_ = false;
  int moved_among_notes_ = 0;
  std::optional<FilePoint> stand_;  // where it does so this time
  std::vector<ChangedHeader> changed_;
};

}  // namespace

RecoveredPrint recovered_print(const GcodePrint& print) {
  const DialectWords* words = words_of(print);
  assert(words != nullptr);
  return Recovery(print, *words).result();
}

}  // namespace cleancolor
