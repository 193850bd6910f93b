#include "model/obj.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "model/limits.hpp"
#include "model/text_scan.hpp"
#include "model/triangulate.hpp"

namespace cleancolor {

namespace {

/// What the faces of one usemtl name; several usemtl lines with one name are one material.
struct Group {
  std::string material;
  std::vector<Triangle> triangles;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : scan_(bytes), name_(name) {}

  void read() {
    while (!scan_.done()) {
      const std::string_view keyword = scan_.word_on_line();
      if (keyword == "v")
        vertex();
      else if (keyword == "f" || keyword == "fo")
        face();
      else if (keyword == "usemtl")
        use(std::string(scan_.rest_of_line()));
      else
        scan_.rest_of_line();
    }
  }

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Group>& groups() const { return groups_; }

 private:
  void vertex() {
    Vec3 p;
    for (double* coordinate : {&p.x, &p.y, &p.z}) {
      const std::string_view word = scan_.word_on_line();
      const auto value = number<double>(word);
      if (!value) fail(fmt::format("a finite number should stand here, not '{}'", shown(word)));
      *coordinate = *value;
    }
    vertices_.push_back(p);
    scan_.rest_of_line();  // a weight or a colour
  }

  void face() {
    corners_.clear();
    for (std::string_view word = scan_.word_on_line(); !word.empty(); word = scan_.word_on_line()) {
      if (word.starts_with('#')) break;
      if (word == "\\")
        scan_.rest_of_line();  // the face goes on in the next line
      else
        corners_.push_back(index(word));
    }
    if (corners_.size() < 3) fail(fmt::format("a face of {} corners; it needs three at least", corners_.size()));
    triangles_ += corners_.size() - 2;
    if (triangles_ > max_triangles) fail(fmt::format("more than {} triangles; simplify the mesh", max_triangles));
    scan_.rest_of_line();  // a comment
    add_face();
  }

  void add_face() {
    if (groups_.empty()) use("");
    std::vector<Triangle>& triangles = groups_[group_].triangles;
    if (corners_.size() == 3) {
      triangles.push_back({corners_[0], corners_[1], corners_[2]});
      return;
    }
    std::vector<Vec3> polygon;
    polygon.reserve(corners_.size());
    for (const std::uint32_t i : corners_) polygon.push_back(vertices_[i]);
    for (const Triangle& t : triangulated(polygon))
      triangles.push_back({corners_[t[0]], corners_[t[1]], corners_[t[2]]});
  }

  /// "7", "7/1", "7//3", "7/1/3", "-1": the vertex index before the first slash, made 0-based.
  std::uint32_t index(std::string_view word) const {
    const auto value = number<long long>(word.substr(0, word.find('/')));
    if (!value) fail(fmt::format("a vertex index should stand here, not '{}'", shown(word)));
    if (*value == 0) fail("vertex index 0; indices start at 1");
    const auto count = static_cast<long long>(vertices_.size());
    const long long i = *value > 0 ? *value - 1 : count + *value;
    if (*value > count || *value < -count)
      fail(fmt::format("vertex {} does not exist; there are {} so far", *value, vertices_.size()));
    return std::uint32_t(i);
  }

  void use(std::string material) {
    const auto found =
        std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.material == material; });
    group_ = std::size_t(found - groups_.begin());
    if (found != groups_.end()) return;
    if (groups_.size() == max_parts) fail("too many materials");
    groups_.push_back({std::move(material), {}});
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: line {}: {}; export the mesh again", name_, scan_.line(), what));
  }

  Scanner scan_;
  const std::string& name_;
  std::vector<Vec3> vertices_;
  std::vector<Group> groups_;
  std::size_t group_ = 0;
  std::size_t triangles_ = 0;
  std::vector<std::uint32_t> corners_;
};

/// Throws where two materials share a vertex: one surface in two colours.
void require_separate(const std::vector<Group>& groups, std::size_t vertices, const std::string& name) {
  std::vector<std::uint32_t> owner(vertices, UINT32_MAX);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Triangle& t : groups[g].triangles)
      for (const std::uint32_t i : t) {
        if (owner[i] != UINT32_MAX && owner[i] != g)
          throw Error(
              fmt::format("{}: one surface is painted in several materials ('{}' and '{}' meet), which a later "
                          "version will print; split it into closed bodies, or remove the usemtl lines",
                          name, shown(groups[owner[i]].material), shown(groups[g].material)));
        owner[i] = std::uint32_t(g);
      }
}

}  // namespace

std::vector<std::string> material_libraries(std::string_view obj_bytes) {
  std::vector<std::string> names;
  Scanner scan(obj_bytes);
  while (!scan.done()) {
    const bool wanted = scan.word_on_line() == "mtllib";
    const std::string_view rest = scan.rest_of_line();
    if (wanted && !rest.empty()) names.emplace_back(rest);
  }
  return names;
}

MaterialColours read_mtl(std::string_view bytes) {
  MaterialColours colours;
  std::string material;
  Scanner scan(bytes);
  while (!scan.done()) {
    const std::string_view keyword = scan.word_on_line();
    if (keyword == "newmtl") {
      material = scan.rest_of_line();
      continue;
    }
    if (keyword == "Kd") {
      std::uint32_t rgb = 0;
      bool good = true;
      for (int channel = 0; channel < 3; ++channel) {
        const auto value = number<double>(scan.word_on_line());
        good = good && value && *value >= 0 && *value <= 1;
        rgb = rgb << 8 | (good ? std::uint32_t(std::lround(*value * 255)) : 0);
      }
      if (good) colours[material] = rgb;
    }
    scan.rest_of_line();
  }
  return colours;
}

std::vector<Part> read_obj(std::string_view bytes, const std::string& name, const MaterialColours& colours) {
  ObjReader reader(bytes, name);
  reader.read();
  std::vector<Group> used;
  for (const Group& group : reader.groups())
    if (!group.triangles.empty()) used.push_back(group);
  if (used.empty()) throw Error(fmt::format("{}: no faces in the OBJ file; export the mesh again", name));
  require_separate(used, reader.vertices().size(), name);

  std::vector<Part> parts;
  for (const Group& group : used) {
    Part part;
    part.name = used.size() == 1 ? name : fmt::format("{}: {}", name, shown(group.material));
    part.mesh = submesh(reader.vertices(), group.triangles);
    if (const auto colour = colours.find(group.material); colour != colours.end())
      part.rgb = colour->second;
    else
      part.material = group.material;
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace cleancolor
