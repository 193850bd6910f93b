#include "pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "azimuth_trial.hpp"
#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parallel.hpp"
#include "gcode/writer.hpp"
#include "model/assign.hpp"
#include "model/check.hpp"
#include "model/reach.hpp"
#include "model/read.hpp"
#include "model/view.hpp"
#include "picture.hpp"
#include "plan/planner.hpp"
#include "protection.hpp"
#include "slice/slices.hpp"
#include "toolpath/bed.hpp"
#include "toolpath/cooling.hpp"
#include "toolpath/roads.hpp"
#include "toolpath/toolpaths.hpp"

namespace cleancolor {
namespace {

/// How far the first stage runs ahead of the writer, in layers beyond what the skins look at.
constexpr int layers_ahead = 12;
/// Likewise the planner: a planned layer holds its map, of 1 MB or so, and its roadmap until it is written.
constexpr int planned_ahead(int threads) {
  return 2 * threads + 1;
}

std::vector<Part> parts_of(const SliceRequest& request, const Progress& progress) {
  std::vector<std::vector<Part>> files;
  Assignment assignment{{}, request.extruder_of_rgb, int(request.config.extruders.size())};
  for (const ModelFile& file : request.files) {
    progress.advance("reading", double(files.size()) / double(request.files.size()));
    files.push_back(read_model(file.path, progress));
    assignment.extruder_of_file.push_back(file.extruder);
  }
  assign_extruders(files, assignment, progress);
  std::vector<Part> parts;
  for (std::vector<Part>& file : files)
    for (Part& part : file) {
      part.mesh = checked(std::move(part.mesh), part.name, progress);
      parts.push_back(std::move(part));
    }
  Placement placement = request.placement;
  placement.rotate_deg += request.azimuth_deg.value_or(0);
  place(parts, request.config, placement, progress);
  return parts;
}

SliceOptions slice_options(const SliceRequest& request) {
  const Config& config = request.config;
  return {.extruders = int(config.extruders.size()),
          .first_layer_height_mm = config.first_layer_height_mm,
          .layer_height_mm = config.layer_height_mm,
          .resolution_mm = config.resolution_mm,
          .closing_radius_mm = config.slice_closing_radius_mm,
          .xy_size_compensation_mm = config.xy_size_compensation_mm,
          .elefant_foot_compensation_mm = config.elefant_foot_compensation_mm,
          .overlap = request.overlap,
          .threads = thread_count(request.threads)};
}

/// The extruder with the most of the first layer: its material must stick to the bed.
int bed_extruder(const Slices& slices) {
  const auto& regions = slices.regions.front();
  const auto most = std::max_element(regions.begin(), regions.end(),
                                     [](const Polygons& a, const Polygons& b) { return area_mm2(a) < area_mm2(b); });
  return int(most - regions.begin());
}

/// "ocean, land": what is printed, for the file's header.
std::string name_of(const SliceRequest& request) {
  std::string names;
  for (const ModelFile& file : request.files) names += (names.empty() ? "" : ", ") + file.path.stem().string();
  return names;
}

Error too_thin(const SliceRequest& request, int extruder) {
  return Error(
      fmt::format("{}: every wall that extruder {} should print is too thin: nothing of it would come out; is the "
                  "model's scale right (inches, metres)?{}",
                  request.files.front().path.filename().string(), extruder + 1,
                  request.config.thin_walls ? "" : " thin_walls = 1 prints thinner ones"));
}

/// The walls of the rampart prime the nozzles, and stand where a skirt would; a brim stays within them.
Config without_priming(Config config, const Progress& progress) {
  config.skirts = 0;
  config.prime_line_length_mm = 0;
  const double room_mm = std::max(
      0., config.ooze_shield_dist_mm - config.brim_separation_mm - config.extruders.front().nozzle_diameter_mm);
  if (config.brim_type != BrimType::no_brim && config.brim_width_mm > room_mm) {
    progress.warn(
        fmt::format("brim_width: {:.1f} instead of {:.1f} mm, for the rampart stands around the part; a larger "
                    "ooze_shield_dist leaves room for more",
                    room_mm, config.brim_width_mm));
    config.brim_width_mm = room_mm;
  }
  return config;
}

/// Without warnings, for what was said already.
Progress silent(Progress progress) {
  progress.warn = [](const std::string&) {};
  return progress;
}

/// Whether the parts are turned so that idle nozzles hover over them least.
bool is_azimuth_automatic(const SliceRequest& request, const Use& use) {
  return !request.azimuth_deg && use.extruders.size() > 1 && request.config.idle_nozzle == IdleNozzle::same_height;
}

/// Where the middle of the parts' box stays when they are turned; empty: where place() puts it.
std::optional<Vec2> fixed_center(const SliceRequest& request, std::span<const Part> parts) {
  if (!request.placement.keep) return request.placement.center_mm;
  Box<Vec3> box;
  for (const Part& part : parts)
    for (const Vec3& p : part.mesh.vertices) box.add(p);
  return Vec2{box.center().x, box.center().y};
}

/// Both curves and the best turn; where the planner is clean, by trial.
Azimuths azimuths_of(const SliceRequest& request, std::span<const Part> parts, const Slices& layers, const Use& use) {
  const int threads = thread_count(request.threads);
  Azimuths result = azimuths_of_print(layers, use, request.config, fixed_center(request, parts), threads);
  const bool tries = request.config.planner == Planner::clean && is_azimuth_automatic(request, use);
  if (!tries || result.candidates_deg.size() < 2) return result;
  const auto trials = azimuth_trials(layers, use, request.config, result.candidates_deg, {.threads = threads});
  result.tried_deg = cleanest(trials);
  return result;
}

/// From where the print is looked at.
ViewBias view(const Config& config, double turned_deg) {
  const auto direction_deg = view_direction_deg(config.view_direction);
  if (!direction_deg) return {};
  const double angle = (*direction_deg + turned_deg) * std::numbers::pi / 180;
  return {.from = {std::cos(angle), std::sin(angle)}, .weight = config.view_weight};
}

/// What light does not pass in each layer; empty where all filaments are opaque.
std::vector<PackedPolygons> opaque_regions(const Slices& slices, const Config& config) {
  const auto is_opaque = [](const Extruder& e) { return e.filament_translucency_mm <= 0; };
  if (std::ranges::all_of(config.extruders, is_opaque)) return {};
  std::vector<PackedPolygons> result;
  for (const std::vector<PackedPolygons>& layer : slices.regions) {
    const std::vector<Polygons> regions = unpacked(layer);
    Polygons opaque;
    for (std::size_t e = 0; e < regions.size(); ++e)
      if (is_opaque(config.extruders[e])) opaque.insert(opaque.end(), regions[e].begin(), regions[e].end());
    result.push_back(opaque);
  }
  return result;
}

/// The layers of one print on their way from regions to G-code; each stage owns its slot of each layer.
class Print {
 public:
  /// turned_deg: by so much the parts stand turned from what is in their files.
  Print(const SliceRequest& request, const Slices& slices, const Use& use, PrintInfo info, double turned_deg, Sink sink,
        const Progress& progress)
      : config_(request.config),
        request_(request),
        slices_(slices),
        rampart_(slices, use, request.config, thread_count(request.threads)),
        use_(use),
        info_(std::move(info)),
        sink_(std::move(sink)),
        progress_(progress),
        shells_(slices.slabs.size()),
        areas_(slices.slabs.size()),
        paths_(slices.slabs.size()),
        rampart_g_(slices.slabs.size()),
        planned_(slices.slabs.size()) {
    if (use.extruders.empty()) throw too_thin(request, 0);
    if (slices.outlines.front().empty())
      throw Error(
          fmt::format("{}: nothing of the model is left in the first layer (z = {:.2f} mm): it stands on a tip or an "
                      "edge; turn it so that it lies flat, or cut a little off",
                      request.files.front().path.filename().string(), slices.slabs.front().slice_z_mm()));
    bed_ = bed_paths(slices, use.extruders, rampart_.empty() ? config_ : without_priming(config_, progress), progress);
    state_.extruder = info_.initial_extruder = use.extruders.front();
    coverage_.resize(info_.last_layer.size());
    if (config_.planner == Planner::plain) return;
    std::vector<double> height_mm;
    for (const Slab& slab : slices.slabs) height_mm.push_back(slab.height_mm);
    for (int e = 0; e < int(config_.extruders.size()); ++e) reach_.push_back(reach(config_, e));
    for (const Extruder& e : config_.extruders) translucency_mm_.push_back(e.filament_translucency_mm);
    const std::vector<PackedPolygons> opaque = opaque_regions(slices, config_);
    visibility_.emplace(
        slices.outlines, height_mm,
        SurfaceVisibilityOptions{
            .threads = thread_count(request.threads), .view = view(config_, turned_deg), .opaque = opaque},
        progress);
    first_ = first_extruders(printing_by_layer(slices), use.extruders.front());
  }

