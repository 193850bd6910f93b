// reader/filament.hpp
//
// FilamentCounts: what E, A and B of a file push, as lengths of filament.
//
//   E1.5 of a tool  ->  mm of filament, < 0 where it is drawn back
//
// Absolute E is the count of an axis; what is pushed is the difference to the count before. One count serves all tools,
// but where the words that change tools are those of Sailfish each tool has its own.
//
// Relative: after M83, or while G91 holds, unless M82 came after it. G91 means E, too, in Marlin; it does not in
// Klipper, RepRapFirmware and Sailfish. G90 never ends M83: some versions of Marlin do so, but a file that says M83,
// and G91 and G90 around a lift, means to stay relative, or it would have failed on all other firmware.
#pragma once

#include <array>

#include "reader/print.hpp"

namespace cleancolor {

class FilamentCounts {
 public:
  /// Diameters, retraction and flavour as the file's configuration tells them; else 1.75 mm and 1 mm.
  explicit FilamentCounts(const GcodeFacts& facts);

  void m82_or_m83(bool relative);
  void g90_or_g91(bool relative);
  void g90_is_not_about_e() { follows_g91_ = false; }

  /// From now on each tool has its own count; the one so far becomes that of the tool in use.
  void one_for_each_tool(int tool_in_use);

  void set(int tool, double count_mm);
  void set_all_to_zero() { count_mm_.fill(0); }

  /// Returns: mm of filament.
  double pushed_mm(int tool, double told_mm);

  /// E counts mm3 of filament of this diameter; 0: it counts mm again.
  void volumetric(int tool, double diameter_mm);

  /// G10 and G11: what the firmware draws back or pushes by itself; 0 where it has done so before.
  double drawn_back_mm(int tool, bool back);
  void set_drawn_back_mm(double length_mm) { retraction_mm_.fill(length_mm); }
  void set_extra_mm(double length_mm) { extra_mm_ = length_mm; }

  /// Cross-section of each tool's filament.
  const std::array<double, max_tools>& area_mm2() const { return area_mm2_; }

 private:
  std::array<double, max_tools> count_mm_{};  // [0] alone where one serves all
  std::array<double, max_tools> area_mm2_{};
  std::array<double, max_tools> retraction_mm_{};
  std::array<bool, max_tools> is_drawn_back_{};
  double extra_mm_ = 0;  // pushed more than was drawn back
  bool by_m83_ = false, by_g91_ = false;
  bool follows_g91_ = true;
  bool each_tool_ = false;
  bool volumetric_ = false;
};

}  // namespace cleancolor
