#include "replan/emitter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "gcode/text.hpp"
#include "replan/pieces.hpp"

namespace cleancolor {
namespace {

constexpr std::int64_t negligible_e5 =
    20;  // left by the rounding of lines that stay; it goes with the next drawing back

template <int decimals>
void put(std::string& text, char letter, std::int64_t value) {
  char buffer[32];
  text += ' ';
  text += letter;
  text.append(buffer, std::size_t(put_fixed<decimals>(buffer, value) - buffer));
}

}  // namespace

Emitter::Emitter(const RecoveredPrint& recovered, const GcodePrint& print, const Config& config,
                 const std::string& header)
    : recovered_(recovered),
      print_(print),
      words_(*words_of(print)),
      config_(config),
      text_(print.text->substr(0, recovered.begin)),
      state_(recovered.states[recovered.begin_state]),
      tool_(recovered.begin_tool),
      z_um_(um_of(recovered.begin_z_mm)),
      count_e5_(recovered.begin_count_e5),
      drawn_back_e5_(recovered.begin_drawn_back_e5) {
  if (!header.empty()) text_.insert(std::min(text_.find('\n'), text_.size() - 1) + 1, header + "\n");
}

void Emitter::line(std::string_view text) {
  text_ += text;
  end_line();
}

void Emitter::lines(std::span<const std::string> all) {
  for (const std::string& text : all) line(text);
}

void Emitter::set(const ModalState& to) {
  lines(lines_between(state_, to));
  for (const auto& [key, text] : to) state_[key] = text;
  known_state_.reset();
}

void Emitter::set_known(std::uint32_t state) {
  if (known_state_ == state) return;
  set(recovered_.states[state]);
  known_state_ = state;
}

void Emitter::forget(std::string_view key) {
  if (const auto found = state_.find(key); found != state_.end()) state_.erase(found);
  known_state_.reset();
}

void Emitter::begin_layer(std::span<const std::string> lines) {
  ++layers_;
  header(lines);
  for (const std::string& text : {recovered_.progress_line, recovered_.silent_progress_line})
    if (!text.empty()) line(text);  // its numbers come later
}

void Emitter::end_layer() {
  if (recovered_.tells_elapsed) line(fmt::format("{}0", words_.elapsed));  // likewise
}

void Emitter::header(std::span<const std::string> all) {
  known_state_.reset();
  for (const std::string& text : all) {
    line(text);
    GcodeLine parsed;
    if (parse_line(text, parsed)) continue;
    if (tool_taken(parsed)) forget_tool();
    if (const auto what = modal_line(parsed)) take(state_, *what, text);
  }
}

void Emitter::forget_tool() {
  std::erase_if(state_, [](const auto& entry) { return is_of_tool(entry.first); });
  known_state_.reset();
}

void Emitter::put_feed(double feed_mm_min) {
  const std::int64_t feed = std::max<std::int64_t>(1, std::llround(feed_mm_min * 1e3));
  if (feed == feed_) return;
  feed_ = feed;
  put<3>(text_, 'F', feed);
}

void Emitter::put_e(std::int64_t delta_e5) {
  count_e5() += delta_e5;
  put<5>(text_, 'E', recovered_.relative_e ? delta_e5 : count_e5());
}

void Emitter::put_place(FilePoint to) {
  if (!known_ || to.x_um != at_.x_um) put<3>(text_, 'X', to.x_um);
  if (!known_ || to.y_um != at_.y_um) put<3>(text_, 'Y', to.y_um);
  at_ = to;
  known_ = true;
}

void Emitter::travel(FilePoint to) {
  if (known_ && to == at_) return;
  if (rises_by_um_ > 0) return rise_on_the_way(to);
  text_ += words_.travel;
  put_place(to);
  put_feed(config_.travel_speed_mm_s * 60);
  end_line();
}

void Emitter::rises_over(double way_um) {
  rise_slope_ = way_um > 0 ? std::max(recovered_.lift_slope, double(rises_by_um_) / way_um) : recovered_.lift_slope;
}

void Emitter::rise_on_the_way(FilePoint to) {
  const std::int64_t by = rises_by_um_, from_z = z_um_ + lift_um_;
  const double possible = rise_slope_ * length_um(at_, to);
  if (possible + 1 < double(by)) {
    const std::int64_t risen = std::llround(possible);
    travel(to, from_z + risen);
    rises_by_um_ = by - risen;
    return;
  }
  const double share = std::min(1., double(by) / possible);
  travel(between(at_, to, share), from_z + by);
  travel(to);
}

void Emitter::travel(FilePoint to, std::int64_t z_um) {
  if (z_known_ && z_um == told_z_um_) {
    rises_by_um_ = 0;
    return travel(to);
  }
  text_ += words_.travel;
  put_place(to);
  put<3>(text_, 'Z', z_um);
  put_feed(config_.travel_speed_mm_s * 60);
  end_line();
  told_z_um_ = z_um;
  z_known_ = true;
  lift_um_ = z_um - z_um_;
  rises_by_um_ = 0;
}

void Emitter::move_z(std::int64_t to_um) {
  if (z_known_ && to_um == told_z_um_) return;
  text_ += "G1";
  put<3>(text_, 'Z', to_um);
  put_feed(60 * (config_.travel_speed_z_mm_s > 0 ? config_.travel_speed_z_mm_s : config_.travel_speed_mm_s));
  end_line();
  told_z_um_ = to_um;
  z_known_ = true;
}

void Emitter::set_z(double z_mm) {
  z_um_ = um_of(z_mm);
  // A lifted nozzle that is above the new layer already stays where it is, as in PrusaSlicer.
  lift_um_ = lift_um_ > 0 && z_known_ ? std::max<std::int64_t>(0, told_z_um_ - z_um_) : 0;
  move_z(z_um_ + lift_um_);
}

void Emitter::take_z(double z_mm) {
  z_um_ = um_of(z_mm);
  lift_um_ = std::max<std::int64_t>(0, told_z_um_ - z_um_);
}

void Emitter::lift(double by_mm) {
  if (is_lifted()) return;
  rises_by_um_ = um_of(by_mm);
  rise_slope_ = recovered_.lift_slope;
  if (recovered_.lift_slope == 0 || !known_) rise_at_once();
}

void Emitter::rise_at_once() {
  if (rises_by_um_ == 0) return;
  lift_um_ += std::exchange(rises_by_um_, 0);
  move_z(z_um_ + lift_um_);
}

void Emitter::rise(std::span<const std::string> spiral) {
  if (spiral.empty()) return;
  rises_by_um_ = 0;
  lines(spiral);
  feed_ = -1;
  GcodeLine last;
  if (!parse_line(spiral.back(), last)) told_z_um_ = um_of(last.value_or('Z', double(z_um_) / 1e3));
  z_known_ = true;
  lift_um_ = told_z_um_ - z_um_;
}

void Emitter::lower() {
  lift_um_ = rises_by_um_ = 0;
  move_z(z_um_);
}

void Emitter::zero_count() {
  if (recovered_.relative_e || recovered_.e_of_each_tool) return;
  line("G92 E0");
  count_e5() = 0;
}

void Emitter::draw_back(std::int64_t to_e5) {
  const std::int64_t more = to_e5 - drawn_back_e5();
  if (more <= 0) return;
  text_ += "G1";
  put_e(-more);
  put_feed(extruder().retract_speed_mm_s * 60);
  end_line();
  back_e5() += more;
  if (recovered_.says_on_and_off) line("M103");
  if (words_.zeroes_e) zero_count();
}

void Emitter::push_forward(std::int64_t to_e5) {
  if (drawn_back_e5() > to_e5 + negligible_e5) feed(drawn_back_e5() - to_e5);
}

void Emitter::feed(std::int64_t by_e5) {
  if (by_e5 <= 0) return draw_back(drawn_back_e5() - by_e5);
  const Extruder& e = extruder();
  if (recovered_.says_on_and_off) line("M101");
  text_ += "G1";
  put_e(by_e5);
  put_feed(60 * (e.deretract_speed_mm_s > 0 ? e.deretract_speed_mm_s : e.retract_speed_mm_s));
  end_line();
  back_e5() = std::max<std::int64_t>(0, drawn_back_e5() - by_e5);
}

void Emitter::road(FilePoint to, std::int64_t filament_e5, double feed_mm_min, const std::optional<RoadArc>& arc) {
  assert(known_ && drawn_back_e5() <= negligible_e5 && lift_um_ == 0);
  if (to == at_ && filament_e5 == 0) return;
  text_ += !arc ? "G1" : arc->clockwise ? "G2" : "G3";
  if (arc || to.x_um != at_.x_um) put<3>(text_, 'X', to.x_um);
  if (arc || to.y_um != at_.y_um) put<3>(text_, 'Y', to.y_um);
  if (arc) put<3>(text_, 'I', arc->center.x_um - at_.x_um), put<3>(text_, 'J', arc->center.y_um - at_.y_um);
  if (filament_e5 != 0) put_e(filament_e5);
  put_feed(feed_mm_min);
  end_line();
  at_ = to;
}

void Emitter::wipe(std::span<const WipeMove> moves) {
  line(words_.wipe_begins);
  for (const WipeMove& move : moves) {
    text_ += "G1";
    put_place(move.to);
    put_e(-move.filament_e5);
    put_feed(move.feed_mm_min);
    end_line();
    back_e5() += move.filament_e5;
  }
  line(words_.wipe_ends);
}

void Emitter::change_tool(int tool) {
  const ToolChanges::Lines* leave = recovered_.changes.leave(tool_);
  change_tool(tool, leave != nullptr ? *leave : ToolChanges::Lines{},
              recovered_.changes.enter(tool, layers_ <= 1, config_.extruders[std::size_t(tool)]));
}

void Emitter::change_tool(int tool, std::span<const std::string> leave, std::span<const std::string> enter) {
  rise_at_once();
  zero_count();
  for (const std::string& text : leave)
    if (!text.empty()) line(text);
  for (const std::string& text : enter) {
    if (text.empty()) continue;
    line(text);
    GcodeLine parsed;
    if (!parse_line(text, parsed) && tool_taken(parsed)) zero_count();
  }
  forget_tool();
  tool_ = tool;
  known_ = z_known_ = false;
  feed_ = -1;
}

void Emitter::fixed(const FixedLines& all) {
  if (!all.lays) {
    const std::span<const std::string> lines = all.lines;
    return change_tool(all.tool_after, lines.first(all.tool_at), lines.subspan(all.tool_at));
  }
  assert(recovered_.relative_e);
  header(all.lines);
  for (std::size_t t = 0; t < drawn_back_e5_.size(); ++t)
    drawn_back_e5_[t] = std::max<std::int64_t>(0, drawn_back_e5_[t] + all.drawn_back_e5[t]);
  tool_ = all.tool_after;
  known_ = z_known_ = false;
  feed_ = -1;
}

std::string Emitter::finish() {
  draw_back(recovered_.end_drawn_back_e5);
  set_known(recovered_.end_state);
  if (!recovered_.relative_e && count_e5() != recovered_.end_count_e5) {
    text_ += "G92";
    const char axis = !recovered_.e_of_each_tool ? 'E' : tool_ == 0 ? 'A' : 'B';
    put<5>(text_, axis, recovered_.end_count_e5);
    end_line();
  }
  if (recovered_.end_feed_mm_min > 0 && std::llround(recovered_.end_feed_mm_min * 1e3) != feed_) {
    text_ += "G1";
    put_feed(recovered_.end_feed_mm_min);
    end_line();
  }
  text_ += std::string_view(*print_.text).substr(recovered_.end);
  return std::move(text_);
}

}  // namespace cleancolor
