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

/// "#00FF00, #FF0000"; the rest only counted where they are many.
std::string listed(const std::set<std::uint32_t>& colours) {
  constexpr std::size_t most = 16;
  std::string text;
  std::size_t count = 0;
  for (const std::uint32_t rgb : colours) {
    if (count == most) return fmt::format("{} and {} more", text, colours.size() - most);
    text += fmt::format("{}#{:06X}", count++ == 0 ? "" : ", ", rgb);
  }
  return text;
}

class Assigner {
 public:
  Assigner(std::span<std::vector<Part>> files, const Assignment& assignment, const Progress& progress)
      : files_(files), assignment_(assignment), progress_(progress) {
    for (const auto& extruder : assignment.extruder_of_file)
      if (extruder) claimed_.insert(*extruder);
    for (const auto& [rgb, extruder] : assignment.extruder_of_rgb) claimed_.insert(extruder);
  }

  void assign() {
    require_known_mappings();
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
    if (files_[f].size() > 1 && std::all_of(files_[f].begin(), files_[f].end(), says_nothing))
      warn_of_silence(f, extruder);
    for (Part& part : files_[f])
      if (undecided(part)) part.extruder = extruder;
  }

  static bool says_nothing(const Part& part) { return !part.extruder && !part.rgb && part.material.empty(); }

  void warn_of_silence(std::size_t f, int extruder) const {
    if (assignment_.extruders < 2) return;
    const std::string& name = files_[f].front().name;
    progress_.warn(fmt::format("{}: {} parts without colour or extruder, all printed by extruder {}",
                               name.substr(0, name.find(": ")), files_[f].size(), extruder + 1));
  }

  int next_free() {
    while (claimed_.contains(next_)) ++next_;
    return next_++;
  }

  void require_known_mappings() const {
    const std::set<std::uint32_t> colours = colours_of_parts();
    for (const auto& [rgb, extruder] : assignment_.extruder_of_rgb) {
      const std::string mapping = fmt::format("--map-colour #{:06X}={}", rgb, extruder + 1);
      if (extruder < 0 || extruder >= assignment_.extruders)
        throw Error(fmt::format("{}: the printer has {} extruder{}; choose another printer or another extruder",
                                mapping, assignment_.extruders, assignment_.extruders == 1 ? "" : "s"));
      if (colours.empty())
        throw Error(fmt::format("{}: no part has a colour; use --extruder N before a file", mapping));
      if (!colours.contains(rgb))
        throw Error(fmt::format("{}: no part has this colour; there {} {}", mapping, colours.size() == 1 ? "is" : "are",
                                listed(colours)));
    }
  }

  std::set<std::uint32_t> colours_of_parts() const {
    std::set<std::uint32_t> colours;
    for (const auto& parts : files_)
      for (const Part& part : parts)
        if (part.rgb) colours.insert(*part.rgb);
    return colours;
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
  const Progress& progress_;
  std::set<int> claimed_;
  std::map<ColourKey, int> by_colour_;
  int next_ = 0;
};

}  // namespace

void assign_extruders(std::span<std::vector<Part>> files, const Assignment& assignment, const Progress& progress) {
  Assigner(files, assignment, progress).assign();
}

}  // namespace cleancolor
