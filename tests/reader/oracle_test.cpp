// The reader against a slow, obvious one: positions, tools and net filament of random G-code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include "reader/read.hpp"

namespace cleancolor {
namespace {

/// What a printer has done after the whole file: a word at a time, one case at a time.
struct SlowPrinter {
  std::map<char, double> at = {{'X', 0}, {'Y', 0}, {'Z', 0}}, origin = {{'X', 0}, {'Y', 0}, {'Z', 0}};
  double count = 0;
  std::array<double, max_tools> net{};
  int tool = 0;
  bool relative = false, m83 = false, g91_of_e = false, inches = false;
  std::array<bool, max_tools> drawn_back{};

  void run(const std::string& line) {
    std::istringstream words(line.substr(0, line.find(';')));
    std::string command, word;
    words >> command;
    std::map<char, double> told;
    while (words >> word) told[word[0]] = std::stod(word.substr(1)) * (inches ? 25.4 : 1);

    if (command == "G0" || command == "G1") {
      for (const auto& [letter, value] : told) {
        if (letter == 'F') continue;
        if (letter == 'E') {
          const bool more = m83 || g91_of_e;
          net[std::size_t(tool)] += more ? value : value - count;
          count = more ? count + value : value;
        } else {
          at[letter] = relative ? at[letter] + value : origin[letter] + value;
        }
      }
    } else if (command == "G92") {
      if (told.empty()) told = {{'X', 0}, {'Y', 0}, {'Z', 0}, {'E', 0}};
      for (const auto& [letter, value] : told) {
        if (letter == 'E') count = value;
        if (letter != 'E') origin[letter] = at[letter] - value;
      }
    } else if (command == "G10" || command == "G11") {
      const bool back = command == "G10";
      if (drawn_back[std::size_t(tool)] != back) net[std::size_t(tool)] += back ? -1 : 1;
      drawn_back[std::size_t(tool)] = back;
    } else if (command == "G20" || command == "G21") {
      inches = command == "G20";
    } else if (command == "G90" || command == "G91") {
      relative = g91_of_e = command == "G91";
    } else if (command == "M82" || command == "M83") {
      m83 = command == "M83";
      g91_of_e = false;
    } else if (command[0] == 'T') {
      tool = std::stoi(command.substr(1));
    }
  }
};

class RandomGcode {
 public:
  explicit RandomGcode(unsigned seed) : random_(seed) {}

  std::string line() {
    switch (random_() % 40) {
      case 0:
        return "G90";
      case 1:
        return "G91";
      case 2:
        return "M82";
      case 3:
        return "M83";
      case 4:
        return random_() % 3 == 0 ? "G20" : "G21";
      case 5:
      case 6:
        return fmt::format("T{}", random_() % 4);
      case 7:
        return "G92" + words("XYZ", 3) + words("E", 2);
      case 8:
        return "G92 E0";
      case 9:
        return "G10";
      case 10:
        return "G11";
      case 11:
        return ";TYPE:Perimeter";
      case 12:
        return "M106 S200 ; fan";
      default:
        return (random_() % 4 == 0 ? "G0" : "G1") + words("XYZEF", 2);
    }
  }

 private:
  /// Each letter once in `rarely` cases or so, with a number as slicers write them.
  std::string words(std::string_view letters, unsigned rarely) {
    std::string text;
    for (const char letter : letters) {
      if (random_() % rarely != 0) continue;
      const int thousandths = int(random_() % 40001) - 20000;
      text += fmt::format(" {}{:.3f}", letter, thousandths / 1000.0);
    }
    return text;
  }

  std::mt19937 random_;
};

TEST(ReaderOracle, AgreesOnRandomGcode) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomGcode random(seed);
    SlowPrinter slow;
    std::string text;
    const auto add = [&](const std::string& line) {
      text += line + "\n";
      slow.run(line);
    };
    for (const char* line : {"G1 X0 Y0 Z0 E0", "G1 X10 E1"}) add(line);
    for (int i = 0; i < 200; ++i) add(random.line());

    const GcodePrint print = read_gcode(text, "random.gcode");
    std::array<double, max_tools> net{};
    for (const GcodeMove& move : print.moves) net[move.feeds] += move.filament_mm;
    for (std::size_t tool = 0; tool < max_tools; ++tool) ASSERT_NEAR(net[tool], slow.net[tool], 1e-6) << "T" << tool;
    const Vec3 at = print.moves.back().to_mm;
    ASSERT_NEAR(at.x, slow.at['X'], 1e-6);
    ASSERT_NEAR(at.y, slow.at['Y'], 1e-6);
    ASSERT_NEAR(at.z, slow.at['Z'], 1e-6);
  }
}

}  // namespace
}  // namespace cleancolor
