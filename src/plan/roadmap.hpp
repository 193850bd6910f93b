// plan/roadmap.hpp
//
// Roadmap: places that the carriage can pass, and the ways between neighbouring places with their cost.
//
//   paths of a layer, what lies where  ->  nodes and arcs in the carriage's frame (where nozzle 0 is)
//
// Nodes lie at exact coordinates: on each closed path one for each stretch of 1.5 mm, at the least visible of a few
// places; at both ends of open paths; and on the pathways between: around what must not be crossed, in the middle
// between two such shapes, and along the walls of the rampart. Arcs are the edges of their Delaunay triangulation, so
// all of them hang together.
//
// Source: Hergel and Lefebvre, Clean color, section 6.4; nodes on a grid of 0.05 mm there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/cost.hpp"
#include "toolpath/path.hpp"

namespace cleancolor {

/// Where a path can be entered.
struct Entry {
  std::uint32_t node = 0;
  std::uint32_t segment = 0;  // of the path; of an open path its first or last
  Vec2 at_mm;                 // on it, where the plastic lies
  double ahead = 0;           // visibility of the first road of an outer wall
  double lead_mm = 0;         // so far inside it can begin and end (plan/joined_loops.hpp)
};

struct Arc {
  std::uint32_t to = 0;
  float cost = 0;
  float foreign = 0;  // the largest visibility of foreign plastic that it crosses
  double length_mm = 0;
};

struct Roadmap {
  std::vector<Vec2> nodes_mm;
  std::vector<std::uint32_t> reached_by;    // of each node: bit k: by the k-th nozzle of the cost
  std::vector<std::uint32_t> first_arc;     // of each node, and the end
  std::vector<Arc> arcs;                    // both ways
  std::vector<std::vector<Entry>> entries;  // of each path: of an open one its start and its end

  std::span<const Arc> arcs_of(std::uint32_t node) const {
    return std::span(arcs).subspan(first_arc[node], first_arc[node + 1] - first_arc[node]);
  }
};

struct RoadmapOptions {
  double spacing_mm = 1.5;    // of entries on closed paths
  double clearance_mm = 1.6;  // of ways around what must not be crossed
  double pathway_mm = 2;      // between nodes of pathways
  double margin_mm = 6;       // beyond the paths
  bool fixed_seams = false;   // closed paths are entered at their start alone
  bool leads = true;          // outer walls without inner loop may begin and end inside, but for those of a source
};

/// The roadmap of a layer whose paths are printed in this order. Closed paths of the rampart are entered at their start
/// alone: it was chosen.
/// Requires: the nozzles of all paths are among those of the cost.  Cost: 3 to 10 ms a layer with 1 m of paths.
Roadmap roadmap(std::span<const Path> paths, const TravelCost& cost, const RoadmapOptions& options = {});

}  // namespace cleancolor
