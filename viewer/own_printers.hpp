// viewer/own_printers.hpp
//
// OwnPrinters: printer profiles of the user's own, which jobs and prints may name beside the built-in ones: that of the
// command line, and those sent to the program.
//
// Other files cannot be named, for whoever asks need not be allowed to read what this program can. For the same reason
// a profile that was sent inherits built-in ones only. Each is read once: a file that is edited later changes nothing.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/profile.hpp"

namespace cleancolor {

struct OwnPrinter {
  Profile profile;  // whose name is that by which jobs name it
  std::string row;  // of GET /api/profiles
};
using OwnPrinterHandle = std::shared_ptr<const OwnPrinter>;

/// Several threads may use one. Nothing is read or checked under its lock.
class OwnPrinters {
 public:
  static constexpr std::size_t most = 64;  // with that of the command line

  OwnPrinters() = default;

  /// given: of the command line: a built-in one, which is none of these, or a file, which stays as it is now. Throws
  /// Error where the file cannot be used.
  explicit OwnPrinters(const std::string& given);

  /// nullptr where there is none.
  OwnPrinterHandle find(const std::string& name) const;

  /// By name.
  std::vector<OwnPrinterHandle> all() const;

  /// Keeps the profile in this text, in place of one of the same name that was sent before. Throws
  /// ApiError, and then all is as before: 400 for the name of the one given or a text that cannot be used, 503 where
  /// there are too many.
  void keep(const std::string& name, const std::string& toml);

  /// False where none of this name was sent; the one given was not.
  bool forget(const std::string& name);

 private:
  std::string given_;
  mutable std::mutex mutex_;
  std::map<std::string, OwnPrinterHandle> printers_;  // guarded
};

/// The profile in this text. Throws Error("name:line: ...") in words where it cannot be used as a printer's profile by
/// itself, or would have other files read.
Profile check_printer(const std::string& toml, const std::string& name);

}  // namespace cleancolor
