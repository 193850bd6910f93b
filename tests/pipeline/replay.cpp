#include "replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "toolpath/path.hpp"

namespace cleancolor::test {
namespace {

struct Words {
  std::string_view code;  // "G1"
  std::optional<double> x, y, z, e;
  char e_axis = 'E';
  std::optional<double> t, p, s;
};

/// Splits one line; its text goes on beyond the view, at least by a line end.
Words words_of(std::string_view line) {
  Words words;
  const std::size_t space = std::min(line.find(' '), line.size());
  words.code = line.substr(0, space);
  for (std::size_t at = space; at + 1 < line.size();) {
    if (line[at] == ' ') {
      ++at;
      continue;
    }
    const char letter = line[at];
    char* end = nullptr;
    const double value = std::strtod(line.data() + at + 1, &end);
    if (letter == 'X') words.x = value;
    if (letter == 'Y') words.y = value;
    if (letter == 'Z') words.z = value;
    if (letter == 'T') words.t = value;
    if (letter == 'P') words.p = value;
    if (letter == 'S') words.s = value;
    if (letter == 'E' || letter == 'A' || letter == 'B') words.e = value, words.e_axis = letter;
    at = std::max(std::size_t(end - line.data()), at + 1);
  }
  return words;
}

/// The same name, but of static storage.
std::string_view known_role(std::string_view name) {
  for (int i = 0; i < role_count; ++i)
    if (role_name(Role(i)) == name) return role_name(Role(i));
  return "Custom";
}

class Printer {
 public:
  explicit Printer(const Config& config) : config_(config) {
    const std::size_t tools = config.extruders.size();
    count_.resize(tools), drawn_back_.resize(tools), target_c_.resize(tools);
    printed.filament_mm.resize(tools);
  }

  void line(std::string_view line) {
    if (line.starts_with(';')) return comment(line);
    line = line.substr(0, line.find(';'));
    while (line.ends_with(' ')) line.remove_suffix(1);
    if (line.empty()) return;
    const Words words = words_of(line);
    if (words.code == "G0" || words.code == "G1") return move(words);
    if (words.code == "G90" || words.code == "G91") relative_ = relative_axes_ = words.code == "G91";  // Marlin: E, too
    if (words.code == "M104" || words.code == "M109") heat(words.t, words.s);
    if (words.code == "G10") heat(words.p, words.s);
    if (words.code == "M83") relative_ = true;
    if (words.code == "M82") relative_ = false;
    if (words.code == "G92") std::fill(count_.begin(), count_.end(), 0.0);
    if (words.code == "M73" && words.p) printed.percents.push_back(int(*words.p));
    if (words.code == "M108" && words.t) select(int(*words.t));
    if (words.code.size() > 1 && words.code[0] == 'T' && std::isdigit(words.code[1])) select(words.code[1] - '0');
  }

  Printed printed;

 private:
  void comment(std::string_view line) {
    if (line == ";LAYER_CHANGE") printing_ = true, ++layer_;
    if (line.starts_with(";TYPE:")) role_ = known_role(line.substr(6));
    if (line == ";TYPE:Custom" && layer_ >= 0) printing_ = false;
    if (line.starts_with(";WIDTH:")) width_mm_ = std::strtod(line.data() + 7, nullptr);
    if (line.starts_with(";Z:")) printed.layer_z_mm.push_back(std::strtod(line.data() + 3, nullptr));
  }

  void select(int tool) {
    if (tool < 0 || tool >= int(count_.size())) return;
    tool_ = tool;
    travelled_mm_ = 1e9;  // where the nozzle is now is the firmware's business: a travel must follow
    printed.tools.push_back(tool);
  }

  void heat(std::optional<double> tool, std::optional<double> target_c) {
    const auto t = std::size_t(tool.value_or(tool_));
    if (target_c && t < target_c_.size()) target_c_[t] = *target_c;
  }

  void move(const Words& words) {
    const Vec2 from = at_;
    const double z = z_;
    if (relative_axes_) {
      at_ = {at_.x + words.x.value_or(0), at_.y + words.y.value_or(0)};
      z_ += words.z.value_or(0);
    } else {
      at_ = {words.x.value_or(at_.x), words.y.value_or(at_.y)};
      z_ = words.z.value_or(z_);
    }
    const double moved = distance(from, at_);
    const double fed = words.e ? fed_by(words) : 0;
    if (!printing_) return;
    if (moved == 0) {
      require(fed <= 0 || z == z_, "extrudes while it goes up or down");
      drawn_back_[std::size_t(tool_)] -= fed;
    } else if (words.e) {
      lay(from, fed);
    } else {
      if (travelled_mm_ == 0) drawn_back_before_ = drawn_back_[std::size_t(tool_)] > 1e-9;
      travelled_mm_ += moved;
      printed.travels.push_back({tool_, at_ + shift(), z_, printed.roads.size()});
    }
  }

