#include "cli/slice_arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "base/error.hpp"
#include "cli/words.hpp"
#include "model/options.hpp"

namespace cleancolor {

const char* const slice_description =
    "Slices meshes (STL, OBJ, PLY, AMF, 3MF) and writes one G-code file.\n"
    "\n"
    "Each mesh file is printed by one extruder, in the order given, from extruder 1 on. A 3MF or AMF file may say\n"
    "itself which extruder prints which part; else each colour takes the next extruder in order of first use.\n"
    "\n"
    "Options hold in this order, the later over the earlier: defaults, --printer, --material, --print, --load, "
    "--set.\n";

const char* const azimuth_description =
    "Shows by how much to turn the parts so that idle nozzles hover least over another colour.\n"
    "\n"
    "Two curves over 360 degrees: the seconds that idle nozzles spend over visible plastic of another colour, by "
    "which\n"
    "'cleancolor slice' turns the parts, and the volume of all places that they pass over (Clean color, section 4).\n";

namespace {

constexpr const char* azimuth_footer =
    "Examples:\n"
    "  cleancolor azimuth ocean.stl land.stl --printer replicator-dual -o azimuth.svg\n"
    "  cleancolor azimuth robot.3mf --printer my.toml --json\n"
    "\n"
    "--json prints one object: chosen_deg, best_deg (by exposure), least_interference_deg (null where no angle leaves\n"
    "room), part_mm3, and by whole degrees from 0 to 359 the lists exposure_s, interference_mm3 and fits.\n"
    "\n";

constexpr const char* slice_footer =
    "Examples:\n"
    "  cleancolor slice ocean.stl land.stl -o globe.gcode --printer replicator-dual\n"
    "  cleancolor slice --extruder 2 lid.stl --extruder 1 box.stl --printer generic-dual-klipper\n"
    "  cleancolor slice robot.3mf --printer klipper-idex --material petg --material pva\n"
    "  cleancolor slice robot.3mf --printer my.toml --map-colour '#FF0000=2' --set temperature=230,205\n"
    "  cleancolor slice part.stl --load prusa.ini --print fine --rotate 30 --preview part.png\n"
    "\n"
    "--json prints one object instead of the table:\n"
    "  {\"output\": file, \"layers\": n, \"tool_changes\": n, \"time_s\": seconds without heating,\n"
    "   \"extruders\": [{\"extruder\": from 1, \"filament_mm\": n, \"filament_g\": n, \"cost\": n}],\n"
    "   \"azimuth_deg\": turned by, \"rampart_g\": n, \"warnings\": [text]}\n"
    "\n";

// Extruders are numbered from 1 where people see them, from 0 inside.
int extruder_index(std::string_view text, std::string_view option) {
  int number = 0;
  if (!parse_whole(text, number) || number < 1 || number > int(max_extruders)) {
    throw Error(
        fmt::format("{}: '{}' is not an extruder; they are numbered from 1 to {}", option, text, max_extruders));
  }
  return number - 1;
}

std::pair<std::uint32_t, int> colour_mapping(std::string_view text) {
  const std::size_t equals = text.find('=');
  std::uint32_t rgb = 0;
  const std::string_view colour = text.substr(0, equals);
  const bool is_colour = colour.size() == 7 && colour[0] == '#' && colour.find_first_of("+-") == colour.npos;
  const char* end = text.data() + colour.size();
  if (equals == text.npos || !is_colour || std::from_chars(colour.data() + 1, end, rgb, 16).ptr != end) {
    throw Error(
        fmt::format("--map-colour: '{}' is not like '#FF8000=2', a colour and the extruder that prints it", text));
  }
  return {rgb, extruder_index(text.substr(equals + 1), "--map-colour")};
}

Vec2 center_of(std::string_view text) {
  const std::size_t comma = text.find(',');
  Vec2 center;
  if (comma == text.npos || !parse_whole(text.substr(0, comma), center.x) ||
      !parse_whole(text.substr(comma + 1), center.y) || !std::isfinite(center.x) || !std::isfinite(center.y)) {
    throw Error(fmt::format("--center: '{}' is not a point such as 100,75", text));
  }
  return center;
}

// allow_extra_args(false): an option that may come again takes one word at a time, or it would swallow the files.
void add_printing(CLI::App& app, SliceTexts& texts) {
  Settings& settings = texts.command.settings;
  const char* group = "What to print with";
  app.add_option("--printer", settings.printer, "printer: a name from 'cleancolor profiles', or a .toml file")
      ->type_name("NAME|FILE.toml")
      ->group(group);
  app.add_option("--material", settings.materials, "material, once for each extruder; the last one holds for the rest")
      ->type_name("NAME|FILE.toml")
      ->group(group)
      ->allow_extra_args(false);
  app.add_option("--print", settings.print, "print settings")->type_name("NAME|FILE.toml")->group(group);
  app.add_option("--load", settings.load, "configuration of PrusaSlicer or Slic3r: an .ini, or G-code that ends in one")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--protect", texts.protect,
                 "what keeps the colours apart: nothing, azimuth and rampart, or these and the planner of travel (the "
                 "default); --azimuth, --rampart and --planner beside it count more")
      ->type_name("none|rampart|full")
      ->group(group);
  app.add_option("--rampart", texts.rampart,
                 "walls that wipe and fill nozzles: following the part, straight up, or none; short for --set rampart")
      ->type_name("conforming|vertical|off")
      ->group(group);
  app.add_option("--planner", texts.planner,
                 "ways and starts that keep colours clean, the paper's to the letter, or the nearest path next; short "
                 "for --set planner, which counts more")
      ->type_name("clean|paper|plain")
      ->group(group);
  app.add_option("--effort", texts.effort,
                 "how long cleaner orders are searched for; short for --set effort, which counts more")
      ->type_name("fast|normal|best")
      ->group(group);
  app.add_option("--set", settings.set, "one option, such as layer_height=0.2; repeatable; see 'cleancolor options'")
      ->type_name("NAME=VALUE")
      ->group(group)
      ->allow_extra_args(false);
}

void add_parts(CLI::App& app, SliceTexts& texts) {
  const char* group = "Parts and where they stand";
  texts.file_option = app.add_option("files", texts.files, "mesh files")->type_name("FILE");
  texts.extruder_option =
      app.add_option("--extruder", texts.extruders, "extruder that prints the files that follow, from 1")
          ->type_name("N")
          ->group(group)
          ->allow_extra_args(false);
  app.add_option("--map-colour,--map-color", texts.colours, "extruder of a colour in the file; repeatable")
      ->type_name("'#RRGGBB=N'")
      ->group(group)
      ->allow_extra_args(false);
  app.add_option("--center", texts.center,
                 "middle of all parts on the bed, mm; default: of the area "
                 "that all needed nozzles reach")
      ->type_name("X,Y")
      ->group(group);
  app.add_flag("--no-center", texts.keep, "keep X and Y of the files")->group(group);
  app.add_option("--rotate", texts.command.placement.rotate_deg, "turn all parts about Z, degrees counterclockwise")
      ->type_name("DEG")
      ->group(group);
  app.add_option("--azimuth", texts.azimuth,
                 "turn them so that idle nozzles hover least over another colour (auto: where nozzles stay at the same "
                 "height), not at all, or by DEG beside --rotate; see 'cleancolor azimuth'")
      ->type_name("auto|off|DEG")
      ->group(group);
  app.add_option("--scale", texts.command.placement.scale, "scale all parts")->type_name("FACTOR")->group(group);
  app.add_option("--overlap", texts.overlap, "where two parts overlap: refuse, or give the place to the first or last")
      ->type_name("refuse|first|last")
      ->group(group);
}

void add_output(CLI::App& app, SliceCommand& command) {
  const char* group = "Output";
  app.add_option("-o,--output", command.output,
                 "G-code file; default: beside the first mesh file, with .gcode for its ending")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--preview", command.preview, "also draw a picture of the coloured parts")
      ->type_name("FILE.png")
      ->group(group);
  app.add_flag("--json", command.json, "print the summary as JSON")->group(group);
  app.add_flag("--quiet", command.quiet, "print neither progress nor summary; warnings still")->group(group);
  app.add_option("--threads", command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
}

Error without_file(std::string_view extruder) {
  return Error(fmt::format("--extruder {}: no file comes after it; it holds for the files that follow", extruder));
}

// --extruder holds for the files after it, so the order of the arguments counts.
std::vector<ModelFile> files_in_order(const CLI::App& app, const SliceTexts& texts) {
  std::vector<ModelFile> files;
  std::optional<int> extruder;
  std::size_t next_extruder = 0;
  bool has_file = true;  // false: the last --extruder still waits for one
  for (const CLI::Option* option : app.parse_order()) {
    if (option == texts.extruder_option) {
      if (!has_file) throw without_file(texts.extruders[next_extruder - 1]);
      extruder = extruder_index(texts.extruders.at(next_extruder++), "--extruder");
      has_file = false;
    } else if (option == texts.file_option) {
      files.push_back({texts.files.at(files.size()), extruder});
      has_file = true;
    }
  }
  if (!has_file) throw without_file(texts.extruders.back());
  return files;
}

void require_word(const char* option, const std::string& text, std::initializer_list<std::string_view> words) {
  if (text.empty() || std::ranges::find(words, text) != words.end()) return;
  throw Error(fmt::format("{}: '{}' is none of {}", option, text, fmt::join(words, ", ")));
}

Overlap overlap_of(const std::string& text) {
  if (text == "refuse") return Overlap::refuse;
  if (text == "first") return Overlap::first;
  if (text == "last") return Overlap::last;
  throw Error(fmt::format("--overlap: '{}' is none of refuse, first, last", text));
}

}  // namespace

CLI::App* add_slice(CLI::App& program, SliceTexts& texts) {
  CLI::App* slice = program.add_subcommand("slice", "slice meshes and write G-code");
  slice->footer(std::string(slice_footer) + exit_codes);
  add_parts(*slice, texts);
  add_printing(*slice, texts);
  add_output(*slice, texts.command);
  return slice;
}

CLI::App* add_azimuth(CLI::App& program, SliceTexts& texts) {
  CLI::App* azimuth = program.add_subcommand("azimuth", "show by how much to turn parts of several colours");
  azimuth->footer(std::string(azimuth_footer) + exit_codes);
  add_parts(*azimuth, texts);
  add_printing(*azimuth, texts);
  const char* group = "Output";
  azimuth->add_option("-o,--output", texts.command.output, "both curves around the compass, as a picture")
      ->type_name("FILE.svg")
      ->group(group);
  azimuth->add_flag("--json", texts.command.json, "print the curves as JSON")->group(group);
  azimuth->add_flag("--quiet", texts.command.quiet, "print neither progress nor table; warnings still")->group(group);
  azimuth->add_option("--threads", texts.command.threads, "number of threads; 0: as many as the machine has")
      ->type_name("N")
      ->group(group);
  return azimuth;
}

AzimuthCommand azimuth_command(const CLI::App& app, SliceTexts texts) {
  const std::filesystem::path picture = texts.command.output;
  if (!picture.empty() && picture.extension() != ".svg")
    throw Error(fmt::format("-o {}: the file's name must end in .svg", picture.string()));
  AzimuthCommand command{slice_command(app, std::move(texts)), false};
  command.slice.output = picture;
  command.json = command.slice.json;
  return command;
}

SliceCommand slice_command(const CLI::App& app, SliceTexts texts) {
  SliceCommand command = std::move(texts.command);
  command.files = files_in_order(app, texts);
  if (command.files.empty())
    throw Error(fmt::format("{0}: name at least one mesh file; see cleancolor {0} --help", app.get_name()));
  require_word("--protect", texts.protect, {"none", "rampart", "full"});
  const ProtectionLevel protects = protection_level(texts.protect).value_or(ProtectionLevel{});
  command.azimuth_deg = azimuth_deg(texts.azimuth.value_or(protects.turns ? "auto" : "off"), "--azimuth");
  // What is set by name counts more.
  require_word("--planner", texts.planner, {"clean", "paper", "plain"});
  require_word("--effort", texts.effort, {"fast", "normal", "best"});
  std::vector<std::string>& set = command.settings.set;
  if (!texts.effort.empty()) set.insert(set.begin(), "effort=" + texts.effort);
  if (!texts.planner.empty()) set.insert(set.begin(), "planner=" + texts.planner);
  set.insert(set.begin(), protects.set.begin(), protects.set.end());
  if (!texts.rampart.empty()) command.settings.set.push_back("rampart=" + texts.rampart);
  for (const std::string& text : texts.colours) {
    const auto [rgb, extruder] = colour_mapping(text);
    command.extruder_of_rgb[rgb] = extruder;
  }
  if (!texts.center.empty()) command.placement.center_mm = center_of(texts.center);
  command.placement.keep = texts.keep;
  if (texts.keep && command.placement.center_mm) throw Error("--center and --no-center exclude each other");
  const double scale = command.placement.scale;
  if (!(scale > 0) || !std::isfinite(scale)) throw Error(fmt::format("--scale: {} is not a positive factor", scale));
  if (!std::isfinite(command.placement.rotate_deg)) throw Error("--rotate: not a finite angle");
  require_threads(command.threads);
  command.overlap = overlap_of(texts.overlap);
  if (command.output.empty()) {
    command.output = std::filesystem::path(command.files.front().path).replace_extension(".gcode");
  }
  return command;
}

}  // namespace cleancolor
