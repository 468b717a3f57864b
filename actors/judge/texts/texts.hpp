// Every text of assessments, reports and designs in every language that they are written in, by
// key. Numbers are written in the custom of the language. Names that a scene gives stay as they
// are. Constant data and pure functions; any thread.
#pragma once

#include <fmt/format.h>

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "scenes/emergency/check.hpp"

namespace luxodus {

enum class Language { en, de, fr };
inline constexpr std::array<std::string_view, 3> language_words{"en", "de", "fr"};

/// All texts of a language by key. Read once, from what the program holds.
const std::map<std::string, std::string, std::less<>>& texts_of(Language language);

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
  /// list has none: it is a name then.
  std::string word(std::string_view list, std::string_view word) const;

  /// The sentence of a remark.
  std::string remark(const Remark& remark) const;
  /// The sentences of several, joined.
  std::string remarks(const Remarks& remarks) const;
  /// 'route "corridor"', '"lobby" (first aid)'.
  std::string subject(const Subject& subject) const;
  /// What a rule asks: "Illuminance on the centre line of an escape route".
  std::string rule_title(std::string_view id) const;
  /// "4.2.1", "4.2.1 of 2013".
  std::string clause(const Rule& rule) const;

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

/// The English texts, of which the console and JSON have their sentences.
inline Texts english() {
  return Texts(Language::en);
}

}  // namespace luxodus
