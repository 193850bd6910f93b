#include "model/edges.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace cleancolor {

std::vector<EdgeUse> edge_uses(const Mesh& mesh) {
  // A counting sort by the lower end, then the few edges of each vertex by the upper end.
  std::vector<std::uint32_t> first(mesh.vertices.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++first[std::min(t[k], t[(k + 1) % 3]) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];

  std::vector<EdgeUse> uses(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      assert(a != b);
      uses[next[std::min(a, b)]++] = {std::min(a, b), std::max(a, b), std::uint32_t(3 * t + k), a < b};
    }
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
    std::sort(uses.begin() + first[v], uses.begin() + first[v + 1], [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.half_edge) < std::tie(b.high, b.half_edge);
    });
  return uses;
}

std::size_t edge_size(std::span<const EdgeUse> uses, std::size_t from) {
  std::size_t end = from + 1;
  while (end < uses.size() && uses[end].low == uses[from].low && uses[end].high == uses[from].high) ++end;
  return end - from;
}

int edge_balance(std::span<const EdgeUse> edge) {
  int balance = 0;
  for (const EdgeUse& use : edge) balance += use.up ? 1 : -1;
  return balance;
}

}  // namespace cleancolor
