#include "replan/removed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "model/text_scan.hpp"
#include "reader/known_commands.hpp"
#include "replan/kept_shield.hpp"

namespace cleancolor {
namespace {

void erase_run(RecoveredPrint& recovered, const GcodePrint& print, std::size_t layer, std::size_t run) {
  std::vector<RecoveredRun>& runs = recovered.layers[layer].runs;
  if (!runs[run].notes.empty())
    throw Error(fmt::format("{}: layer {}: comments stand before what is to be removed; they would go with it",
                            print.name, layer + 1));
  runs.erase(runs.begin() + std::ptrdiff_t(run));
  if (runs.empty())
    throw Error(fmt::format("{}: layer {} has nothing else than what is to be removed", print.name, layer + 1));
}

bool is_of_tower(std::string_view comment) {
  constexpr std::array<std::string_view, 6> begins = {";---",         "; CP ",      "; layer #",
                                                      "; toolchange", "; material", "; WIPE_TOWER"};
  return std::ranges::any_of(begins, [&](std::string_view begin) { return comment.starts_with(begin); });
}

/// What a change of tools in the tower would be without it.
struct Change {
  int tool = 0;
  std::vector<std::string> leave, enter;
};

class TowerChange {
 public:
  TowerChange(const GcodePrint& print, std::size_t layer) : print_(print), layer_(layer) {}

  void add(const std::string& text) {
    GcodeLine line;
    if (parse_line(text, line)) refuse(text);
    const bool empty = line.letter == 0 && line.word.empty() && line.present == 0;
    const bool tells_progress = line.letter == 'M' && line.number == 73;
    if (modal_line(line) || tells_progress) return;  // roads know what holds for them
    if (line.letter == 'T') return change(text, line.number);
    if (empty) {
      if (!trimmed(text).empty() && !is_of_tower(text)) take(text);
    } else if (line.letter == 'G') {
      const bool known = line.number <= 1 || line.number == 4 || line.number == 92;
      if (!known) refuse(text);
    } else if (is_harmless(line) || line.number == 104 || line.number == 109) {
      take(text);
    } else {
      refuse(text);
    }
  }

  std::optional<Change> result() && { return changes_ == 0 ? std::nullopt : std::optional(std::move(change_)); }

 private:
  [[noreturn]] void refuse(const std::string& text) const {
    throw Error(fmt::format("{}: layer {}: '{}' in the wipe tower: it cannot be removed for sure", print_.name,
                            layer_ + 1, shown(trimmed(text))));
  }
  void change(const std::string& text, int tool) {
    if (++changes_ > 1) refuse(text);
    change_.tool = tool;
    change_.enter.push_back(text);
  }
  void take(const std::string& text) { (changes_ == 0 ? change_.leave : change_.enter).push_back(text); }

  const GcodePrint& print_;
  std::size_t layer_;
  Change change_;
  int changes_ = 0;
};

void require_as_before(bool is_same, int tool, const GcodePrint& print, std::size_t layer) {
  if (is_same) return;
  throw Error(
      fmt::format("{}: layer {}: the change of tool T{} is not as it was before; without the tower it cannot be "
                  "moved",
                  print.name, layer + 1, tool));
}

void require_none_above(const RecoveredPrint& recovered, const GcodePrint& print) {
  if (recovered.prints_after_end)
    throw Error(fmt::format(
        "{}: a tower or shield goes on above the part, where nothing is re-planned; slice without it", print.name));
}

}  // namespace

RemovedFilament remove_shield(RecoveredPrint& recovered, const GcodePrint& print) {
  require_none_above(recovered, print);
  RemovedFilament removed;
  const auto shield = shield_runs(recovered, print);
  for (std::size_t k = 0; k < shield.size(); ++k)
    for (std::size_t n = shield[k].size(); n-- > 0;) {
      const RecoveredRun& run = recovered.layers[k].runs[shield[k][n]];
      for (const RunRoad& road : run.roads) removed[{run.tool, Role::skirt_brim}] += double(road.filament_e5) * 1e-5;
      erase_run(recovered, print, k, shield[k][n]);
    }
  return removed;
}

RemovedFilament remove_tower(RecoveredPrint& recovered, const GcodePrint& print) {
  require_none_above(recovered, print);
  RemovedFilament removed;
  for (std::size_t i = 0; i < print.moves.size(); ++i)
    if (lays_plastic(print, i) && print.moves[i].role == Role::wipe_tower)
      removed[{print.moves[i].feeds, Role::wipe_tower}] += print.moves[i].filament_mm;
  recovered.keeps_tools = false;
  for (std::size_t k = 0; k < recovered.layers.size(); ++k)
    for (std::size_t i = recovered.layers[k].runs.size(); i-- > 0;) {
      const RecoveredRun& run = recovered.layers[k].runs[i];
      if (!run.fixed) {
        if (print.moves[run.roads.front().move].role == Role::wipe_tower) erase_run(recovered, print, k, i);
        continue;
      }
      if (!run.fixed->lays) {
        recovered.keeps_tools = true;
        continue;
      }
      TowerChange lines(print, k);
      for (const std::string& line : run.fixed->lines) lines.add(line);
      if (const auto change = std::move(lines).result()) {
        require_as_before(recovered.changes.take_leave(run.tool, change->leave), run.tool, print, k);
        require_as_before(recovered.changes.take_enter(change->tool, change->enter, k == 0), change->tool, print, k);
      }
      erase_run(recovered, print, k, i);
    }
  return removed;
}

}  // namespace cleancolor
