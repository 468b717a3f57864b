// Which groups a record of release 2000 has: Autodesk's "DXF Reference".
#include "actors/judge/report/dxf_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/output_text.hpp"

namespace luxodus {

namespace {

/// Height of attributes, which are invisible: names are drawn as texts [m].
constexpr double attribute_m = 0.125;

/// The text as one line of ASCII.
std::string plain(const std::string& text) {
  const std::string clean = clean_utf8(text);
  std::string out;
  for (size_t i = 0; i < clean.size();) {
    const auto lead = static_cast<unsigned char>(clean[i]);
    const size_t bytes = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    uint32_t code = bytes == 1 ? lead : lead & (0xffu >> (bytes + 1));
    for (size_t k = 1; k < bytes && i + k < clean.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(clean[i + k]) & 0x3fu);
    i += bytes;
    if (code >= 0x20 && code < 0x7f)
      out += static_cast<char>(code);
    else if (code < 0x20)
      out += ' ';
    else
      out += fmt::format("\\U+{:04X}", std::min(code, 0xffffu));
  }
  return out.substr(0, 255);  // longest string that all releases read
}

}  // namespace

void DxfDrawing::begin(glm::dvec2 low, glm::dvec2 high, std::span<const DxfLayer> layers,
                       const std::vector<std::string>& blocks) {
  for (const std::string& name : blocks) blocks_.emplace_back(name, handle());
  out_.dxfString(999, "Luxodus; 1 unit = 1 m");
  header(low, high);
  section("CLASSES");
  end_section();
  tables(low, high, layers);
  section("BLOCKS");
  for (const auto& [name, record] :
       {std::pair{"*Model_Space", model_space}, std::pair{"*Paper_Space", paper_space}}) {
    block_head(name, record, 0);
    end_block();
  }
}

void DxfDrawing::begin_entities() {
  end_section();
  section("ENTITIES");
  owner_ = model_space;
}

void DxfDrawing::end() {
  end_section();
  objects();
  out_.dxfString(0, "EOF");
  out_.close();
}

// ---- head ---------------------------------------------------------------------------------------

void DxfDrawing::section(const char* name) {
  out_.dxfString(0, "SECTION");
  out_.dxfString(2, name);
}

void DxfDrawing::header(glm::dvec2 low, glm::dvec2 high) {
  const auto text = [&](const char* variable, int code, const char* value) {
    out_.dxfString(9, variable);
    out_.dxfString(code, value);
  };
  const auto number = [&](const char* variable, int value) {
    out_.dxfString(9, variable);
    out_.dxfInt(70, value);
  };
  section("HEADER");
  text("$ACADVER", 1, "AC1015");
  text("$DWGCODEPAGE", 3, "ANSI_1252");
  text("$HANDSEED", 5, "7FFFFFFF");  // above all handles
  corner("$INSBASE", {0, 0});
  corner("$EXTMIN", low);
  corner("$EXTMAX", high);
  number("$INSUNITS", 6);     // metres
  number("$MEASUREMENT", 1);  // metric
  number("$LUNITS", 2);       // decimal
  end_section();
}

void DxfDrawing::tables(glm::dvec2 low, glm::dvec2 high, std::span<const DxfLayer> layers) {
  section("TABLES");
  table("VPORT", 1);
  viewport(low, high);
  table("LTYPE", 3);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) line_type(name);
  table("LAYER", layers.size() + 1);
  const auto layer = [&](const DxfLayer& one) {
    entry("LAYER", "AcDbLayerTableRecord", one.name);
    out_.dxfInt(70, 0);
    out_.dxfInt(62, one.colour);
    out_.dxfString(6, "Continuous");
  };
  layer({"0", 7});
  for (const DxfLayer& one : layers) layer(one);
  table("STYLE", 1);
  entry("STYLE", "AcDbTextStyleTableRecord", "Standard");
  out_.dxfInt(70, 0);
  out_.dxfReal(40, 0);
  out_.dxfReal(41, 1);
  out_.dxfReal(50, 0);
  out_.dxfInt(71, 0);
  out_.dxfReal(42, 0.25);
  out_.dxfString(3, "txt");
  out_.dxfString(4, "");
  table("VIEW", 0);
  table("UCS", 0);
  table("APPID", 1);
  entry("APPID", "AcDbRegAppTableRecord", "ACAD");
  out_.dxfInt(70, 0);
  table("DIMSTYLE", 1);
  marker("AcDbDimStyleTable");
  constexpr int handle_code_of_dimension_styles = 105;
  entry("DIMSTYLE", "AcDbDimStyleTableRecord", "Standard", handle_code_of_dimension_styles);
  out_.dxfInt(70, 0);
  block_records();
  out_.dxfString(0, "ENDTAB");
  end_section();
}

