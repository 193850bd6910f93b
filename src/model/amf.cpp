#include "model/amf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "model/limits.hpp"
#include "model/text_scan.hpp"
#include "model/transform.hpp"
#include "model/xml.hpp"

namespace cleancolor {

namespace {

/// Metadata of this type, in any case: "name", "Name".
std::string_view amf_metadata(pugi::xml_node node, std::string_view type) {
  for (const pugi::xml_node child : node.children("metadata"))
    if (is_keyword(child.attribute("type").value(), type)) return trimmed(child.child_value());
  return {};
}

double amf_unit_mm(std::string_view unit, const std::string& name) {
  constexpr std::pair<std::string_view, double> units[] = {{"", 1},           {"millimeter", 1}, {"inch", 25.4},
                                                           {"feet", 304.8},   {"foot", 304.8},   {"meter", 1000},
                                                           {"micron", 0.001}, {"centimeter", 10}};
  for (const auto& [known, mm] : units)
    if (is_keyword(unit, known)) return mm;
  throw Error(fmt::format("{}: '{}' is no unit of AMF; export the model again", name, shown(unit)));
}

std::optional<std::uint32_t> colour_of(pugi::xml_node node) {
  const pugi::xml_node colour = node.child("color");
  if (!colour) return std::nullopt;
  std::uint32_t rgb = 0;
  for (const char* channel : {"r", "g", "b"}) {
    const auto value = number<double>(trimmed(colour.child_value(channel)));
    if (!value) return std::nullopt;
    rgb = rgb << 8 | std::uint32_t(std::lround(std::clamp(*value, 0.0, 1.0) * 255));
  }
  return rgb;
}

std::optional<int> amf_extruder_of(pugi::xml_node node, const std::string& name) {
  const std::string_view text = amf_metadata(node, "slic3r.extruder");
  if (text.empty()) return std::nullopt;
  const auto extruder = number<int>(text);
  if (!extruder || *extruder < 0 || *extruder > 1000)
    throw Error(fmt::format("{}: '{}' is no extruder number; save the project again", name, shown(text)));
  return *extruder == 0 ? std::nullopt : std::optional(*extruder - 1);
}

std::vector<Vec3> amf_vertices_of(pugi::xml_node mesh, double mm, const std::string& where) {
  std::vector<Vec3> vertices;
  for (const pugi::xml_node vertex : mesh.child("vertices").children("vertex")) {
    const pugi::xml_node coordinates = vertex.child("coordinates");
    Vec3 p;
    for (const auto& [axis, value] : {std::pair{"x", &p.x}, std::pair{"y", &p.y}, std::pair{"z", &p.z}}) {
      const std::string_view text = trimmed(coordinates.child_value(axis));
      const auto read = number<double>(text);
      if (!read)
        throw Error(fmt::format("{}: vertex {}: {} is '{}', not a finite number; export the model again", where,
                                vertices.size(), axis, shown(text)));
      *value = *read * mm;
    }
    if (vertex.child("color"))
      throw Error(
          fmt::format("{}: the vertices have colours of their own, which a later version will print; give each "
                      "volume one material",
                      where));
    vertices.push_back(p);
  }
  return vertices;
}

class AmfReader {
 public:
  AmfReader(std::string bytes, const std::string& name, const Progress& progress)
      : xml_(std::move(bytes), name), name_(name), progress_(progress) {}

  std::vector<Part> parts() {
    const pugi::xml_node amf = xml_.root();
    if (std::string_view(amf.name()) != "amf")
      throw Error(
          fmt::format("{}: the root is <{}> instead of <amf>; export the model again", name_, shown(amf.name())));
    mm_ = amf_unit_mm(attribute(amf, "unit"), name_);
    for (const pugi::xml_node material : amf.children("material"))
      materials_.emplace(attribute(material, "id"), material);
    for (const pugi::xml_node object : amf.children("object")) read_object(object);
    for (const pugi::xml_node constellation : amf.children("constellation"))
      constellations_.emplace(attribute(constellation, "id"), constellation);
    build();
    if (parts_.empty()) throw Error(fmt::format("{}: no volumes in the AMF file; export the model again", name_));
    return std::move(parts_);
  }

