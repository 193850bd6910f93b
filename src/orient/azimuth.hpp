// orient/azimuth.hpp
//
// Azimuth: by how much to turn a part on the bed so that idle nozzles hover least over another colour.
//
//   outlines of each layer and extruder, nozzle offsets  ->  interference and exposure at 360 angles, the best of them
//
// While nozzle i prints at p, idle nozzle j is at p + (delta_j - delta_i). Turning the part by theta is the same as
// turning that displacement by -theta, so nothing of the part is ever turned here.
//
// Interference (the paper's): the volume of all p in the plastic of i for which j is over plastic of another colour
// than j, summed over all ordered pairs. Exposure: the seconds that idle nozzles spend over visible plastic of another
// colour, each as visible as it is. The volume can mislead: a nozzle over the buried middle of a part harms nobody.
//
// Source: Hergel and Lefebvre, Clean color, section 4.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.hpp"
#include "model/config.hpp"
#include "slice/slices.hpp"

namespace cleancolor {

/// How long one nozzle stays over a place of one layer.
struct Pace {
  double shell_mm = 1.2;          // so far from its outline are perimeters
  double shell_s_mm2 = 1. / 20;   // there
  double inner_s_mm2 = 1. / 100;  // further in
};

/// From perimeters, widths, infill and speeds.
Pace pace(const Config& config, int extruder);

struct AzimuthOptions {
  std::vector<Vec2> nozzle_offset_mm;  // by extruder
  std::vector<Pace> pace;              // likewise
  std::function<bool(int)> fits;       // whether the part, turned by so many degrees, has room; empty: always
  int threads = 1;
};

/// Where the curves keep a turn of so many degrees, in (-180, 180] or [0, 360).
constexpr std::size_t azimuth_slot(int degrees) {
  return std::size_t((degrees + 360) % 360);
}
inline double at_azimuth(const std::vector<double>& curve, int degrees) {
  return curve[azimuth_slot(degrees)];
}

struct Azimuths {
  std::vector<double> interference_mm3;  // [360]: turned by 0, 1, ... 359 degrees, counterclockwise seen from above; of
                                         // more than two nozzles odd ones are means of their neighbours
  std::vector<double> exposure_s;        // likewise: visibility x seconds
  std::vector<char> fits;                // likewise
  double part_mm3 = 0;

  /// Of those that fit: of least exposure, give or take a quarter of it and 1 % of the largest (smears follow it no
  /// closer; 0 is good enough up to four tenths); and of least interference, give or take 0.1 % of the part's volume.
  /// Of equals the smallest turn, positive first, in (-180, 180]. Nothing where none fits.
  std::optional<int> best_deg;
  std::optional<int> least_interference_deg;

  /// Where the exposure has valleys that fit and are at most half again as deep as the deepest, at most four, the
  /// deepest first; and no turn, where it fits.
  std::vector<int> candidates_deg;

  /// The cleanest of them by trial (azimuth_trial.hpp), where that was made.
  std::optional<int> tried_deg;

  /// By how much the part is turned.
  std::optional<int> chosen_deg() const { return tried_deg ? tried_deg : best_deg; }
};

/// Cost: 10 ms for each million mm2 of outlines, then below 0.5 s on two cores, independent of triangles. The same for
/// any number of threads. One extruder alone: all zero, best 0.
/// Requires: offsets and paces for all extruders of the slices.
Azimuths azimuths(const Slices& slices, const AzimuthOptions& options);

/// Both curves around the compass as SVG: radius = share of the largest, what does not fit in grey, both choices
/// marked.
std::string azimuth_svg(const Azimuths& azimuths);

}  // namespace cleancolor
