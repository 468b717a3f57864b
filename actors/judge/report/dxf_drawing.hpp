// Writes a DXF drawing of release 2000 (AC1015), the oldest that states its unit: one unit is one
// metre ($INSUNITS = 6). Entities lie in the model space, on layers and in blocks that the caller
// names. Non-ASCII letters are written as \U+XXXX. One thread per drawing.
#pragma once

#include <dxflib/dl_codes.h>
#include <dxflib/dl_writer_ascii.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace luxodus {

struct DxfLayer {
  const char* name;
  int colour;  // AutoCAD colour index
};

class DxfDrawing {
 public:
  explicit DxfDrawing(const std::filesystem::path& path)
      : out_(path.c_str(), DL_Codes::AC1015), owner_(model_space) {}
  bool open() const { return !out_.openFailed(); }

  /// The parts of a drawing, in this order: begin(), blocks between begin_block() and end_block(),
  /// begin_entities(), entities, end(). `blocks`: the names of all blocks to come.
  void begin(glm::dvec2 low, glm::dvec2 high, std::span<const DxfLayer> layers,
             const std::vector<std::string>& blocks);
  void begin_block(const std::string& name);
  void end_block();
  void begin_entities();
  void end();

  void line(const char* layer, glm::dvec2 a, glm::dvec2 b);
  void text(const char* layer, glm::dvec2 place, const std::string& words, double height_m);
  void polyline(const char* layer, const std::vector<glm::dvec2>& points, bool closed);
  /// Inserts a rotated block with attributes that only data export shows.
  void insert(const char* layer, const std::string& block, glm::dvec3 place, double turn_deg,
              const std::vector<std::pair<const char*, std::string>>& attributes);
  /// Defines an attribute within a block.
  void define(const char* tag);

 private:
  static constexpr int model_space = 0x1f, paper_space = 0x1b, root_objects = 0xc, groups = 0xd;

  void section(const char* name);
  void end_section() { out_.dxfString(0, "ENDSEC"); }
  void header(glm::dvec2 low, glm::dvec2 high);
  void tables(glm::dvec2 low, glm::dvec2 high, std::span<const DxfLayer> layers);
  /// Begins a table; its entries name it as their owner.
  void table(const char* name, size_t entries);
  void entry(const char* kind, const char* marker, const std::string& name, int handle_code = 5);
  void block_records();
  void viewport(glm::dvec2 low, glm::dvec2 high);
  void line_type(const char* name);
  void objects();

  /// Begins an entity; returns its handle.
  int entity(const char* kind, const char* layer, int owner);
  int handle() { return next_handle_++; }
  void marker(const char* name) { out_.dxfString(100, name); }
  void at(glm::dvec2 place, double z = 0);
  void corner(const char* variable, glm::dvec2 place);
  void block_head(const std::string& name, int record, int flags);

  DL_WriterA out_;
  int owner_, table_ = 0;
  int next_handle_ = 0x100;
  std::vector<std::pair<std::string, int>> blocks_;  // and the handles of their records
};

}  // namespace luxodus
