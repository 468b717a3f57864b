// Tables as comma-separated values by RFC 4180, rows ended by a line feed. Numbers take the
// shortest form that reads back to the same bits; NaN and infinity are an empty cell, while an
// empty text is "" in quotes. Builds text in memory; a table is for one thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// A text as one CSV cell: quoted if it is empty, or holds a comma, a quote, a line break, or a
/// space at an end. An apostrophe precedes a text that a spreadsheet would compute as a formula.
std::string csv_cell(std::string_view text);

class CsvTable {
 public:
  /// Requires: at least one column.
  explicit CsvTable(const std::vector<std::string>& columns);

  CsvTable& cell(std::string_view text);
  CsvTable& cell(const char* text) { return cell(std::string_view(text)); }
  CsvTable& cell(double value);
  CsvTable& cell(int64_t value);
  CsvTable& cell(int value) { return cell(int64_t{value}); }
  CsvTable& cell(bool yes) { return cell(std::string_view(yes ? "yes" : "no")); }
  /// A cell without a value.
  CsvTable& empty_cell();
  template <class T>
  CsvTable& cell(const std::optional<T>& value) {
    return value ? cell(*value) : empty_cell();
  }
  /// A cell for each value.
  template <class... Values>
  CsvTable& cells(const Values&... values) {
    (cell(values), ...);
    return *this;
  }
  /// Requires: as many cells since the last row as there are columns, else std::logic_error.
  void end_row();
  /// A row with a cell for each value. Requires: as end_row.
  template <class... Values>
  void row(const Values&... values) {
    cells(values...).end_row();
  }

  /// Requires: no row begun and not ended, else std::logic_error.
  const std::string& text() const;

 private:
  void separate();

  size_t columns_;
  size_t cells_ = 0;  // in the row being written
  std::string text_;
};

/// Errors: as write_file_atomically.
Result<void> write_csv(const std::filesystem::path& path, const CsvTable& table);

/// Writes a file that not every run has. Without content, the earlier run's file is removed, which
/// would be taken for this run's.
/// Errors: as write_file_atomically; a file that cannot be removed.
Result<void> write_or_remove(const std::filesystem::path& path,
                             const std::optional<std::string>& bytes);
Result<void> write_or_remove(const std::filesystem::path& path,
                             const std::optional<CsvTable>& table);

}  // namespace luxodus
