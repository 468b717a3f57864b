// Parses `product.xml` of GLDF. Internal to the reading of GLDF; only gldf_product.cpp and l3d.cpp
// include pugixml. Pure function of the text; any thread.
#pragma once

#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/gldf.hpp"

namespace luxodus {

/// The product without its files: `GldfLight::photometry` is the name under `ldc/` that the text
/// gives, `GldfModel::file` that under `geo/`; faults are set where no file can exist.
/// Errors: no XML, a document type, another version than 1.0, more than the limits.
Result<GldfProduct> gldf_product_of(const std::string& xml, const std::string& file);

}  // namespace luxodus
