// Where the program's words leave it: names, titles and paths in them are of others, and a terminal
// obeys control characters. Both streams tell these instead. For main(), before anything is
// printed; one thread.
#pragma once

#include <cstdio>

namespace luxodus::cli {

/// A stream of text onto another, of which control characters arrive as \xNN, but for ends of lines
/// and tabs. `below` stays open and gets everything on a flush. Null where there is no memory.
FILE* printable_stream(FILE* below);

/// Has all that is printed to standard output pass through printable_stream, and all that is logged
/// be printable.
void guard_terminal();

}  // namespace luxodus::cli
