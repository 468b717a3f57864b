// Makes file names from names in a scene. A plane may be called "before the sign" or "Flur 1/2";
// file names must be safe in shells, links and other systems. Pure; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

/// The name with everything but letters, digits, '.', '-', '_' and characters beyond ASCII replaced
/// by '_'. A leading '.' or '-' is replaced, too. Never empty.
std::string file_name_of(std::string_view name);

/// One file name for each thing, in their order. Each thing has a file for every ending, and no two
/// files have the same name, even ignoring case: the later thing gets "-2", "-3", ...
std::vector<std::string> file_names_of(std::span<const std::string> names,
                                       std::span<const char* const> endings);

}  // namespace luxodus
