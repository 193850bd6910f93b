#include "model/stl.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "base/error.hpp"
#include "model/limits.hpp"
#include "model/text_scan.hpp"
#include "model/weld.hpp"

namespace cleancolor {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

std::size_t promised_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + std::size_t(i)]);
  return count;
}

float float_at(const char* p) {
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) bits = bits << 8 | static_cast<unsigned char>(p[i]);
  return std::bit_cast<float>(bits);
}

/// ASCII files say "solid" first, but so do the headers of some binary ones; only text goes on with a facet.
bool is_ascii(std::string_view bytes) {
  Scanner scan(bytes.substr(0, 4096));
  if (!is_keyword(scan.word(), "solid")) return false;
  scan.rest_of_line();
  const std::string_view next = scan.word();
  return is_keyword(next, "facet") || is_keyword(next, "endsolid") ||
         bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

class SoupBuilder {
 public:
  explicit SoupBuilder(std::size_t expected) : welder_(expected / 2) { triangles_.reserve(expected); }

  void add(const std::array<Vec3, 3>& corners) {
    triangles_.push_back({welder_.add(corners[0]), welder_.add(corners[1]), welder_.add(corners[2])});
  }
  std::size_t size() const { return triangles_.size(); }
  Mesh take() { return {welder_.take(), std::move(triangles_)}; }

 private:
  ExactWelder welder_;
  std::vector<Triangle> triangles_;
};

Mesh read_binary(std::string_view bytes, std::size_t count, const std::string& name) {
  SoupBuilder soup(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* corner = bytes.data() + header_bytes + i * facet_bytes + 12;  // after the normal
    std::array<Vec3, 3> corners;
    for (Vec3& p : corners) {
      p = {float_at(corner), float_at(corner + 4), float_at(corner + 8)};
      corner += 12;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(fmt::format("{}: triangle {} of {}: a corner is not a finite number; export the mesh again", name,
                                i + 1, count));
    }
    soup.add(corners);
  }
  return soup.take();
}

class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, const std::string& name, const Progress& progress)
      : scan_(bytes), name_(name), progress_(progress), soup_(bytes.size() / 250) {}

  Mesh mesh() {
    bool in_solid = false;
    for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word()) {
      if (is_keyword(word, "solid") || is_keyword(word, "endsolid")) {
        in_solid = is_keyword(word, "solid");
        scan_.rest_of_line();  // the name of the solid
      } else if (in_solid && is_keyword(word, "facet")) {
        facet();
      } else if (in_solid || is_keyword(word, "facet")) {
        fail("facet", word);
      }  // words after the last endsolid are stray but harmless
    }
    if (in_solid && soup_.size() > 0)
      progress_.warn(fmt::format("{}: the closing endsolid is missing; the file may be cut short", name_));
    return soup_.take();
  }

 private:
  void facet() {
    if (soup_.size() == max_triangles)
      throw Error(fmt::format("{}: more than {} triangles; simplify the mesh", name_, max_triangles));
    skip_to("outer", 5);  // normal x y z
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& p : corners) {
      expect("vertex");
      p = {coordinate(), coordinate(), coordinate()};
    }
    expect("endloop");
    skip_to("endfacet", 8);
    scan_.rest_of_line();
    soup_.add(corners);
  }

  double coordinate() {
    const std::string_view word = scan_.word();
    const auto value = number<double>(word);
    if (!value) fail("a finite number", word);
    return *value;
  }

  void expect(std::string_view keyword) {
    const std::string_view word = scan_.word();
    if (!is_keyword(word, keyword)) fail(keyword, word);
  }

  /// Up to the keyword, over a few words of no interest.
  void skip_to(std::string_view keyword, int words) {
    std::string_view word = scan_.word();
    while (!word.empty() && words-- > 0 && !is_keyword(word, keyword)) word = scan_.word();
    if (!is_keyword(word, keyword)) fail(keyword, word);
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    throw Error(found.empty() ? fmt::format("{}: line {}: the ASCII STL ends where {} should follow; the file is cut "
                                            "short, export it again",
                                            name_, scan_.line(), expected)
                              : fmt::format("{}: line {}: {} should stand here, not '{}'; export the mesh again", name_,
                                            scan_.line(), expected, shown(found)));
  }

  Scanner scan_;
  const std::string& name_;
  const Progress& progress_;
  SoupBuilder soup_;
};

/// How many facets to read where the length of the file does not simply follow from the count in its header.
std::size_t usable_facets(std::string_view bytes, const std::string& name, const Progress& progress) {
  if (bytes.size() < header_bytes)
    throw Error(fmt::format("{}: {} bytes are too few for an STL file; export the mesh again", name, bytes.size()));
  const std::size_t promised = promised_facets(bytes);
  const std::size_t room = (bytes.size() - header_bytes) / facet_bytes;
  if (promised > room)
    throw Error(
        fmt::format("{}: cut short, or no STL file: {} triangles are promised, {} are there; export the mesh again",
                    name, promised, room));
  const std::size_t extra = bytes.size() - header_bytes - promised * facet_bytes;
  if (extra >= facet_bytes)
    throw Error(fmt::format("{}: the header promises {} triangles, but {} are there; export the mesh again", name,
                            promised, room));
  if (extra > 0) progress.warn(fmt::format("{}: {} stray bytes after the last triangle are ignored", name, extra));
  return promised;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_bytes && bytes.size() == header_bytes + promised_facets(bytes) * facet_bytes;
}

Part read_stl(std::string_view bytes, const std::string& name, const Progress& progress) {
  Part part;
  part.name = name;
  if (bytes.empty()) throw Error(fmt::format("{}: the file is empty; export the mesh again", name));
  if (!is_binary_stl(bytes) && is_ascii(bytes)) {
    part.mesh = AsciiReader(bytes, name, progress).mesh();
  } else {
    const std::size_t count = usable_facets(bytes, name, progress);
    if (count > max_triangles)
      throw Error(fmt::format("{}: {} triangles, more than {}; simplify the mesh", name, count, max_triangles));
    part.mesh = read_binary(bytes, count, name);
  }
  if (part.mesh.triangles.empty())
    throw Error(fmt::format("{}: no triangles in the STL file; export the mesh again", name));
  return part;
}

}  // namespace cleancolor
