// An assessment for Python: assessment.json, by its keys. Called with the interpreter's lock, which
// is released while the assessment is made.
#pragma once

#include <pybind11/pybind11.h>

#include "actors/apps/python/scene.hpp"

namespace luxodus::python {

/// Adds Assessment to the module.
void add_assessment(pybind11::module_& module);
/// Adds assess() to Scene.
void add_assessing(pybind11::class_<OpenScene>& scene);

}  // namespace luxodus::python
