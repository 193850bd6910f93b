#include "model/threemf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "model/archive.hpp"
#include "model/limits.hpp"
#include "model/threemf_model.hpp"
#include "model/threemf_vendor.hpp"

namespace cleancolor {

namespace {

constexpr std::string_view default_start = "3D/3dmodel.model";

/// The entry that the package's relations name as its model.
std::string start_part(Archive& archive, const std::string& name, const Progress& progress) {
  if (!archive.content("[Content_Types].xml"))
    progress.warn(fmt::format("{}: [Content_Types].xml is missing; read all the same", name));
  std::optional<std::string> relations = archive.content("_rels/.rels");
  if (!relations) {
    progress.warn(fmt::format("{}: _rels/.rels is missing; {} is taken for the model", name, default_start));
    return std::string(default_start);
  }
  const Xml xml(std::move(*relations), fmt::format("{}: _rels/.rels", name));
  for (const pugi::xml_node relation : xml.root().children())
    if (is(relation, "Relationship") && attribute(relation, "Type").ends_with("/3dmodel"))
      return std::string(attribute(relation, "Target"));
  throw Error(fmt::format("{}: the package holds no 3D model; export it again", name));
}

/// "/3D/a.model" and "3D/a.model" are one part.
std::string normal_path(std::string_view path) {
  while (path.starts_with('/')) path.remove_prefix(1);
  return std::string(path);
}

/// Walks the build and collects the parts.
class Assembly {
 public:
  Assembly(Archive& archive, const std::string& name, const Progress& progress)
      : archive_(archive), name_(name), progress_(progress) {}

  std::vector<Part> parts() {
    const std::string start = normal_path(start_part(archive_, name_, progress_));
    read_vendor_files();
    for (const Placed& item : model(start).build) {
      if (!item.printable) {
        progress_.warn(fmt::format("{}: object {} is marked as not to be printed and left out", name_, item.object));
        continue;
      }
      const bool in_start = item.path.empty() || normal_path(item.path) == start;
      const auto vendor = vendors_.find(item.object);
      Said said;
      if (in_start && vendor != vendors_.end()) {
        said.object = &vendor->second;
        said.name = vendor->second.name;
        said.extruder = vendor->second.extruder;
      }
      place(in_start ? start : normal_path(item.path), item.object, item.transform, said);
    }
    if (parts_.empty()) throw Error(fmt::format("{}: the build of the 3MF file is empty; nothing to print", name_));
    return std::move(parts_);
  }

 private:
  /// What the vendor's file says about what is being placed.
  struct Said {
    const VendorObject* object = nullptr;  // of the build item, until its volumes are dealt out
    std::string name;                      // of the build item; where nothing more exact is said
    std::optional<int> extruder;
    std::string volume_name;
  };

  void read_vendor_files() {
    for (const char* entry : {"Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"}) {
      std::optional<std::string> config = archive_.content(entry);
      if (!config) continue;
      const std::string where = fmt::format("{}: {}", name_, entry);
      vendors_ = read_vendor_config(Xml(std::move(*config), where), where);
      return;
    }
  }

  const ModelPart& model(const std::string& path) {
    const auto known = models_.find(path);
    if (known != models_.end()) return known->second;
    std::optional<std::string> content = archive_.content(path);
    if (!content)
      throw Error(fmt::format("{}: model part {} is not in the package; export it again", name_, shown(path)));
    const std::string where = fmt::format("{}: {}", name_, path);
    return models_.emplace(path, read_model_part(Xml(std::move(*content), where), where, progress_)).first->second;
  }

  void place(const std::string& path, std::uint32_t id, const Transform& transform, const Said& said) {
    const ModelPart& part = model(path);
    const auto found = part.objects.find(id);
    if (found == part.objects.end())
      throw Error(fmt::format("{}: {}: object {} does not exist; export the model again", name_, path, id));
    const std::pair<std::string, std::uint32_t> here{path, id};
    if (std::find(open_.begin(), open_.end(), here) != open_.end())
      throw Error(fmt::format("{}: {}: object {} contains itself; export the model again", name_, path, id));
    if (++visits_ > 10 * max_parts || open_.size() > 64)
      throw Error(fmt::format("{}: components are nested too deeply or too often; simplify the model", name_));

    const MeshObject& object = found->second;
    if (!object.is_model) {
      progress_.warn(fmt::format("{}: object {} is a support or a mere surface and left out", name_, id));
      return;
    }
    open_.push_back(here);
    if (object.components.empty())
      add_mesh(object, id, transform, said);
    else
      place_components(path, object, transform, said);
    open_.pop_back();
  }

  /// The n-th component that refers to an object goes with the n-th vendor part of this id; parts may share one.
  void place_components(const std::string& path, const MeshObject& object, const Transform& transform,
                        const Said& said) {
    std::map<std::uint32_t, std::size_t> seen;
    for (const Placed& component : object.components) {
      Said inner{nullptr, said.name.empty() ? object.name : said.name, said.extruder, said.volume_name};
      if (said.object != nullptr) {
        const VendorVolume* volume = vendor_part(*said.object, component.object, seen[component.object]++);
        if (volume != nullptr && !is_printed(*volume)) continue;
        if (volume != nullptr) {
          if (!volume->name.empty()) inner.volume_name = volume->name;
          if (volume->extruder) inner.extruder = volume->extruder;
        }
      }
      place(component.path.empty() ? path : normal_path(component.path), component.object,
            composed(transform, component.transform), inner);
    }
  }