void DxfDrawing::table(const char* name, size_t entries) {
  if (table_ != 0) out_.dxfString(0, "ENDTAB");
  table_ = handle();
  out_.dxfString(0, "TABLE");
  out_.dxfString(2, name);
  out_.dxfHex(5, table_);
  out_.dxfHex(330, 0);
  marker("AcDbSymbolTable");
  out_.dxfInt(70, static_cast<int>(entries));
}

void DxfDrawing::entry(const char* kind, const char* of_kind, const std::string& name,
                       int handle_code) {
  out_.dxfString(0, kind);
  out_.dxfHex(handle_code, handle());
  out_.dxfHex(330, table_);
  marker("AcDbSymbolTableRecord");
  marker(of_kind);
  out_.dxfString(2, name);
}

void DxfDrawing::block_records() {
  table("BLOCK_RECORD", blocks_.size() + 2);
  const auto record = [&](const std::string& name, int its_handle) {
    out_.dxfString(0, "BLOCK_RECORD");
    out_.dxfHex(5, its_handle);
    out_.dxfHex(330, table_);
    marker("AcDbSymbolTableRecord");
    marker("AcDbBlockTableRecord");
    out_.dxfString(2, name);
    out_.dxfHex(340, 0);  // no layout
  };
  record("*Model_Space", model_space);
  record("*Paper_Space", paper_space);
  for (const auto& [name, its_handle] : blocks_) record(name, its_handle);
}

/// The view in which programs open the drawing: all of it.
void DxfDrawing::viewport(glm::dvec2 low, glm::dvec2 high) {
  const glm::dvec2 middle = (low + high) / 2.0, size = glm::max(high - low, glm::dvec2(1));
  const std::pair<int, glm::dvec2> points[] = {{10, {0, 0}}, {11, {1, 1}}, {12, middle},
                                               {13, {0, 0}}, {14, {1, 1}}, {15, {1, 1}}};
  entry("VPORT", "AcDbViewportTableRecord", "*ACTIVE");
  out_.dxfInt(70, 0);
  for (const auto& [code, p] : points) {
    out_.dxfReal(code, p.x);
    out_.dxfReal(code + 10, p.y);
  }
  for (const auto& [code, z] : {std::pair{16, 1.0}, std::pair{17, 0.0}}) {  // seen from above
    out_.dxfReal(code, 0);
    out_.dxfReal(code + 10, 0);
    out_.dxfReal(code + 20, z);
  }
  constexpr double margin = 1.1, aspect = 1.5;
  out_.dxfReal(40, margin * std::max(size.y, size.x / aspect));
  out_.dxfReal(41, aspect);
  out_.dxfReal(42, 50);  // focal length [mm], of views in perspective
}

void DxfDrawing::line_type(const char* name) {
  entry("LTYPE", "AcDbLinetypeTableRecord", name);
  out_.dxfInt(70, 0);
  out_.dxfString(3, "");
  out_.dxfInt(72, 65);
  out_.dxfInt(73, 0);
  out_.dxfReal(40, 0);
}

void DxfDrawing::objects() {
  section("OBJECTS");
  for (const auto& [dictionary, above] : {std::pair{root_objects, 0}, {groups, root_objects}}) {
    out_.dxfString(0, "DICTIONARY");
    out_.dxfHex(5, dictionary);
    out_.dxfHex(330, above);
    marker("AcDbDictionary");
    out_.dxfInt(281, 1);
    if (dictionary != root_objects) continue;
    out_.dxfString(3, "ACAD_GROUP");
    out_.dxfHex(350, groups);
  }
  end_section();
}