  PrintFigures run(int threads) {
    const int reach = skin_reach(config_);
    cleancolor::run({.count = int(slices_.slabs.size()),
                     .window = 2 * reach + layers_ahead,
                     .stages = {{0, [&](int k) { slot(shells_, k) = layer_shells(slices_, k, config_); }},
                                {reach, [&](int k) { slot(areas_, k) = layer_areas(shells_, k, config_); }},
                                {1, [&](int k) { make_paths(k); }},
                                {0, [&](int k) { plan(k); }, planned_ahead(threads)}},
                     .consume = [&](int k) { write(k); }},
                    threads);
    judge_losses();
    PrintFigures figures = writer_->finish();
    return figures;
  }

  double rampart_g() const { return std::accumulate(rampart_g_.begin(), rampart_g_.end(), 0.); }

 private:
  template <class T>
  static T& slot(std::vector<T>& slots, int k) {
    return slots[std::size_t(k)];
  }

  void make_paths(int k) {
    const LayerAreas* below = k > 0 ? &slot(areas_, k - 1) : nullptr;
    slot(paths_, k) = layer_paths(slices_, slot(shells_, k), below, slot(areas_, k), k, config_);
  }

  /// All paths of the layer, in no order yet.
  Layer layer_of(int k) {
    const Slab& slab = slices_.slabs[std::size_t(k)];
    Layer layer{
        .index = k, .print_z_mm = slab.print_z_mm, .height_mm = slab.height_mm, .paths = {}, .fan_by_extruder = {}};
    if (k < int(bed_.size())) layer.paths = std::move(slot(bed_, k));
    std::vector<Path> walls = rampart_.paths(k);
    slot(rampart_g_, k) = weight_g(walls);
    std::ranges::move(walls, std::back_inserter(layer.paths));
    std::ranges::move(slot(paths_, k), std::back_inserter(layer.paths));
    return layer;
  }

