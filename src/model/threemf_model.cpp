#include "model/threemf_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "model/limits.hpp"

namespace cleancolor {

namespace {

std::string again(const std::string& where, const std::string& what) {
  return fmt::format("{}: {}; export the model again", where, what);
}

double unit_mm(std::string_view unit, const std::string& where) {
  constexpr std::pair<std::string_view, double> units[] = {
      {"", 1},        {"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
      {"inch", 25.4}, {"foot", 304.8},   {"meter", 1000}};
  for (const auto& [name, mm] : units)
    if (unit == name) return mm;
  throw Error(again(where, fmt::format("'{}' is no unit of 3MF", shown(unit))));
}

/// Extensions that a file may require: those whose geometry is read, and those that do not change it.
void require_known_extensions(pugi::xml_node model, const std::string& where) {
  constexpr std::string_view known[] = {"http://schemas.microsoft.com/3dmanufacturing/material/",
                                        "http://schemas.microsoft.com/3dmanufacturing/production/",
                                        "http://schemas.microsoft.com/3dmanufacturing/trianglesets/",
                                        "http://schemas.slic3r.org/",
                                        "http://schemas.bambulab.com/",
                                        "http://schemas.orcaslicer.com/"};
  const std::string_view required = attribute(model, "requiredextensions");
  Scanner scan(required);
  for (std::string_view prefix = scan.word(); !prefix.empty(); prefix = scan.word()) {
    const std::string_view uri = model.attribute(fmt::format("xmlns:{}", prefix).c_str()).value();
    const bool found = std::any_of(std::begin(known), std::end(known), [&](auto k) { return uri.starts_with(k); });
    if (!found)
      throw Error(
          fmt::format("{}: the file requires the 3MF extension '{}' ({}), which is not known here; export it as "
                      "plain meshes",
                      where, shown(prefix), shown(uri)));
  }
}

/// The 12 numbers of a transform; the identity where the attribute is absent.
Transform transform_of(pugi::xml_node node, double mm, const std::string& where) {
  const std::string_view text = attribute(node, "transform");
  if (text.empty()) return {};
  std::array<double, 12> m{};
  std::size_t count = 0;
  Scanner scan(text);
  for (std::string_view word = scan.word(); !word.empty(); word = scan.word(), ++count) {
    const auto value = number<double>(word);
    if (!value) throw Error(again(where, fmt::format("a transform holds '{}' instead of a number", shown(word))));
    if (count < 12) m[count] = *value;
  }
  if (count != 12) throw Error(again(where, fmt::format("a transform has {} numbers instead of 12", count)));
  const Transform t{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}, Vec3{m[9], m[10], m[11]} * mm};
  const double scale = length(t.x_axis) * length(t.y_axis) * length(t.z_axis);
  if (!(std::abs(t.determinant()) > 1e-9 * scale) || !std::isfinite(scale))
    throw Error(again(where, "a transform flattens its object (its determinant is zero)"));
  return t;
}

std::vector<Vec3> vertices_of(pugi::xml_node mesh, double mm, const std::string& where) {
  std::vector<Vec3> vertices;
  for (const pugi::xml_node node : mesh.child("vertices").children("vertex")) {
    std::array<double, 3> p{};
    int seen = 0;
    for (const pugi::xml_attribute a : node.attributes()) {
      const char axis = a.name()[0];
      if (axis < 'x' || axis > 'z' || a.name()[1] != '\0') continue;
      const auto value = number<double>(a.value());
      if (!value)
        throw Error(again(where, fmt::format("vertex {}: {}=\"{}\" is not a finite number", vertices.size(), axis,
                                             shown(a.value()))));
      p[std::size_t(axis - 'x')] = *value * mm;
      seen |= 1 << (axis - 'x');
    }
    if (seen != 7) throw Error(again(where, fmt::format("vertex {}: x, y or z is missing", vertices.size())));
    vertices.push_back({p[0], p[1], p[2]});
  }
  return vertices;
}

/// What the attributes of one triangle say; unset: UINT32_MAX.
struct TriangleSays {
  std::array<std::uint32_t, 3> v{UINT32_MAX, UINT32_MAX, UINT32_MAX};
  std::array<std::uint32_t, 3> p{UINT32_MAX, UINT32_MAX, UINT32_MAX};
  std::uint32_t pid = UINT32_MAX;
  bool painted = false;
};

TriangleSays read_triangle(pugi::xml_node node) {
  TriangleSays says;
  for (const pugi::xml_attribute a : node.attributes()) {
    const std::string_view name = a.name();
    const auto whole = [&] { return number<std::uint32_t>(a.value()).value_or(UINT32_MAX); };
    if (name.size() == 2 && name[1] >= '1' && name[1] <= '3' && (name[0] == 'v' || name[0] == 'p'))
      (name[0] == 'v' ? says.v : says.p)[std::size_t(name[1] - '1')] = whole();
    else if (name == "pid")
      says.pid = whole();
    else if (name == "materialid") {  // drafts before 1.0: a group of one colour
      says.pid = whole();
      says.p[0] = 0;
    } else if ((name.ends_with("mmu_segmentation") || name == "paint_color") && a.value()[0] != '\0')
      says.painted = true;
  }
  return says;
}

class ObjectReader {
 public:
  ObjectReader(const ColourGroups& groups, double mm, const std::string& where)
      : colours_(groups, where), mm_(mm), where_(where) {}

