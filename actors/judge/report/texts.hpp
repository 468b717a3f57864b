// Every sentence of a report in every language that it can be written in, by key: one table, so
// that no language lacks one. Numbers for people in the custom of the language. What the scene says
// in free words (names) stays as it is. Constant data and pure
// functions; any thread.
#pragma once

#include <fmt/args.h>
#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace luxodus {

enum class Language { en, de, fr };
inline constexpr std::array<std::string_view, 3> language_words{"en", "de", "fr"};

struct ReportText {
  const char* key;
  std::array<const char*, 3> text;  // by Language; {0}, {1}, ... are filled in
};

/// Pieces of the table, one per source file.
std::span<const ReportText> page_texts();
std::span<const ReportText> section_texts();
std::span<const ReportText> word_texts();
std::span<const ReportText> rule_texts();
std::span<const ReportText> design_texts();
/// Sentences of the program itself, which have no key: the English one, as checks and states hold
/// it, is what they are found by.
std::span<const ReportText> remark_texts();

class Texts {
 public:
  explicit Texts(Language language) : language_(language) {}

  Language language() const { return language_; }
  const char* code() const { return language_words[static_cast<size_t>(language_)].data(); }

  /// Requires: a key of the table (a programmer's mistake throws).
  const char* operator()(std::string_view key) const;
  /// The text with its places filled in. Requires: as many values as it has places.
  template <class... Values>
  std::string say(std::string_view key, const Values&... values) const {
    return fmt::format(fmt::runtime((*this)(key)), values...);
  }
  /// A word of a list such as the verdicts ("verdict", "not assessed"); the word itself where the
  /// table has none: it is a name then.
  std::string word(std::string_view list, std::string_view word) const;
  /// A sentence of the program itself, with its names and numbers; none where the table does not
  /// have it.
  std::optional<std::string> remark(std::string_view english) const;

  /// `digits` significant digits with the language's decimal sign: "0.0421", "12,5".
  std::string number(double value, int digits = 3) const;
  /// So many digits behind the decimal sign: a coordinate.
  std::string fixed(double value, int decimals = 2) const;
  /// "(1.00, 8.00, 0.02)"; with semicolons where the comma is the decimal sign.
  std::string place(double x, double y, double z) const;
  /// "+12 %", "−3 %"
  std::string percent(double share) const;

 private:
  std::string localised(std::string text) const;
  Language language_;
};

/// The row of a key; null where there is none.
const ReportText* find_text(std::string_view key);

}  // namespace luxodus
