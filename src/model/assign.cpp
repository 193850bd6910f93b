#include "model/assign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"

namespace cleancolor {

namespace {

/// A colour means the same in all files, the name of a material only in its own.
using ColourKey = std::tuple<bool, std::uint32_t, std::size_t, std::string>;

std::optional<ColourKey> colour_key(const Part& part, std::size_t file) {
  if (part.rgb) return ColourKey{true, *part.rgb, 0, {}};
  if (!part.material.empty()) return ColourKey{false, 0, file, part.material};
  return std::nullopt;
}

class Assigner {
 public:
  Assigner(std::span<std::vector<Part>> files, const Assignment& assignment) : files_(files), assignment_(assignment) {
    for (const auto& extruder : assignment.extruder_of_file)
      if (extruder) claimed_.insert(*extruder);
    for (const auto& [rgb, extruder] : assignment.extruder_of_rgb) claimed_.insert(extruder);
  }

  void assign() {
    for (std::size_t f = 0; f < files_.size(); ++f) {
      apply_stated(f);
      if (files_.size() == 1 || undecided_colours(f) > 1) assign_by_colour(f);
      assign_by_file(f);
    }
    require_existing();
  }

 private:
  void apply_stated(std::size_t f) {
    const auto& of_file = assignment_.extruder_of_file;
    for (Part& part : files_[f]) {
      if (f < of_file.size() && of_file[f]) {
        part.extruder = of_file[f];
      } else if (part.rgb) {
        const auto mapped = assignment_.extruder_of_rgb.find(*part.rgb);
        if (mapped != assignment_.extruder_of_rgb.end()) part.extruder = mapped->second;
      }
    }
  }

  std::size_t undecided_colours(std::size_t f) const {
    std::set<ColourKey> keys;
    for (const Part& part : files_[f])
      if (const auto key = colour_key(part, f); key && !part.extruder) keys.insert(*key);
    return keys.size();
  }

  void assign_by_colour(std::size_t f) {
    for (Part& part : files_[f]) {
      const auto key = colour_key(part, f);
      if (part.extruder || !key) continue;
      const auto known = by_colour_.find(*key);
      part.extruder = known != by_colour_.end() ? known->second : next_free();
      by_colour_.emplace(*key, *part.extruder);
    }
  }

  void assign_by_file(std::size_t f) {
    const auto undecided = [](const Part& part) { return !part.extruder.has_value(); };
    if (std::none_of(files_[f].begin(), files_[f].end(), undecided)) return;
    const int extruder = files_.size() == 1 ? 0 : next_free();
    for (Part& part : files_[f])
      if (undecided(part)) part.extruder = extruder;
  }

  int next_free() {
    while (claimed_.contains(next_)) ++next_;
    return next_++;
  }

  void require_existing() const {
    for (const auto& parts : files_)
      for (const Part& part : parts)
        if (*part.extruder < 0 || *part.extruder >= assignment_.extruders)
          throw Error(
              fmt::format("{}: needs extruder {}, but the printer has {}; choose another printer, or say which "
                          "extruder prints it with --extruder N before the file or --map-colour",
                          part.name, *part.extruder + 1, assignment_.extruders));
  }

  std::span<std::vector<Part>> files_;
  const Assignment& assignment_;
  std::set<int> claimed_;
  std::map<ColourKey, int> by_colour_;
  int next_ = 0;
};

}  // namespace

void assign_extruders(std::span<std::vector<Part>> files, const Assignment& assignment) {
  Assigner(files, assignment).assign();
}

}  // namespace cleancolor
