// Cells and words of a page from JSON. Pure functions; any thread.
#pragma once

#include "actors/judge/report/html.hpp"
#include "actors/judge/texts/remark_json.hpp"

namespace luxodus {

inline std::string number_cell(const Texts& texts, const Json& value, const std::string& unit = "",
                               int digits = 3) {
  return value.is_number() ? number_cell(texts, value.get<double>(), unit, digits)
                           : no_number_cell();
}

inline std::string said(const Texts& texts, const Json& remarks) {
  const auto read = read_remarks(remarks);
  return read ? texts.remarks(read.value()) : "";
}

inline std::string subject_text(const Texts& texts, const Json& subject) {
  const auto read = read_subject(subject);
  return read ? texts.subject(read.value()) : "";
}

}  // namespace luxodus