  MeshObject object(pugi::xml_node node) {
    object_.name = attribute(node, "name");
    const std::string_view type = attribute(node, "type");
    object_.is_model = type.empty() || type == "model";
    if (const auto material = id_attribute(node, "materialid")) {
      default_pid_ = *material;
      default_index_ = 0;
    } else {
      default_pid_ = id_attribute(node, "pid").value_or(UINT32_MAX);
      default_index_ = id_attribute(node, "pindex").value_or(0);
    }
    if (const pugi::xml_node mesh = node.child("mesh"))
      read_mesh(mesh);
    else if (const pugi::xml_node components = node.child("components"))
      read_components(components);
    else
      throw Error(again(where_, "an object has neither a mesh nor components"));
    return std::move(object_);
  }

 private:
  void read_mesh(pugi::xml_node mesh) {
    object_.mesh.vertices = vertices_of(mesh, mm_, where_);
    if (default_pid_ != UINT32_MAX && !mesh.child("triangles").first_child())
      colours_.use(default_pid_, default_index_);
    for (const pugi::xml_node node : mesh.child("triangles").children("triangle")) add(read_triangle(node));
    for (const pugi::xml_node node : mesh.children())
      if (is(node, "beamlattice")) object_.refusal = "a beam lattice cannot be printed; export it as a plain mesh";
    object_.colour = colours_.first();
    object_.textured = colours_.textured();
    if (painted_)
      object_.refusal =
          "the object is painted in several colours, which a later version will print; split it into one "
          "body for each colour, or remove the paint";
    else if (colours_.several())
      object_.refusal =
          "the triangles of the object name more than one colour, which a later version will print; split "
          "it into one body for each colour";
  }

  void add(const TriangleSays& says) {
    std::vector<Triangle>& triangles = object_.mesh.triangles;
    for (const std::uint32_t v : says.v)
      if (v >= object_.mesh.vertices.size())
        throw Error(again(
            where_, v == UINT32_MAX ? fmt::format("triangle {}: v1, v2 or v3 is missing or no index", triangles.size())
                                    : fmt::format("triangle {}: vertex {} does not exist; there are {}",
                                                  triangles.size(), v, object_.mesh.vertices.size())));
    triangles.push_back(says.v);
    painted_ = painted_ || says.painted;
    if (says.p[0] == UINT32_MAX) {
      if (default_pid_ != UINT32_MAX) colours_.use(default_pid_, default_index_);
      return;
    }
    const std::uint32_t pid = says.pid == UINT32_MAX ? default_pid_ : says.pid;
    if (pid == UINT32_MAX) return;
    for (const std::uint32_t p : says.p)
      if (p != UINT32_MAX) colours_.use(pid, p);
  }

  void read_components(pugi::xml_node components) {
    for (const pugi::xml_node node : components.children("component")) {
      const auto id = id_attribute(node, "objectid");
      if (!id) throw Error(again(where_, "a component without objectid"));
      object_.components.push_back({std::string(attribute(node, "path")), *id, transform_of(node, mm_, where_), true});
    }
  }

  SurfaceColours colours_;
  double mm_;
  const std::string& where_;
  std::uint32_t default_pid_ = UINT32_MAX;
  std::uint32_t default_index_ = 0;
  bool painted_ = false;
  MeshObject object_;
};

}  // namespace

ModelPart read_model_part(const Xml& xml, const std::string& where, const Progress& progress) {
  const pugi::xml_node model = xml.root();
  if (!is(model, "model"))
    throw Error(again(where, fmt::format("the root is <{}> instead of <model>", shown(model.name()))));
  require_known_extensions(model, where);
  const double mm = unit_mm(attribute(model, "unit"), where);

  ModelPart part;
  ColourGroups groups;
  std::size_t triangles = 0;
  for (const pugi::xml_node node : model.child("resources").children()) {
    if (ColourGroups::is_group(node)) groups.add(node, where);
    if (!is(node, "object")) continue;
    const auto id = id_attribute(node, "id");
    if (!id) throw Error(again(where, "an object without id"));
    if (part.objects.contains(*id) || groups.has(*id))
      throw Error(again(where, fmt::format("two resources have the id {}", *id)));
    const std::string object_where = fmt::format("{}: object {}", where, *id);
    MeshObject object = ObjectReader(groups, mm, object_where).object(node);
    triangles += object.mesh.triangles.size();
    if (triangles > max_triangles)
      throw Error(fmt::format("{}: more than {} triangles; simplify the mesh", where, max_triangles));
    part.objects.emplace(*id, std::move(object));
  }
  for (const pugi::xml_node node : model.child("build").children("item")) {
    const auto id = id_attribute(node, "objectid");
    if (!id) throw Error(again(where, "a build item without objectid"));
    part.build.push_back({std::string(attribute(node, "path")), *id, transform_of(node, mm, where),
                          attribute(node, "printable") != "0"});
  }
  if (progress.interrupted()) throw Error("interrupted");
  return part;
}

}  // namespace cleancolor
