// Changes of a scene, given as dicts of Python, as the text that a scene file would have for them.
// Called with the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace luxodus::python {

/// A [[change]] for each, the n-th on line n, so that a problem of it names that line; "" for none.
/// Errors (Refused): a key or value that no TOML file can have.
std::string changes_text(const pybind11::list& changes);

}  // namespace luxodus::python
