// Escapes control characters in the program's output: names, titles and paths come from files, and
// a terminal obeys control characters. For main(), before anything is printed; one thread.
#pragma once

#include <cstdio>

namespace luxodus::cli {

/// A text stream that forwards to another, with control characters as \xNN, except line ends and
/// tabs. `below` stays open and gets everything on a flush. Null if memory is exhausted.
FILE* printable_stream(FILE* below);

/// Makes standard output pass through printable_stream, and escapes all that is logged.
void guard_terminal();

}  // namespace luxodus::cli
