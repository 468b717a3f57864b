// Converts changes of a scene, given as Python dicts, to the text that a scene file would have.
// Called with the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace luxodus::python {

/// A [[change]] for each, the n-th on line n, so that a problem names that line; "" for none.
/// Errors (Refused): a key or value that a TOML file cannot have.
std::string changes_text(const pybind11::list& changes);

}  // namespace luxodus::python
