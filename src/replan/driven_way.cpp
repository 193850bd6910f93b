#include "replan/driven_way.hpp"

#include <algorithm>
#include <utility>

#include "replan/refusals.hpp"

namespace cleancolor {

void DrivenWay::drive_to(Vec3 to_mm, std::uint32_t under_state) {
  const auto pushes = [](const FilamentMove& move) { return move.by_e5 > 0; };
  const bool drives_on_drawn_back =
      !filament.empty() && filament.back().after == places.size() && !pushes(filament.back());
  if (drives_on_drawn_back && std::ranges::any_of(filament, pushes)) back_after = places.size();  // before was nothing
  places.push_back(file_point(to_mm));
  z_um.push_back(um_of(to_mm.z));
  if (places.size() == 1) state = under_state;
}

void DrivenWay::move_filament(std::int64_t by_e5) {
  filament.push_back({places.size(), by_e5});
  if (!rises_after) fed_low = filament.size();
  if (by_e5 > 0) return;
  if (!drawn_back) back_after = places.size();
  drawn_back = true;
}

void DrivenWay::leave(std::size_t count, LeftWay& left) {
  const auto stays = std::ranges::find_if(filament, [&](const FilamentMove& move) { return move.after > count; });
  for (auto move = filament.begin(); move != stays; ++move)
    left.filament.push_back({left.places.size() + move->after, move->by_e5});
  fed_low -= std::min(fed_low, std::size_t(stays - filament.begin()));
  filament.erase(filament.begin(), stays);
  for (FilamentMove& move : filament) move.after -= count;
  const auto gone = std::ptrdiff_t(std::min(count, places.size()));
  left.places.insert(left.places.end(), places.begin(), places.begin() + gone);
  places.erase(places.begin(), places.begin() + gone);
  z_um.erase(z_um.begin(), z_um.begin() + gone);
  back_after -= std::min(back_after, std::size_t(gone));
}

RecoveredRun DrivenWay::leads_to(Vec3 begin_mm) {
  RecoveredRun run{.from = file_point(begin_mm),
                   .roads = {},
                   .notes = {},
                   .way = std::move(places),
                   .way_filament = std::move(filament),
                   .way_z_um = rises ? std::move(z_um) : std::vector<std::int64_t>{},
                   .spiral = std::move(spiral),
                   .way_state = state,
                   .lifted = top_z_mm > begin_mm.z + same_height_mm,
                   .drawn_back = drawn_back,
                   .back_after = back_after};
  if (!run.way.empty()) run.way.pop_back();  // its start
  const std::uint32_t under = state;
  *this = {};
  state = under;
  return run;
}

FilePoint DrivenWay::take_last() {
  const FilePoint last = places.back();
  places.pop_back();
  z_um.pop_back();
  return last;
}

}  // namespace cleancolor
