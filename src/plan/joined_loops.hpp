// plan/joined_loops.hpp
//
// Joined loops: an outer wall that begins and ends inside the part.
//
//   loops of a layer  ->  outer walls with the loop inside them (Path::inner)  ->  one open path for each such pair
//
// Where extrusion starts or stops on an outer wall a zipper shows, and plastic that oozed out on the way is missing
// there. So the loop inside is printed first, goes over into the outer wall without a stop, and the outer wall ends by
// turning inwards, into a gap that the inner loop left:
//
//        <-- outer ----X<------ outer --          X  the joint, which is what the planner chooses
//                     . .                         gap and strokes take as much plastic as the closed loops would
//     inner <-------s     e<---- inner            s, e  where the inner loop begins and ends
//
// Differs: the paper prints closed loops one by one (6.3) and hides their ends where it can.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "toolpath/path.hpp"

namespace cleancolor {

/// Where the inner loop passes an outer wall.
struct Joint {
  std::size_t segment = 0;  // of the inner loop
  Vec2 at_mm;               // on it
};

/// Where path.inner passes this place of the path; nothing where it runs too far from it to be joined.
std::optional<Joint> joint_at(const Path& path, Vec2 at_mm);

/// Outer walls get the longest loop inside them as Path::inner, where their start or, if `anywhere`, some other place
/// allows a joint. The other paths stay as they are, in their order.
/// Requires: loops of an island are printed from the inside out.
std::vector<Path> with_inner_loops(std::vector<Path> paths, bool anywhere);

/// The same with the inner loop begun beside the start of the outer one.
Path inner_aligned(Path path);

/// One open path of both loops, joined at the start of the outer one; a path without inner loop as it is.
/// Its length is that of both loops, unless the corners at the joint are too tight.
Path joined(Path path);

/// How far inside an outer wall without inner loop extrusion can begin and end, seen from a place on one of its
/// segments: half the way to the next loop, at most 0.75 of the wall's width; 0 where that is too little to matter.
/// loops: those of its island, itself included.  Cost: one pass over them.
double lead_mm(const Path& path, std::size_t segment, Vec2 at_mm, std::span<const Path* const> loops);

/// An open path that comes from inside to the start of the wall, goes round and ends inside, as OrcaSlicer's
/// wipe_before_external_loop and wipe_on_loops do.
Path led_inside(Path path, double lead_mm);

}  // namespace cleancolor
