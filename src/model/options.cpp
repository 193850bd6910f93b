#include "model/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "base/error.hpp"
#include "model/option_table.hpp"

namespace cleancolor {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view flavours[] = {"marlin2", "klipper", "reprapfirmware", "sailfish"};
constexpr std::string_view offsets_in[] = {"slicer", "firmware"};
constexpr std::string_view idle_nozzles[] = {"same_height", "lifted", "parked", "docked"};
constexpr std::string_view seam_positions[] = {"nearest", "aligned", "rear", "random", "hidden"};
constexpr std::string_view fill_patterns[] = {"rectilinear", "grid", "gyroid", "concentric"};
constexpr std::string_view brim_types[] = {"no_brim", "outer_only"};
constexpr std::string_view rampart_shapes[] = {"auto", "conforming", "vertical", "off"};
constexpr std::string_view rampart_walls[] = {"double", "split"};
constexpr std::string_view rampart_orders[] = {"before_run", "layer_start"};
constexpr std::string_view planners[] = {"clean", "paper", "plain"};
constexpr std::string_view efforts[] = {"fast", "normal", "best"};
constexpr std::string_view print_orders[] = {"exposure", "few_changes", "paper"};
constexpr std::string_view refill_modes[] = {"fixed", "model", "off"};

std::span<const std::string_view> names_of(Flavour) {
  return flavours;
}
std::span<const std::string_view> names_of(OffsetsIn) {
  return offsets_in;
}
std::span<const std::string_view> names_of(IdleNozzle) {
  return idle_nozzles;
}
std::span<const std::string_view> names_of(SeamPosition) {
  return seam_positions;
}
std::span<const std::string_view> names_of(FillPattern) {
  return fill_patterns;
}
std::span<const std::string_view> names_of(BrimType) {
  return brim_types;
}
std::span<const std::string_view> names_of(RampartShape) {
  return rampart_shapes;
}
std::span<const std::string_view> names_of(RampartWalls) {
  return rampart_walls;
}
std::span<const std::string_view> names_of(RampartOrder) {
  return rampart_orders;
}
std::span<const std::string_view> names_of(Planner) {
  return planners;
}
std::span<const std::string_view> names_of(Effort) {
  return efforts;
}
std::span<const std::string_view> names_of(PrintOrder) {
  return print_orders;
}
std::span<const std::string_view> names_of(RefillMode) {
  return refill_modes;
}

// The type of the value that a field holds.
template <class T>
struct Tag {
  using type = T;
};
template <class T, class Owner>
Tag<T> tag_of(T Owner::*) {
  return {};
}
Tag<double> tag_of(MachineAxis) {
  return {};
}
template <class Field>
using ValueType = typename decltype(tag_of(std::declval<Field>()))::type;

template <class ConfigType, class T>
auto& place(ConfigType& config, std::size_t, T Config::* member) {
  return config.*member;
}
template <class ConfigType, class T>
auto& place(ConfigType& config, std::size_t extruder, T Extruder::* member) {
  assert(extruder < config.extruders.size());
  return config.extruders[extruder].*member;
}
template <class ConfigType>
auto& place(ConfigType& config, std::size_t, MachineAxis member) {
  return config.*member.vector.*member.axis;
}

OptionKind kind_of(Tag<bool>) {
  return OptionKind::flag;
}
OptionKind kind_of(Tag<int>) {
  return OptionKind::integer;
}
OptionKind kind_of(Tag<double>) {
  return OptionKind::number;
}
OptionKind kind_of(Tag<std::string>) {
  return OptionKind::text;
}
OptionKind kind_of(Tag<LengthOrShare>) {
  return OptionKind::length_or_share;
}
OptionKind kind_of(Tag<Vec2>) {
  return OptionKind::point;
}
OptionKind kind_of(Tag<std::vector<Vec2>>) {
  return OptionKind::polygon;
}
template <class Enum>
  requires std::is_enum_v<Enum>
OptionKind kind_of(Tag<Enum>) {
  return OptionKind::choice;
}

constexpr double max_share = 10;      // 1000%
constexpr double least_share = 0.01;  // 1%, where the option must be above 0

// What is wrong with the number, or "".
std::string range_fault(const Option& option, double value, double shown) {
  if (!std::isfinite(value)) return "is not a finite number";
  if (shown >= option.min && shown <= option.max) return "";
  const std::string_view unit = option.kind() == OptionKind::length_or_share ? "" : option.unit;
  return fmt::format("{:g} is out of range; it must lie between {:g} and {:g}{}{}", shown, option.min, option.max,
                     unit.empty() ? "" : " ", unit);
}

std::string point_fault(const Option& option, Vec2 p) {
  const std::string fault = range_fault(option, p.x, p.x);
  return fault.empty() ? range_fault(option, p.y, p.y) : fault;
}

std::string value_fault(const Option& option, const OptionValue& value) {
  switch (option.kind()) {
    case OptionKind::integer:
      return range_fault(option, std::get<int>(value), std::get<int>(value));
    case OptionKind::number:
      return range_fault(option, std::get<double>(value), std::get<double>(value));
    case OptionKind::percent:
      return range_fault(option, std::get<double>(value), std::get<double>(value) * 100);
    case OptionKind::length_or_share: {
      const auto v = std::get<LengthOrShare>(value);
      if (!v.is_share) return range_fault(option, v.value, v.value);
      const double min_share = option.min > 0 ? least_share : 0;
      if (v.value >= min_share && v.value <= max_share) return "";
      return fmt::format("{:g}% is out of range; it must lie between {:g}% and {:g}%", v.value * 100, min_share * 100,
                         max_share * 100);
    }
    case OptionKind::point:
      return point_fault(option, std::get<Vec2>(value));
    case OptionKind::polygon:
      for (const Vec2 p : std::get<std::vector<Vec2>>(value)) {
        if (const std::string fault = point_fault(option, p); !fault.empty()) return fault;
      }
      return "";
    case OptionKind::text:
      return std::get<std::string>(value).find('\0') == std::string::npos ? "" : "contains a zero byte";
    case OptionKind::flag:
    case OptionKind::choice:
      return "";
  }
  return "";
}

// Levenshtein distance: letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

}  // namespace

