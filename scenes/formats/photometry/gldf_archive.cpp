#include "scenes/formats/photometry/gldf_archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/gldf.hpp"

namespace luxodus {
namespace {

std::string said(zip_error_t& error) {
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

/// Whether a name stays within the folder that an archive is unpacked to.
bool stays_within(std::string_view name) {
  if (name.empty() || name.front() == '/' || name.find_first_of("\\:") != std::string_view::npos)
    return false;
  for (size_t from = 0; from <= name.size();) {
    const size_t to = std::min(name.find('/', from), name.size());
    if (name.substr(from, to - from) == "..") return false;
    from = to + 1;
  }
  return true;
}

}  // namespace

void GldfArchive::Closed::operator()(struct zip* archive) const {
  zip_discard(archive);
}

Result<GldfArchive> GldfArchive::open(std::string_view bytes, const std::string& file,
                                      const char* kind) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) return problem_in(file, "cannot be opened: " + said(error));
  GldfArchive archive;
  archive.file_ = file;
  archive.zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (!archive.zip_) {
    zip_source_free(source);
    return problem_in(file,
                      std::string("this is no ") + kind + ", which is a ZIP file: " + said(error));
  }
  const int64_t count = zip_get_num_entries(archive.zip_.get(), 0);
  if (count > limits::gldf_entries)
    return problem_in(file,
                      fmt::format("{} files in it; the most are {}", count, limits::gldf_entries));
  for (int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(archive.zip_.get(), static_cast<uint64_t>(i), ZIP_FL_ENC_GUESS);
    archive.names_.emplace_back(name == nullptr ? "" : name);
    if (name != nullptr && !stays_within(name))
      return problem_in(file, "the file \"" + excerpt(name) +
                                  "\" in it leads out of it: such an archive is not read");
  }
  return archive;
}

uint64_t GldfArchive::packed_bytes(size_t entry) const {
  zip_stat_t said;
  zip_stat_init(&said);
  if (zip_stat_index(zip_.get(), entry, 0, &said) != 0) return 0;
  return (said.valid & ZIP_STAT_COMP_SIZE) != 0 ? said.comp_size : 0;
}

Result<std::string> GldfArchive::read(size_t entry, uint64_t max_bytes) const {
  const std::string name = excerpt(names_[entry]);
  std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> opened(zip_fopen_index(zip_.get(), entry, 0),
                                                           &zip_fclose);
  if (!opened)
    return problem_in(file_, "\"" + name + "\" in it cannot be unpacked: " +
                                 excerpt(zip_strerror(zip_.get()), 100));
  std::string out;
  std::array<char, 65536> piece{};
  for (;;) {
    const zip_int64_t got = zip_fread(opened.get(), piece.data(), piece.size());
    if (got < 0)
      return problem_in(file_, "\"" + name + "\" in it is damaged: " +
                                   excerpt(zip_file_strerror(opened.get()), 100));
    if (got == 0) return out;
    out.append(piece.data(), static_cast<size_t>(got));
    if (out.size() > max_bytes)
      return problem_in(file_, fmt::format("\"{}\" in it is larger than {} bytes when unpacked",
                                           name, max_bytes));
  }
}

}  // namespace luxodus