  /// Layers are planned side by side where none needs what the one below remembers.
  bool plans_ahead() const { return visibility_ && config_.seam_position != SeamPosition::aligned; }

  void plan(int k) {
    if (!plans_ahead()) return;
    OrderState state{.extruder = first_[std::size_t(k)], .at = {}, .seams = {}};
    slot(planned_, k).emplace(layer_of(k), state, config_, scene(k), *visibility_);
  }

  PlanScene scene(int k) const {
    PlanScene scene = plan_scene(slices_, use_, config_, rampart_, k);
    scene.part.translucency_mm = translucency_mm_;
    scene.reach = reach_;
    return scene;
  }

  Layer ordered(int k) {
    if (!visibility_) {
      Layer layer = layer_of(k);
      order(layer, state_, config_, rampart_.site(k));
      return layer;
    }
    auto& planned = slot(planned_, k);
    if (!planned) planned.emplace(layer_of(k), state_, config_, scene(k), *visibility_);
    planned->arrive_from(below_);
    Layer layer = std::move(*planned).release();
    planned.reset();
    if (!layer.paths.empty()) {
      below_.paths.assign(1, layer.paths.back());
    }
    return layer;
  }

  void write(int k) {
    if (progress_.interrupted()) throw Error("interrupted");
    Layer layer = ordered(k);
    cool(layer, config_);
    if (!writer_) begin(layer);
    writer_->layer(layer);
    for (std::size_t e = 0; e < coverage_.size(); ++e) coverage_[e] += slot(shells_, k)[e].coverage;
    release(k);
    progress_.advance("slicing", double(k + 1) / double(slices_.slabs.size()));
  }

  double weight_g(std::span<const Path> paths) const {
    double sum = 0;
    for (const Path& path : paths) {
      const Extruder& e = config_.extruders[std::size_t(path.extruder)];
      sum += volume_mm3(path) * e.extrusion_multiplier * e.filament_density_g_cm3 / 1000;
    }
    return sum;
  }

  /// Frees what no later layer reads.
  void release(int k) {
    slot(paths_, k) = {};
    const int reach = skin_reach(config_);
    if (k > reach) slot(shells_, k - reach - 1) = {};
    if (k > 0) slot(areas_, k - 1) = {};
  }

  void begin(const Layer& first) {
    if (!first.paths.empty()) info_.initial_extruder = first.paths.front().extruder;
    for (const Path& path : first.paths)
      for (const Vec2 p : path.points) info_.first_layer_box_mm.add(p);
    writer_ = std::make_unique<GcodeWriter>(config_, std::move(info_), std::move(sink_));
  }

