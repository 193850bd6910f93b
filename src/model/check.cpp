#include "model/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "model/edges.hpp"
#include "model/repair.hpp"
#include "model/shells.hpp"

namespace cleancolor {

namespace {

struct EdgeFaults {
  std::size_t unbalanced = 0;  // not passed as often one way as the other
  std::size_t crowded = 0;     // balanced, but of four triangles or more
};

EdgeFaults faults(std::span<const EdgeUse> uses) {
  EdgeFaults faults;
  for (std::size_t i = 0, n = 0; i < uses.size(); i += n) {
    n = edge_size(uses, i);
    if (edge_balance(uses.subspan(i, n)) != 0)
      ++faults.unbalanced;
    else if (n > 2)
      ++faults.crowded;
  }
  return faults;
}

std::string counted(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// A mesh on its way through the checks, with its edges kept up to date.
class Check {
 public:
  Check(Mesh mesh, const std::string& name, const Progress& progress, const CheckLimits& limits)
      : mesh_(std::move(mesh)), name_(name), progress_(progress), limits_(limits) {}

  Mesh sound() {
    require_finite();
    weld_exactly();
    if (faults_.unbalanced + faults_.crowded > 0) drop_duplicates();
    if (faults_.unbalanced > 0) weld_nearly();
    if (faults_.unbalanced > 0) wind_consistently();
    if (faults_.unbalanced > 0) close_holes();
    if (faults_.unbalanced > 0)
      refuse(fmt::format("the surface is open or wound both ways at {}", counted(faults_.unbalanced, "edge", "edges")));
    if (faults_.crowded > 0)
      warn(fmt::format("{} shared by four or more triangles; printed as it is",
                       counted(faults_.crowded, "edge is", "edges are")));
    face_outward();
    require_volume();
    for (const std::string& warning : warnings_) progress_.warn(warning);
    return std::move(mesh_);
  }

 private:
  void require_finite() const {
    if (mesh_.triangles.empty()) refuse("the mesh has no triangles");
    for (const Vec3& p : mesh_.vertices)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse("a vertex is not finite");
    for (const Vec3& p : mesh_.vertices)
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > limits_.farthest_mm)
        refuse(fmt::format("a vertex lies more than {} km from the origin; check its unit", limits_.farthest_mm / 1e6));
  }

  void take(Mesh mesh) {
    mesh_ = std::move(mesh);
    uses_ = edge_uses(mesh_);
    faults_ = faults(uses_);
  }

  void weld_exactly() {
    Repaired welded = exactly_welded(std::move(mesh_));
    if (welded.changed > 0)
      warn(fmt::format("{} without area dropped", counted(welded.changed, "triangle", "triangles")));
    if (welded.mesh.triangles.empty()) refuse("it is flat: no triangle has an area");
    take(std::move(welded.mesh));
  }

  void drop_duplicates() {
    Repaired single = without_duplicates(mesh_, uses_);
    if (single.changed == 0) return;
    // Folded surfaces pass through the same triangle twice and are closed only with both: those stay.
    const bool was_closed = faults_.unbalanced == 0;
    std::vector<EdgeUse> uses = edge_uses(single.mesh);
    const EdgeFaults left = faults(uses);
    if (was_closed && left.unbalanced > 0) return;
    warn(fmt::format("{} present twice, dropped", counted(single.changed, "triangle was", "triangles were")));
    mesh_ = std::move(single.mesh);
    uses_ = std::move(uses);
    faults_ = left;
  }

  void weld_nearly() {
    Repaired welded = nearly_welded(std::move(mesh_), uses_, limits_.weld_mm);
    if (welded.changed > 0)
      warn(fmt::format("{} joined to neighbours within {} mm", counted(welded.changed, "vertex", "vertices"),
                       limits_.weld_mm));
    if (welded.mesh.triangles.empty())
      refuse("it is smaller than the accuracy of a printer; check its unit, or use --scale");
    take(std::move(welded.mesh));
  }

  void wind_consistently() {
    std::optional<Repaired> wound = consistently_wound(mesh_, uses_);
    if (!wound) refuse("the surface has only one side, like a Moebius strip");
    if (wound->changed > 0)
      warn(fmt::format("{} facing the wrong way, turned", counted(wound->changed, "triangle was", "triangles were")));
    take(std::move(wound->mesh));
  }

  void close_holes() {
    ClosedHoles closed = without_holes(std::move(mesh_), uses_, limits_);
    if (closed.open > 0)
      refuse(fmt::format("the surface is open: {} near ({:.1f}, {:.1f}, {:.1f}), up to {:.1f} mm across",
                         counted(closed.open, "hole", "holes"), closed.where_open_mm.x, closed.where_open_mm.y,
                         closed.where_open_mm.z, closed.largest_open_mm));
    if (closed.holes > 0)
      warn(fmt::format("{} closed, up to {:.2f} mm across, with {}", counted(closed.holes, "hole", "holes"),
                       closed.largest_mm, counted(closed.triangles, "triangle", "triangles")));
    take(std::move(closed.mesh));
  }

  void face_outward() {
    Outward outward = facing_outward(std::move(mesh_), uses_);
    mesh_ = std::move(outward.mesh);
    if (!outward.tested_all) refuse("too many shells within shells");
    if (outward.turned > 0)
      warn(fmt::format("{} inside out, turned", counted(outward.turned, "shell was", "shells were")));
    if (outward.touching > 0)
      warn(fmt::format("shells touch in {}; printed as they are", counted(outward.touching, "vertex", "vertices")));
    if (outward.overlapping > 0)
      warn(fmt::format("{} into another one; they are united",
                       counted(outward.overlapping, "shell reaches", "shells reach")));
  }

  void require_volume() const {
    double area_mm2 = 0;
    for (const auto& [a, b, c] : mesh_.triangles)
      area_mm2 += length(cross(mesh_.vertices[b] - mesh_.vertices[a], mesh_.vertices[c] - mesh_.vertices[a])) / 2;
    // A sheet of one micrometre has half its surface as volume per micrometre.
    if (!(volume_mm3(mesh_) > 1e-6 * area_mm2)) refuse("it is flat: it encloses no volume");
  }

  /// Kept back until the mesh is accepted: what was mended is of no interest in a mesh that is refused.
  void warn(const std::string& what) { warnings_.push_back(fmt::format("{}: {}", name_, what)); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(fmt::format("{}: {}; repair the mesh in the program that made it", name_, what));
  }

  Mesh mesh_;
  std::vector<EdgeUse> uses_;
  EdgeFaults faults_;
  std::vector<std::string> warnings_;
  const std::string& name_;
  const Progress& progress_;
  const CheckLimits& limits_;
};

}  // namespace

Mesh checked(Mesh mesh, const std::string& name, const Progress& progress, const CheckLimits& limits) {
  return Check(std::move(mesh), name, progress, limits).sound();
}

}  // namespace cleancolor