OptionKind Option::kind() const {
  const OptionKind kind = std::visit([](auto member) { return kind_of(tag_of(member)); }, field);
  return kind == OptionKind::number && unit == "%"sv ? OptionKind::percent : kind;
}

bool Option::per_extruder() const {
  return std::visit(
      []<class Field>(Field) {
        if constexpr (std::is_same_v<Field, MachineAxis>) {
          return false;
        } else {
          return std::is_same_v<Field, ValueType<Field> Extruder::*>;
        }
      },
      field);
}

std::span<const std::string_view> Option::choices() const {
  return std::visit(
      []<class Field>(Field) -> std::span<const std::string_view> {
        if constexpr (std::is_enum_v<ValueType<Field>>) {
          return names_of(ValueType<Field>{});
        } else {
          return {};
        }
      },
      field);
}

std::span<const Option> options() {
  return option_table();
}

const Option* find_option(std::string_view name) {
  const auto found = std::ranges::find(options(), name, &Option::name);
  return found == options().end() ? nullptr : &*found;
}

std::string did_you_mean(std::string_view name) {
  if (name.size() > 100) return "";
  const auto distance = [&](const Option& o) { return edit_distance(name, o.name); };
  const Option& nearest = *std::ranges::min_element(options(), {}, distance);
  const bool is_near = distance(nearest) <= std::max<std::size_t>(2, name.size() / 4);
  return is_near ? fmt::format("; did you mean '{}'?", nearest.name) : "";
}

OptionValue option_value(const Config& config, const Option& option, std::size_t extruder) {
  return std::visit(
      [&]<class Field>(Field member) -> OptionValue {
        const auto& value = place(config, extruder, member);
        if constexpr (std::is_enum_v<ValueType<Field>>) {
          return static_cast<int>(value);
        } else {
          return value;
        }
      },
      option.field);
}

void store_option(Config& config, const Option& option, std::size_t extruder, OptionValue value,
                  std::string_view where) {
  const std::string fault = value_fault(option, value);
  if (!fault.empty()) throw Error(fmt::format("{}{}: {}", where, option.name, fault));
  std::visit(
      [&]<class Field>(Field member) {
        using T = ValueType<Field>;
        if constexpr (std::is_enum_v<T>) {
          place(config, extruder, member) = static_cast<T>(std::get<int>(value));
        } else {
          place(config, extruder, member) = std::get<T>(std::move(value));
        }
      },
      option.field);
}

void set_extruder_count(Config& config, std::size_t count) {
  assert(count > 0 && !config.extruders.empty());
  config.extruders.resize(count, Extruder(config.extruders.back()));
}

std::string_view group_name(OptionGroup group) {
  switch (group) {
    case OptionGroup::printer:
      return "printer";
    case OptionGroup::material:
      return "material";
    case OptionGroup::print:
      return "print";
  }
  return "";
}

}  // namespace cleancolor