  /// What is too thin to print is worth a word where it is more than the tip of a cone; a colour of which nothing is
  /// left is not what anybody wants.
  void judge_losses() const {
    for (std::size_t e = 0; e < coverage_.size(); ++e) {
      const Coverage& c = coverage_[e];
      if (c.all_mm2 > 0 && c.lost_mm2 >= c.all_mm2) throw too_thin(request_, int(e));
      const double noticed = 0.01 * c.all_mm2;
      if (c.lost_mm2 > noticed)
        progress_.warn(fmt::format("{:.0f} % of what extruder {} should print is too thin for a road and left out{}",
                                   100 * c.lost_mm2 / c.all_mm2, e + 1,
                                   config_.thin_walls ? "" : "; thin_walls = 1 prints most of it"));
      if (c.thin_mm2 > noticed)
        progress_.warn(
            fmt::format("{:.0f} % of what extruder {} should print is thinner than its nozzle ({} mm): such "
                        "walls come out weak or not at all; make them thicker",
                        100 * c.thin_mm2 / c.all_mm2, e + 1, config_.extruders[e].nozzle_diameter_mm));
    }
  }

  const Config& config_;
  const SliceRequest& request_;
  const Slices& slices_;
  PrintedRampart rampart_;
  const Use& use_;
  PrintInfo info_;
  Sink sink_;
  const Progress& progress_;
  std::vector<LayerShells> shells_;
  std::vector<LayerAreas> areas_;
  std::vector<std::vector<Path>> paths_;
  std::vector<double> rampart_g_;                     // by layer
  std::vector<std::optional<PlannedLayer>> planned_;  // by layer
  std::vector<std::vector<Path>> bed_;
  std::optional<SurfaceVisibility> visibility_;  // where the planner is not plain
  std::vector<Polygons> reach_;                  // of each extruder
  std::vector<double> translucency_mm_;          // of each extruder's filament
  std::vector<int> first_;                       // the extruder that begins each layer
  Layer below_;                                  // the last path of the layer written last
  OrderState state_;
  std::unique_ptr<GcodeWriter> writer_;
  std::vector<Coverage> coverage_;  // of each extruder, all layers together
};

Summary summary_of(const PrintFigures& figures, Protection protection) {
  Summary summary{figures.layers, figures.tool_changes, figures.time_s, {}, std::move(protection)};
  for (const FilamentUse& f : figures.extruders) summary.extruders.push_back({f.length_mm, f.weight_g, f.cost});
  return summary;
}

}  // namespace

Summary slice(const SliceRequest& request, const Progress& progress) {
  std::vector<Part> parts = parts_of(request, progress);
  progress.advance("slicing", 0);
  Slices layers = slices(parts, slice_options(request), progress);
  Protection protection{.azimuth_deg = request.azimuth_deg.value_or(0), .azimuths = {}, .rampart_g = 0};
  if (is_azimuth_automatic(request, Use(layers))) {
    protection.azimuths = azimuths_of(request, parts, layers, Use(layers));
    protection.azimuth_deg = protection.azimuths->chosen_deg().value_or(0);
    if (!protection.azimuths->chosen_deg())
      progress.warn("the parts stay as they are: at no angle they and their rampart have room; see cleancolor azimuth");
    if (protection.azimuth_deg != 0) {
      place(parts, request.config, {.center_mm = fixed_center(request, parts), .rotate_deg = protection.azimuth_deg},
            silent(progress));
      layers = {};  // so that there are never two
      layers = slices(parts, slice_options(request), silent(progress));
    }
  }
  std::optional<OutputFile> preview;
  if (!request.preview.empty()) {
    preview.emplace(request.preview);
    preview->write(picture(parts, request.config, 1024, 768));
  }

  const Use use(layers);
  protection.rampart = rampart_shape(request.config, use);
  PrintInfo info{.name = name_of(request),
                 .layer_count = int(layers.slabs.size()),
                 .max_z_mm = layers.slabs.back().print_z_mm,
                 .initial_extruder = 0,
                 .bed_extruder = bed_extruder(layers),
                 .last_layer = use.last_layer,
                 .first_layer_box_mm = {},
                 .thumbnails = thumbnails(parts, request.config)};
  for (const Part& part : parts)
    if (!info.last_layer[std::size_t(*part.extruder)]) throw too_thin(request, *part.extruder);
  parts = {};  // the layers are all that is printed

  OutputFile file(request.output);
  const double turned_deg = request.placement.rotate_deg + protection.azimuth_deg;
  Print print(request, layers, use, std::move(info), turned_deg, to_file(file), progress);
  const PrintFigures figures = print.run(thread_count(request.threads));
  file.commit();
  if (preview) preview->commit();
  protection.rampart_g = print.rampart_g();
  return summary_of(figures, std::move(protection));
}

Azimuths azimuths(const SliceRequest& request, const Progress& progress) {
  const std::vector<Part> parts = parts_of(request, progress);
  progress.advance("slicing", 0);
  const Slices layers = slices(parts, slice_options(request), progress);
  const Use use(layers);
  if (use.extruders.empty()) throw too_thin(request, 0);
  return azimuths_of(request, parts, layers, use);
}

}  // namespace cleancolor
