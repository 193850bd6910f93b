#include "reader/known_commands.hpp"

#include <algorithm>
#include <array>

namespace cleancolor {
namespace {

// Marlin, RepRapFirmware, Klipper, Sailfish, Prusa, Bambu and what slicers write in their start and end codes.
constexpr int harmless_m[] = {
    0,   1,   2,   3,   4,   5,   7,   8,   9,   10,  11,  17,   18,   20,   21,   22,   23,   24,  25,  26,  27,  28,
    29,  30,  31,  36,  42,  70,  71,  72,  73,  74,  75,  76,   77,   78,   80,   81,   84,   85,  86,  92,  98,  99,
    101, 102, 103, 105, 106, 107, 110, 111, 112, 113, 114, 115,  117,  118,  119,  120,  121,  122, 123, 126, 127, 128,
    129, 130, 131, 134, 136, 137, 138, 139, 140, 141, 142, 143,  144,  145,  146,  148,  149,  150, 151, 152, 153, 154,
    155, 156, 157, 158, 162, 163, 164, 165, 166, 190, 191, 193,  206,  210,  211,  216,  217,  219, 221, 222, 223, 224,
    225, 226, 227, 228, 229, 230, 231, 232, 240, 250, 260, 261,  280,  282,  290,  291,  292,  300, 301, 302, 303, 304,
    305, 306, 307, 308, 309, 310, 320, 321, 322, 340, 350, 351,  355,  360,  361,  362,  363,  364, 365, 376, 380, 381,
    400, 401, 402, 403, 404, 405, 406, 407, 408, 409, 410, 412,  413,  420,  421,  422,  423,  425, 428, 430, 431, 470,
    471, 472, 481, 482, 483, 484, 485, 486, 500, 501, 502, 503,  504,  510,  511,  512,  520,  522, 524, 540, 550, 551,
    552, 553, 554, 555, 556, 557, 558, 559, 560, 561, 562, 563,  564,  565,  567,  569,  570,  571, 572, 573, 574, 575,
    577, 578, 579, 580, 581, 582, 583, 584, 585, 586, 587, 588,  589,  591,  592,  593,  594,  595, 596, 597, 600, 601,
    602, 603, 605, 606, 620, 621, 622, 623, 624, 625, 665, 666,  669,  671,  672,  700,  701,  702, 703, 704, 705, 706,
    707, 708, 709, 710, 771, 772, 851, 860, 861, 862, 863, 864,  865,  866,  867,  868,  869,  871, 876, 900, 905, 906,
    907, 908, 909, 910, 911, 912, 913, 914, 915, 916, 917, 918,  919,  928,  960,  966,  970,  971, 972, 973, 974, 975,
    976, 977, 981, 982, 983, 984, 991, 995, 997, 998, 999, 1002, 1003, 1004, 1005, 1006, 1007, 1009};
static_assert(std::ranges::is_sorted(harmless_m));

// Probes' own settings, lengths of tools, the first workspace, potentiometers of motors, priming on the spot.
constexpr int harmless_g[] = {15, 22, 23, 26, 31, 36, 40, 49, 54, 64, 94, 95, 130, 280, 425};
static_assert(std::ranges::is_sorted(harmless_g));

// Klipper's own and common macros of its users.
constexpr std::array<std::string_view, 27> harmless_words = {"EXCLUDE_OBJECT_DEFINE",
                                                             "EXCLUDE_OBJECT_START",
                                                             "EXCLUDE_OBJECT_END",
                                                             "SET_PRESSURE_ADVANCE",
                                                             "SET_FAN_SPEED",
                                                             "SET_DISPLAY_TEXT",
                                                             "SET_PRINT_STATS_INFO",
                                                             "BED_MESH_PROFILE",
                                                             "BED_MESH_CALIBRATE",
                                                             "BED_MESH_CLEAR",
                                                             "TURN_OFF_HEATERS",
                                                             "SET_PIN",
                                                             "SET_INPUT_SHAPER",
                                                             "SET_RETRACTION",
                                                             "TIMELAPSE_TAKE_FRAME",
                                                             "RESPOND",
                                                             "SAVE_GCODE_STATE",
                                                             "RESTORE_GCODE_STATE",
                                                             "M117",
                                                             "STATUS_READY",
                                                             "SET_IDLE_TIMEOUT",
                                                             "SET_FILAMENT_SENSOR",
                                                             "CLEAR_PAUSE",
                                                             "UPDATE_DELAYED_GCODE",
                                                             "SET_GCODE_VARIABLE",
                                                             "Tx",  // Prusa's MMU: the user chooses
                                                             "Tc"};

}  // namespace

bool is_harmless(const GcodeLine& line) {
  if (line.letter == 'M') return std::ranges::binary_search(harmless_m, line.number);
  if (line.letter == 'G') return std::ranges::binary_search(harmless_g, line.number);
  return std::ranges::find(harmless_words, line.word) != harmless_words.end();
}

}  // namespace cleancolor
