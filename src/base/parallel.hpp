// base/parallel.hpp
//
// Parallel: a parallel for, and an ordered stream of layers with parallel stages and a serial end.
//
// Results do not depend on the number of threads: each index owns its slot, and the serial end sees the indices in
// order. The first exception stops the work and is thrown to the caller.
#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace cleancolor {

/// threads > 0 as it is; 0: as many as the machine has.
int thread_count(int threads);

/// Calls body(i) once for every i in [0, count), on up to `threads` threads.
void parallel_for(int count, int threads, const std::function<void(int)>& body);

/// One parallel step of a stream: body(i) runs once the stage before has done every index within reach of i.
struct Stage {
  int reach = 0;
  std::function<void(int)> body;
  /// It begins no index so far beyond the first that the end has not had; few where its results are large.
  int ahead = std::numeric_limits<int>::max();
};

/// Stages over the indices 0 ... count - 1, then a serial end.
struct Stream {
  int count = 0;
  int window = 16;                   // how far the first stage may run ahead of the end: bounds the memory
  std::vector<Stage> stages;         // at least one; the reach of the first is not used
  std::function<void(int)> consume;  // one at a time, ascending, after the last stage
};

/// Runs the stream on `threads` threads (0: as many as the machine has).
/// Requires: window > the sum of all reaches, and a stage's ahead > the sum of those after it, else the stream could
/// wait for itself.
void run(const Stream& stream, int threads);

}  // namespace cleancolor
