// replan/attempts.hpp
//
// Attempts: a print planned in several ways, and the one of them that is worth most (replan/worth.hpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "replan/recovered.hpp"
#include "replan/removed.hpp"
#include "replan/replan.hpp"
#include "replan/scene.hpp"
#include "replan/worth.hpp"
#include "visibility/visibility.hpp"

namespace cleancolor {

/// Begins the line in the head of a re-planned file.
inline constexpr std::string_view replanned_mark = "; replanned by cleancolor ";

/// The print as one plan makes it.
struct Attempt {
  GcodePrint print = {};  // with its text
  bool has_rampart = false, stands_apart = false;
  Cleanness before = {}, cleanness = {};   // where it was judged: of the file, of this
  std::vector<std::string> warnings = {};  // that hold for this one
};

class Attempts {
 public:
  /// Throws Error for files that cannot be re-planned for sure.  Requires: what is given lives as long.
  Attempts(const GcodePrint& print, const AuditMachine& machine, const ReplanRequest& request,
           const Progress& progress);

  /// In the file's own order, on its own ways. Throws Error where the result would not be the same print.
  Attempt kept() const;

  /// Throws likewise.
  Attempt with(RampartExtent extent) const;

  /// The one that costs least, judged; nothing where the file itself does.
  std::optional<Attempt> best() const;

  bool tells_progress() const { return !recovered_.progress_line.empty() || recovered_.tells_elapsed; }

  /// What the user may try where nothing is handed out; begins with a comma, or is empty.
  std::string advice() const;

  /// Of plastic: shield and tower.
  double removed_mm3() const;

 private:
  Attempt planned(RampartExtent extent) const;
  Attempt judged(RampartExtent extent) const;
  GcodePrint read(std::string text) const;
  void require_same(const GcodePrint& made) const;
  const GcodePrint& source() const { return with_roles_ ? *with_roles_ : print_; }

  const GcodePrint& print_;
  const AuditMachine& machine_;
  const ReplanRequest& request_;
  const Progress& progress_;
  Config config_;
  std::optional<GcodePrint> with_roles_;  // where the file tells none
  RecoveredPrint recovered_;
  Scene scene_;  // but where the order is kept
  std::optional<SurfaceVisibility> visibility_;
  RemovedFilament removed_;
};

}  // namespace cleancolor