  static const VendorVolume* vendor_part(const VendorObject& object, std::uint32_t id, std::size_t nth) {
    const VendorVolume* last = nullptr;
    for (const VendorVolume& volume : object.volumes) {
      if (object.by_range || volume.id != id) continue;
      last = &volume;
      if (nth-- == 0) break;
    }
    return last;
  }

  bool is_printed(const VendorVolume& volume) {
    if (volume.kind == VolumeKind::negative)
      throw Error(
          fmt::format("{}: {} is a negative volume, which cannot be cut out; apply it in the program that made it",
                      name_, shown(volume.name)));
    if (volume.kind == VolumeKind::helper)
      progress_.warn(fmt::format("{}: {} is a modifier or a support setting and left out", name_, shown(volume.name)));
    return volume.kind == VolumeKind::solid;
  }

  static std::string best_name(const MeshObject& object, std::uint32_t id, const Said& said) {
    for (const std::string& name : {said.volume_name, object.name, said.name})
      if (!name.empty()) return name;
    return fmt::format("object {}", id);
  }

  void add_mesh(const MeshObject& object, std::uint32_t id, const Transform& transform, const Said& said) {
    const std::string where = fmt::format("{}: {}", name_, shown(best_name(object, id, said)));
    if (!object.refusal.empty()) throw Error(fmt::format("{}: {}", where, object.refusal));
    if (object.textured) progress_.warn(fmt::format("{}: its texture is ignored; a nozzle prints one colour", where));

    Part part{where, {}, said.extruder, {}, {}};
    if (object.colour) {
      part.rgb = object.colour->rgb;
      part.material = object.colour->material;
    }
    if (said.object != nullptr && said.object->by_range) {
      add_volumes(object.mesh, *said.object, transform, part);
      return;
    }
    if (said.object != nullptr && said.object->volumes.size() == 1 && said.object->volumes.front().extruder)
      part.extruder = said.object->volumes.front().extruder;
    part.mesh = transformed(counted(object.mesh), transform);
    add(std::move(part));
  }

  /// One part for each of PrusaSlicer's ranges of triangles.
  void add_volumes(const Mesh& mesh, const VendorObject& object, const Transform& transform, const Part& common) {
    std::size_t covered = 0;
    for (const VendorVolume& volume : object.volumes) {
      if (volume.last_triangle >= mesh.triangles.size())
        throw Error(fmt::format("{}: a volume ends at triangle {}, but there are {}; save the project again",
                                common.name, volume.last_triangle, mesh.triangles.size()));
      const std::size_t count = volume.last_triangle - volume.first_triangle + 1;
      covered += count;
      if (!is_printed(volume)) continue;
      count_triangles(count);
      Part part = common;
      if (!volume.name.empty()) part.name = fmt::format("{}: {}", name_, shown(volume.name));
      if (volume.extruder) part.extruder = volume.extruder;
      part.mesh = transformed(submesh(mesh.vertices, std::span(mesh.triangles).subspan(volume.first_triangle, count)),
                              transform);
      add(std::move(part));
    }
    if (covered < mesh.triangles.size())
      progress_.warn(fmt::format("{}: {} triangles belong to no volume and are left out", common.name,
                                 mesh.triangles.size() - covered));
  }

  const Mesh& counted(const Mesh& mesh) {
    if (mesh.triangles.empty())
      throw Error(fmt::format("{}: an object has no triangles; export the model again", name_));
    count_triangles(mesh.triangles.size());
    return mesh;
  }

  void count_triangles(std::size_t count) {
    triangles_ += count;
    if (triangles_ > max_triangles)
      throw Error(fmt::format("{}: more than {} triangles in all instances; simplify the mesh", name_, max_triangles));
  }

  void add(Part part) {
    for (const Vec3& p : part.mesh.vertices)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(
            fmt::format("{}: its transform leads out of the range of numbers; export the model again", part.name));
    if (parts_.size() == max_parts) throw Error(fmt::format("{}: more than {} parts", name_, max_parts));
    parts_.push_back(std::move(part));
  }

  Archive& archive_;
  const std::string& name_;
  const Progress& progress_;
  std::map<std::string, ModelPart> models_;
  VendorObjects vendors_;
  std::vector<std::pair<std::string, std::uint32_t>> open_;  // the objects whose components are being placed
  std::size_t visits_ = 0;
  std::size_t triangles_ = 0;
  std::vector<Part> parts_;
};

}  // namespace

std::vector<Part> read_3mf(Archive& archive, const std::string& name, const Progress& progress) {
  return Assembly(archive, name, progress).parts();
}

}  // namespace cleancolor