 private:
  void read_object(pugi::xml_node object) {
    const std::string id(attribute(object, "id"));
    const std::string where = fmt::format("{}: object {}", name_, shown(id));
    std::vector<Part> parts;
    for (const pugi::xml_node mesh : object.children("mesh")) {
      const std::vector<Vec3> vertices = amf_vertices_of(mesh, mm_, where);
      for (const pugi::xml_node volume : mesh.children("volume")) {
        const std::string_view type = amf_metadata(volume, "slic3r.volume_type");
        const bool is_solid = amf_metadata(volume, "slic3r.modifier") != "1" && (type.empty() || type == "ModelPart") &&
                              attribute(volume, "type") != "support";
        if (parts.size() == max_parts)
          throw Error(fmt::format("{}: more than {} volumes; simplify the model", where, max_parts));
        if (is_solid)
          parts.push_back(read_volume(object, volume, vertices, where));
        else
          progress_.warn(fmt::format("{}: a volume is a modifier or a support and left out", where));
      }
    }
    if (!objects_.emplace(id, std::move(parts)).second)
      throw Error(fmt::format("{}: two objects have this id; export the model again", where));
    order_.push_back(id);
  }

  Part read_volume(pugi::xml_node object, pugi::xml_node volume, const std::vector<Vec3>& vertices,
                   const std::string& where) {
    Part part;
    const std::string material(attribute(volume, "materialid"));
    const auto found = materials_.find(material);
    const pugi::xml_node described = found == materials_.end() ? pugi::xml_node() : found->second;
    part.name = where;
    for (const pugi::xml_node named : {object, described, volume})
      if (const std::string_view name = amf_metadata(named, "name"); !name.empty())
        part.name = fmt::format("{}: {}", name_, shown(name));
    part.extruder = amf_extruder_of(volume, name_);
    if (!part.extruder) part.extruder = amf_extruder_of(object, name_);
    std::optional<std::uint32_t> triangle_rgb;
    const std::vector<Triangle> triangles = triangles_of(volume, vertices.size(), where, triangle_rgb);
    part.mesh = submesh(vertices, triangles);

    part.rgb = triangle_rgb ? triangle_rgb : colour_of(volume);
    if (!part.rgb) part.rgb = colour_of(described);
    if (!part.rgb) part.rgb = colour_of(object);
    if (!part.rgb) part.material = material;
    return part;
  }

  /// The triangles of a volume; rgb becomes the one colour that they name, if any.
  std::vector<Triangle> triangles_of(pugi::xml_node volume, std::size_t vertices, const std::string& where,
                                     std::optional<std::uint32_t>& rgb) {
    std::vector<Triangle> triangles;
    for (const pugi::xml_node node : volume.children("triangle")) {
      Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr const char* names[] = {"v1", "v2", "v3"};
        const std::string_view text = trimmed(node.child_value(names[k]));
        const auto index = number<std::uint32_t>(text);
        if (!index || *index >= vertices)
          throw Error(fmt::format("{}: triangle {}: {} is '{}', but the vertices are 0 to {}; export the model again",
                                  where, triangles.size(), names[k], shown(text), std::ptrdiff_t(vertices) - 1));
        t[k] = *index;
      }
      if (const auto colour = colour_of(node)) {
        if (rgb && *rgb != *colour)
          throw Error(
              fmt::format("{}: the triangles name more than one colour, which a later version will print; give "
                          "each volume one material",
                          where));
        rgb = colour;
      }
      triangles.push_back(t);
    }
    if (triangles.empty()) throw Error(fmt::format("{}: a volume has no triangles; export the model again", where));
    return triangles;
  }