// ---- blocks -------------------------------------------------------------------------------------

void DxfDrawing::block_head(const std::string& name, int record, int flags) {
  owner_ = record;
  entity("BLOCK", "0", owner_);
  marker("AcDbBlockBegin");
  out_.dxfString(2, name);
  out_.dxfInt(70, flags);
  at({0, 0});
  out_.dxfString(3, name);
  out_.dxfString(1, "");
}

void DxfDrawing::begin_block(const std::string& name) {
  constexpr int has_attributes = 2;
  const auto found = std::find_if(blocks_.begin(), blocks_.end(),
                                  [&](const auto& block) { return block.first == name; });
  block_head(name, found->second, has_attributes);
}

void DxfDrawing::end_block() {
  entity("ENDBLK", "0", owner_);
  marker("AcDbBlockEnd");
}

void DxfDrawing::define(const char* tag) {
  entity("ATTDEF", "0", owner_);
  marker("AcDbText");
  at({0, 0});
  out_.dxfReal(40, attribute_m);
  out_.dxfString(1, "");
  marker("AcDbAttributeDefinition");
  out_.dxfString(3, tag);
  out_.dxfString(2, tag);
  out_.dxfInt(70, 1);  // invisible
}

// ---- entities -----------------------------------------------------------------------------------

int DxfDrawing::entity(const char* kind, const char* layer, int owner) {
  const int its_handle = handle();
  out_.dxfString(0, kind);
  out_.dxfHex(5, its_handle);
  out_.dxfHex(330, owner);
  marker("AcDbEntity");
  out_.dxfString(8, layer);
  return its_handle;
}

void DxfDrawing::at(glm::dvec2 place, double z) {
  out_.dxfReal(10, place.x);
  out_.dxfReal(20, place.y);
  out_.dxfReal(30, z);
}

void DxfDrawing::corner(const char* variable, glm::dvec2 place) {
  out_.dxfString(9, variable);
  at(place);
}

void DxfDrawing::line(const char* layer, glm::dvec2 a, glm::dvec2 b) {
  entity("LINE", layer, owner_);
  marker("AcDbLine");
  at(a);
  out_.dxfReal(11, b.x);
  out_.dxfReal(21, b.y);
  out_.dxfReal(31, 0);
}

void DxfDrawing::text(const char* layer, glm::dvec2 place, const std::string& words,
                      double height_m) {
  entity("TEXT", layer, owner_);
  marker("AcDbText");
  at(place);
  out_.dxfReal(40, height_m);
  out_.dxfString(1, plain(words));
  marker("AcDbText");  // twice: of its second part, which is all default
}

void DxfDrawing::polyline(const char* layer, const std::vector<glm::dvec2>& points, bool closed) {
  const bool repeats = closed && points.size() > 1 && points.front() == points.back();
  const size_t count = points.size() - (repeats ? 1 : 0);
  entity("LWPOLYLINE", layer, owner_);
  marker("AcDbPolyline");
  out_.dxfInt(90, static_cast<int>(count));
  out_.dxfInt(70, closed ? 1 : 0);
  for (size_t i = 0; i < count; ++i) {
    out_.dxfReal(10, points[i].x);
    out_.dxfReal(20, points[i].y);
  }
}

void DxfDrawing::insert(const char* layer, const std::string& block, glm::dvec3 place,
                        double turn_deg,
                        const std::vector<std::pair<const char*, std::string>>& attributes) {
  const int its_handle = entity("INSERT", layer, owner_);
  marker("AcDbBlockReference");
  out_.dxfInt(66, 1);  // attributes follow
  out_.dxfString(2, block);
  at(glm::dvec2(place), place.z);
  out_.dxfReal(50, turn_deg);
  for (const auto& [tag, value] : attributes) {
    entity("ATTRIB", layer, its_handle);
    marker("AcDbText");
    at(glm::dvec2(place), place.z);
    out_.dxfReal(40, attribute_m);
    out_.dxfString(1, plain(value));
    marker("AcDbAttribute");
    out_.dxfString(2, tag);
    out_.dxfInt(70, 1);  // invisible
  }
  entity("SEQEND", layer, its_handle);
}

}  // namespace luxodus
