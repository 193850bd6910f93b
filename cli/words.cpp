#include "cli/words.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace cleancolor {

void require_ending(const std::filesystem::path& path, std::string_view option, std::string_view ending,
                    std::string_view hint) {
  if (!path.empty() && path.extension() != ending)
    throw Error(fmt::format("{} {}: the file's name must end in {}; {}", option, path.string(), ending, hint));
}

}  // namespace cleancolor
