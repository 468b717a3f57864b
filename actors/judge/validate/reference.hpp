// The reference solutions of tests/reference, compiled into the program, so that every installation
// has them. An unknown name, column or key is a programmer's mistake and ends the program. Any
// thread.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace luxodus::light {

/// One row of a table by the names of its columns.
class Row {
 public:
  explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  const std::string& text(const std::string& column) const;
  double number(const std::string& column) const;
  /// Numbers between semicolons.
  std::vector<double> numbers(const std::string& column) const;

 private:
  std::map<std::string, std::string> cells_;
};

/// All rows of a file of tests/reference.
std::vector<Row> reference_table(const std::string& file);
/// Rows whose column has that text. Requires: there is one.
std::vector<Row> rows_where(const std::string& file, const std::string& column,
                            const std::string& text);
/// The value of a row of misc_exact.csv.
double exact(const std::string& id, const std::string& parameters);
/// The number after `key` in a text like "r1=0.5;r2=1".
double parameter(const std::string& text, const std::string& key);

}  // namespace luxodus::light