  double fed_by(const Words& words) {
    require(words.e_axis == 'E' || words.e_axis == 'A' + tool_, "moves the filament of another tool");
    if (relative_) return *words.e;
    const double fed = *words.e - count_[std::size_t(tool_)];
    // One common counter, or one of each tool (A and B).
    if (words.e_axis == 'E') std::fill(count_.begin(), count_.end(), *words.e);
    count_[std::size_t(tool_)] = *words.e;
    return fed;
  }

  void lay(Vec2 from, double fed) {
    const Extruder& extruder = config_.extruders[std::size_t(tool_)];
    require(fed > -1e-9, "draws back while it moves");
    require(std::abs(drawn_back_[std::size_t(tool_)]) < 1e-4, "extrudes with the filament drawn back");
    require(drawn_back_before_ || travelled_mm_ < extruder.retract_before_travel_mm + 1e-6 || travelled_mm_ >= 1e9,
            "travels far without drawing back");
    require(travelled_mm_ != 1e9, "prints right after a tool change, without a travel");
    require(!printed.layer_z_mm.empty() && std::abs(z_ - printed.layer_z_mm.back()) < 1e-3,
            "extrudes beside the height of its layer");
    require(target_c_[std::size_t(tool_)] > 0, "extrudes with its heater off");
    require(reached(from + shift()) && reached(at_ + shift()), "extrudes where its nozzle cannot go");
    travelled_mm_ = 0;
    drawn_back_before_ = false;
    printed.filament_mm[std::size_t(tool_)] += fed;
    if (!printed.percents.empty() && printed.percents.back() >= 100) printed.roads_after_100_percent = true;
    printed.roads.push_back({tool_, role_, from + shift(), at_ + shift(), z_, width_mm_, fed, layer_});
  }

  /// Within the box of the area that the profile grants the nozzle.
  bool reached(Vec2 p) const {
    const auto& own = config_.extruders[std::size_t(tool_)].extruder_printable_area_mm;
    Box<Vec2> box;
    for (const Vec2 corner : own.empty() ? config_.bed_shape_mm : own) box.add(corner);
    constexpr double rounding_mm = 1e-3;
    return p.x >= box.min.x - rounding_mm && p.x <= box.max.x + rounding_mm && p.y >= box.min.y - rounding_mm &&
           p.y <= box.max.y + rounding_mm;
  }

  Vec2 shift() const {
    return config_.offsets_in == OffsetsIn::slicer ? config_.extruders[std::size_t(tool_)].nozzle_offset_mm : Vec2{};
  }

  void require(bool kept, const char* rule) {
    if (kept || printed.broken.size() >= 10) return;
    printed.broken.push_back(fmt::format("layer {}, T{}, X {:.3f} Y {:.3f}: {}", layer_, tool_, at_.x, at_.y, rule));
  }

  const Config& config_;
  Vec2 at_;  // as in the file
  double z_ = 0;
  int tool_ = 0, layer_ = -1;
  bool relative_ = false, printing_ = false;  // of E
  bool relative_axes_ = false;                // of X, Y and Z
  std::vector<double> count_, drawn_back_;
  std::vector<double> target_c_;  // of each nozzle's heater
  double travelled_mm_ = 0;       // since the last road
  bool drawn_back_before_ = false;
  std::string_view role_ = "Custom";
  double width_mm_ = 0;
};

}  // namespace

Printed replayed(std::string_view text, const Config& config) {
  Printer printer(config);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    printer.line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::move(printer.printed);
}

std::vector<double> footer_numbers(std::string_view text, std::string_view name) {
  const std::string key = fmt::format("\n; {} = ", name);
  const std::size_t at = text.rfind(key);
  if (at == text.npos) return {};
  std::vector<double> numbers;
  const char* next = text.data() + at + key.size();
  for (char* end = nullptr;; next = end + 1) {
    numbers.push_back(std::strtod(next, &end));
    if (*end != ',') return numbers;
  }
}

std::vector<PrintedPath> paths_of(const Printed& printed) {
  std::vector<PrintedPath> paths;
  const PrintedRoad* before = nullptr;
  for (const PrintedRoad& road : printed.roads) {
    if (!before || before->to != road.from || before->z != road.z || before->tool != road.tool)
      paths.push_back({road.tool, road.role, road.layer, road.z, {road.from}, 0});
    paths.back().points.push_back(road.to);
    paths.back().length_mm += distance(road.from, road.to);
    before = &road;
  }
  return paths;
}

}  // namespace cleancolor::test
