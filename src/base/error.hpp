// base/error.hpp
//
// Error: the one exception of the program. Input or options that cannot be used, said so that a person can mend them.
//
// Thrown by readers, checks and the pipeline; caught once, in main. What was found wrong but could be mended is not an
// Error but a warning: see base/progress.hpp.
#pragma once

#include <stdexcept>
#include <string>

namespace cleancolor {

/// The message names the file, the place in it where known, the reason, and what to do:
///   "land.stl: triangle 17 of 2374: a corner is not a finite number; export the mesh again"
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A failure of the machine, not of the input: the disc is full, a file cannot be written. Exit code 3 instead of 2.
class SystemError : public Error {
 public:
  using Error::Error;
};

}  // namespace cleancolor
