// tests/model/meshes.hpp
//
// Small meshes of known volume, and a Progress that keeps what it is told.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"

namespace cleancolor {

/// An axis-aligned box, facing outward; 12 triangles. Triangles 0 and 1 are its bottom, 2 and 3 its top.
inline Mesh box_mesh(Vec3 min, Vec3 max) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline Mesh joined(Mesh a, const Mesh& b) {
  const auto first = std::uint32_t(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

inline Mesh inside_out(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Every triangle with vertices of its own, as in an STL file.
inline Mesh soup(const Mesh& mesh) {
  Mesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto first = std::uint32_t(result.vertices.size());
    for (const std::uint32_t i : t) result.vertices.push_back(mesh.vertices[i]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

struct Warnings {
  std::vector<std::string> texts;
  Progress progress;

  Warnings() {
    progress.warn = [this](const std::string& text) { texts.push_back(text); };
  }
  Warnings(const Warnings&) = delete;

  bool contain(std::string_view word) const {
    for (const std::string& text : texts)
      if (text.find(word) != std::string::npos) return true;
    return false;
  }
  std::string all() const {
    std::string joined;
    for (const std::string& text : texts) joined += text + "\n";
    return joined;
  }
};

/// What the Error says that the call throws; empty where it throws none.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

inline testing::AssertionResult says(const std::string& text, std::string_view words) {
  if (text.find(words) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << words << "' is not in: " << text;
}

}  // namespace cleancolor
