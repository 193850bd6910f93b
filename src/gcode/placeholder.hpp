// gcode/placeholder.hpp
//
// Placeholders: start, end, tool-change and layer G-code with names of options and of the print's state in it.
//
//   "M104 S{first_layer_temperature[initial_extruder]} ; [layer_num]"  ->  "M104 S215 ; 0"
//
// As in PrusaSlicer: [name] and [name_0] (of extruder 0) anywhere; {expression} with numbers, "texts", names,
// name[index],
// + - * / %, comparisons, and or not, min max round int, condition ? a : b; {if c}...{elsif c}...{else}...{endif}.
// A name is that of any option, or of a value set here. A list without an index is that of the current extruder; an
// index out of range takes the first value.
//
// Source: PrusaSlicer's documentation, "Macros"; regular expressions, {local} and {global} are not known here.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "model/config.hpp"

namespace cleancolor {

class Placeholders {
 public:
  explicit Placeholders(const Config& config) : config_(&config) {}  // kept: the config must live as long

  void set(const std::string& name, const std::string& text) { texts_[name] = text; }
  void set(const std::string& name, double value);
  void set(const std::string& name, std::span<const double> values);
  void set_current_extruder(int extruder) { current_extruder_ = extruder; }

  /// The template with every placeholder replaced. Throws Error naming the template (by its option) and the place.
  std::string filled_in(std::string_view text, std::string_view option_name) const;

  /// The text of a value; nullopt: no such name. index: absent, of the current extruder.
  std::optional<std::string> value(std::string_view name, std::optional<int> index) const;

 private:
  const Config* config_;
  std::map<std::string, std::string, std::less<>> texts_;
  int current_extruder_ = 0;
};

}  // namespace cleancolor
