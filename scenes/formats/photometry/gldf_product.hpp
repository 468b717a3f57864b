// What a `product.xml` of GLDF says. Internal to the reading of GLDF; pugixml is included
// by gldf_product.cpp and l3d.cpp. Pure function of the text; any thread.
#pragma once

#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/photometry/gldf.hpp"

namespace luxodus {

/// The product without its files: `GldfLight::photometry` is the name under `ldc/` that the text
/// gives, `GldfModel::file` that under `geo/`; faults are set where there can be none.
/// Errors: no XML, a document type, another version than 1.0, more than the limits.
Result<GldfProduct> gldf_product_of(const std::string& xml, const std::string& file);

}  // namespace luxodus
