// cli/profiles.hpp
//
// cleancolor profiles, cleancolor profiles show, cleancolor options: what there is to choose from.
#pragma once

#include <string>

#include "cli/command_line.hpp"

namespace cleancolor {

/// The list of all profiles, or one of them as TOML.  Throws Error for an unknown name.
std::string text_of(const ProfilesCommand& command);

/// All options with a word in their name or help, or the reference in Markdown.  Throws Error where none has it.
std::string text_of(const OptionsCommand& command);

}  // namespace cleancolor