  /// Constellations that no other one holds, in the order of the file, then the objects that none holds.
  void build() {
    std::map<std::string, int> held;
    for (const auto& [id, constellation] : constellations_)
      for (const pugi::xml_node instance : constellation.children("instance"))
        ++held[std::string(attribute(instance, "objectid"))];
    for (const pugi::xml_node node : xml_.root().children("constellation")) {
      const std::string id(attribute(node, "id"));
      if (!held.contains(id)) place(id, {});
    }
    for (const std::string& id : order_)
      if (!held.contains(id)) place(id, {});
  }

  void place(const std::string& id, const Transform& transform) {
    const auto constellation = constellations_.find(id);
    if (constellation == constellations_.end()) {
      place_object(id, transform);
      return;
    }
    if (std::find(open_.begin(), open_.end(), id) != open_.end())
      throw Error(fmt::format("{}: constellation {} contains itself; export the model again", name_, shown(id)));
    if (++visits_ > 10 * max_parts || open_.size() > 64)
      throw Error(fmt::format("{}: constellations are nested too deeply or too often; simplify the model", name_));
    open_.push_back(id);
    for (const pugi::xml_node instance : constellation->second.children("instance"))
      place(std::string(attribute(instance, "objectid")), composed(transform, transform_of(instance)));
    open_.pop_back();
  }

  void place_object(const std::string& id, const Transform& transform) {
    const auto found = objects_.find(id);
    if (found == objects_.end())
      throw Error(fmt::format("{}: object {} does not exist; export the model again", name_, shown(id)));
    for (const Part& part : found->second) {
      triangles_ += part.mesh.triangles.size();
      if (triangles_ > max_triangles || parts_.size() == max_parts)
        throw Error(
            fmt::format("{}: more than {} triangles or {} parts; simplify the model", name_, max_triangles, max_parts));
      parts_.push_back(part);
      parts_.back().mesh = transformed(std::move(parts_.back().mesh), transform);
    }
  }

  /// Turned about X, then Y, then Z, then moved; angles are degrees in the file.
  Transform transform_of(pugi::xml_node instance) const {
    const auto value = [&](const char* key) {
      const std::string_view text = trimmed(instance.child_value(key));
      const auto read = number<double>(text);
      if (!text.empty() && !read)
        throw Error(fmt::format("{}: {} of an instance is '{}', not a number; export the model again", name_, key,
                                shown(text)));
      return read.value_or(0);
    };
    const auto turn = [&](const char* key) { return value(key) * std::numbers::pi / 180; };
    const double x = turn("rx"), y = turn("ry"), z = turn("rz");
    Transform about_x, about_y, about_z;
    about_x.y_axis = {0, std::cos(x), std::sin(x)};
    about_x.z_axis = {0, -std::sin(x), std::cos(x)};
    about_y.x_axis = {std::cos(y), 0, -std::sin(y)};
    about_y.z_axis = {std::sin(y), 0, std::cos(y)};
    about_z.x_axis = {std::cos(z), std::sin(z), 0};
    about_z.y_axis = {-std::sin(z), std::cos(z), 0};
    Transform t = composed(about_z, composed(about_y, about_x));
    t.origin_mm = Vec3{value("deltax"), value("deltay"), value("deltaz")} * mm_;
    return t;
  }

  Xml xml_;
  const std::string& name_;
  const Progress& progress_;
  double mm_ = 1;
  std::map<std::string, pugi::xml_node> materials_;
  std::map<std::string, std::vector<Part>> objects_;
  std::vector<std::string> order_;  // of the objects in the file
  std::map<std::string, pugi::xml_node> constellations_;
  std::vector<std::string> open_;  // the constellations being placed
  std::size_t visits_ = 0;
  std::size_t triangles_ = 0;
  std::vector<Part> parts_;
};

}  // namespace

std::vector<Part> read_amf(std::string bytes, const std::string& name, const Progress& progress) {
  return AmfReader(std::move(bytes), name, progress).parts();
}

}  // namespace cleancolor
