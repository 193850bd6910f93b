#include "replan/driven_way.hpp"

#include <algorithm>
#include <utility>

#include "replan/refusals.hpp"

namespace cleancolor {

void DrivenWay::drive_to(Vec3 to_mm, std::uint32_t under_state) {
  if (again_from == places.size()) {  // it drives on drawn back: what came before was nothing
    back_after = *again_from;
    again_from.reset();
    forward_after.reset();
  }
  places.push_back(file_point(to_mm));
  z_um.push_back(um_of(to_mm.z));
  if (places.size() == 1) state = under_state;
}

void DrivenWay::draw_back() {
  if (!drawn_back) back_after = places.size();
  drawn_back = true;
}

std::vector<FilePoint> DrivenWay::leave(std::size_t count) {
  const auto gone = std::ptrdiff_t(std::min(count, places.size()));
  std::vector<FilePoint> left(places.begin(), places.begin() + gone);
  places.erase(places.begin(), places.begin() + gone);
  z_um.erase(z_um.begin(), z_um.begin() + gone);
  back_after -= std::min(back_after, left.size());
  again_after -= std::min(again_after, left.size());
  if (again_from) *again_from -= std::min(*again_from, left.size());
  if (forward_after) *forward_after -= std::min(*forward_after, left.size());
  return left;
}

RecoveredRun DrivenWay::leads_to(Vec3 begin_mm) {
  RecoveredRun run{.from = file_point(begin_mm),
                   .roads = {},
                   .notes = {},
                   .way = std::move(places),
                   .way_z_um = rises ? std::move(z_um) : std::vector<std::int64_t>{},
                   .spiral = std::move(spiral),
                   .way_state = state,
                   .leaving = {},
                   .lifted = top_z_mm > begin_mm.z + same_height_mm,
                   .drawn_back = drawn_back,
                   .back_after = back_after,
                   .forward_after = forward_after.value_or(~std::size_t{0}),
                   .pushes_at_change = pushes_at_change,
                   .again_e5 = again_e5,
                   .again_after = again_after};
  if (!run.way.empty()) run.way.pop_back();  // its start
  *this = {.state = state};
  return run;
}

FilePoint DrivenWay::take_last() {
  const FilePoint last = places.back();
  places.pop_back();
  z_um.pop_back();
  return last;
}

}  // namespace cleancolor
