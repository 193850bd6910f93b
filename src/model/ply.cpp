#include "model/ply.hpp"

#include <fmt/format.h>

#include <bit>
#include <optional>

#include "base/error.hpp"
#include "model/limits.hpp"
#include "model/text_scan.hpp"
#include "model/triangulate.hpp"

namespace cleancolor {

namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Encoding { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  // set: a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t bytes = 0;
};

std::optional<Scalar> scalar(std::string_view word) {
  constexpr std::string_view names[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                           {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                           {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < std::size(names); ++i)
    if (word == names[i][0] || word == names[i][1]) return Scalar(i);
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : scan_(bytes), name_(name) {}

  Header header() {
    if (scan_.rest_of_line() != "ply") fail("a PLY file starts with the line 'ply'");
    bool has_format = false;
    for (;;) {
      if (scan_.done()) fail("the header does not end; the file is cut short");
      const std::string_view keyword = scan_.word_on_line();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        encoding(scan_.word_on_line());
        has_format = true;
      } else if (keyword == "element") {
        element();
      } else if (keyword == "property") {
        property();
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        fail(fmt::format("'{}' is no keyword of a PLY header", shown(keyword)));
      }
      scan_.rest_of_line();
    }
    if (!has_format) fail("the format line is missing");
    scan_.rest_of_line();
    header_.bytes = scan_.position();
    return header_;
  }

 private:
  void encoding(std::string_view word) {
    if (word == "ascii")
      header_.encoding = Encoding::ascii;
    else if (word == "binary_little_endian")
      header_.encoding = Encoding::little_endian;
    else if (word == "binary_big_endian")
      header_.encoding = Encoding::big_endian;
    else
      fail(fmt::format("'{}' is no PLY format", shown(word)));
  }

  void element() {
    Element element;
    element.name = scan_.word_on_line();
    const std::string_view word = scan_.word_on_line();
    const auto count = number<std::uint32_t>(word);
    if (!count) fail(fmt::format("'{}' is no count of elements", shown(word)));
    element.count = *count;
    header_.elements.push_back(std::move(element));
  }

  void property() {
    if (header_.elements.empty()) fail("a property before the first element");
    Property property;
    std::string_view word = scan_.word_on_line();
    if (word == "list") {
      property.count_type = type(scan_.word_on_line());
      if (*property.count_type >= Scalar::float32) fail("the length of a list is a whole number");
      word = scan_.word_on_line();
    }
    property.type = type(word);
    property.name = scan_.word_on_line();
    header_.elements.back().properties.push_back(std::move(property));
  }

  Scalar type(std::string_view word) const {
    const auto type = scalar(word);
    if (!type) fail(fmt::format("'{}' is no type of a PLY property", shown(word)));
    return *type;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: line {}: {}; export the mesh again", name_, scan_.line(), what));
  }

  Scanner scan_;
  const std::string& name_;
  Header header_;
};

/// The values after the header, one after another.
class Values {
 public:
  Values(std::string_view bytes, Encoding encoding, const std::string& name)
      : bytes_(bytes), scan_(bytes), encoding_(encoding), name_(name) {}

  double next(Scalar type) {
    if (encoding_ == Encoding::ascii) {
      const std::string_view word = scan_.word();
      if (word.empty()) cut_short();
      const auto value = number<double>(word);
      return value ? *value : std::nan("");
    }
    switch (type) {
      case Scalar::int8:
        return std::int8_t(raw<std::uint8_t>());
      case Scalar::uint8:
        return raw<std::uint8_t>();
      case Scalar::int16:
        return std::int16_t(raw<std::uint16_t>());
      case Scalar::uint16:
        return raw<std::uint16_t>();
      case Scalar::int32:
        return std::int32_t(raw<std::uint32_t>());
      case Scalar::uint32:
        return raw<std::uint32_t>();
      case Scalar::float32:
        return double(std::bit_cast<float>(raw<std::uint32_t>()));
      case Scalar::float64:
        return std::bit_cast<double>(raw<std::uint64_t>());
    }
    return 0;
  }

 private:
  template <class Unsigned>
  Unsigned raw() {
    if (bytes_.size() - at_ < sizeof(Unsigned)) cut_short();
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      const std::size_t from_high = encoding_ == Encoding::big_endian ? i : sizeof(Unsigned) - 1 - i;
      value = Unsigned(std::uint64_t(value) << 8 | static_cast<unsigned char>(bytes_[at_ + from_high]));
    }
    at_ += sizeof(Unsigned);
    return value;
  }

  [[noreturn]] void cut_short() const {
    throw Error(fmt::format("{}: the PLY file ends before all its elements are there; export the mesh again", name_));
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  Scanner scan_;
  Encoding encoding_;
  const std::string& name_;
};

class BodyReader {
 public:
  BodyReader(Values values, const std::string& name) : values_(std::move(values)), name_(name) {}

  void element(const Element& element) {
    if (element.properties.empty()) return;
    for (std::size_t i = 0; i < element.count; ++i) {
      Vec3 p;
      corners_.clear();
      for (const Property& property : element.properties) {
        const double value = read(property, element.name == "face");
        if (property.name == "x") p.x = value;
        if (property.name == "y") p.y = value;
        if (property.name == "z") p.z = value;
      }
      if (element.name == "vertex") vertex(p, i);
      if (element.name == "face") face(i);
    }
  }

  /// Faces may come before the vertices, so their indices are checked at the end.
  Mesh mesh() {
    Mesh mesh{std::move(vertices_), {}};
    for (std::size_t f = 0; f + 1 < first_corner_.size(); ++f) {
      const std::size_t from = first_corner_[f], count = first_corner_[f + 1] - from;
      polygon_.clear();
      for (std::size_t k = from; k < from + count; ++k) {
        if (all_corners_[k] >= mesh.vertices.size())
          throw Error(fmt::format("{}: face {}: vertex {} does not exist; there are {}; export the mesh again", name_,
                                  f, all_corners_[k], mesh.vertices.size()));
        polygon_.push_back(mesh.vertices[all_corners_[k]]);
      }
      for (const Triangle& t : triangulated(polygon_))
        mesh.triangles.push_back({all_corners_[from + t[0]], all_corners_[from + t[1]], all_corners_[from + t[2]]});
    }
    return mesh;
  }

 private:
  /// The value of a plain property; of a list nothing, but its items are kept where they are corners.
  double read(const Property& property, bool in_face) {
    if (!property.count_type) return values_.next(property.type);
    const double count = values_.next(*property.count_type);
    const bool wanted = in_face && (property.name == "vertex_indices" || property.name == "vertex_index");
    for (double k = 0; k < count; ++k) {
      const double value = values_.next(property.type);
      if (!wanted) continue;
      if (!(value >= 0 && value < UINT32_MAX && value == std::floor(value)))
        throw Error(fmt::format("{}: {} is no vertex index; export the mesh again", name_, value));
      corners_.push_back(std::uint32_t(value));
    }
    return 0;
  }

  void vertex(const Vec3& p, std::size_t i) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Error(fmt::format("{}: vertex {}: a coordinate is not a finite number; export the mesh again", name_, i));
    vertices_.push_back(p);
  }

  void face(std::size_t i) {
    if (corners_.size() < 3)
      throw Error(fmt::format("{}: face {} has {} corners; it needs three at least; export the mesh again", name_, i,
                              corners_.size()));
    triangles_ += corners_.size() - 2;
    if (triangles_ > max_triangles)
      throw Error(fmt::format("{}: more than {} triangles; simplify the mesh", name_, max_triangles));
    all_corners_.insert(all_corners_.end(), corners_.begin(), corners_.end());
    first_corner_.push_back(all_corners_.size());
  }

  Values values_;
  const std::string& name_;
  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> corners_;  // of the face being read
  std::vector<std::uint32_t> all_corners_;
  std::vector<std::size_t> first_corner_ = {0};
  std::vector<Vec3> polygon_;
  std::size_t triangles_ = 0;
};

bool has_property(const Header& header, std::string_view element, std::string_view property) {
  for (const Element& e : header.elements)
    for (const Property& p : e.properties)
      if (e.name == element && p.name == property) return true;
  return false;
}

}  // namespace

Part read_ply(std::string_view bytes, const std::string& name, const Progress& progress) {
  const Header header = HeaderReader(bytes, name).header();
  for (const std::string_view coordinate : {"x", "y", "z"})
    if (!has_property(header, "vertex", coordinate))
      throw Error(fmt::format("{}: the vertices have no {}; export the mesh again", name, coordinate));
  if (has_property(header, "vertex", "red") || has_property(header, "face", "red"))
    progress.warn(fmt::format("{}: the colours of a PLY file are ignored; the part is printed by one extruder", name));

  BodyReader body(Values(bytes.substr(header.bytes), header.encoding, name), name);
  for (const Element& element : header.elements) body.element(element);
  Part part;
  part.name = name;
  part.mesh = body.mesh();
  if (part.mesh.triangles.empty())
    throw Error(fmt::format("{}: no faces in the PLY file; export the mesh again", name));
  return part;
}

}  // namespace cleancolor
