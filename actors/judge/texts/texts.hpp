// Texts of assessments, reports and designs by key and language, with numbers in the format of the
// language. Names from a scene are not translated. Constant data and pure functions; any thread.
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
/// Requires: one of the words.
Language language_of(std::string_view word);

/// All texts of a language by key, parsed once from the embedded file.
const std::map<std::string, std::string, std::less<>>& texts_of(Language language);

class Texts {
 public:
  explicit Texts(Language language) : language_(language) {}

  Language language() const { return language_; }
  const char* code() const { return language_words[static_cast<size_t>(language_)].data(); }

  /// Requires: a key of the table (a programmer's mistake throws).
  const char* operator()(std::string_view key) const;
  /// The text with its placeholders filled in. Requires: as many values as placeholders.
  template <class... Values>
  std::string say(std::string_view key, const Values&... values) const {
    return fmt::format(fmt::runtime((*this)(key)), values...);
  }
  /// A word of a list such as the verdicts ("verdict", "not assessed"). A word that is not in the
  /// list is a name, and is returned as it is.
  std::string word(std::string_view list, std::string_view word) const;

  /// The sentence of a remark.
  std::string remark(const Remark& remark) const;
  /// The sentences of several remarks, joined.
  std::string remarks(const Remarks& remarks) const;
  /// 'route "corridor"', '"lobby" (first aid)'.
  std::string subject(const Subject& subject) const;
  /// Title of a rule: "Illuminance on the centre line of an escape route".
  std::string rule_title(std::string_view id) const;
  /// "4.2.1", "4.2.1 of 2013".
  std::string clause(const Rule& rule) const;

  /// `digits` significant digits with the language's decimal sign: "0.0421", "12,5".
  std::string number(double value, int digits = 3) const;
  /// A number with this many decimals: a coordinate.
  std::string fixed(double value, int decimals = 2) const;
  /// "(1.00, 8.00, 0.02)"; with semicolons where the comma is the decimal sign.
  std::string place(double x, double y, double z) const;
  /// "+12 %", "−3 %"
  std::string percent(double share) const;

 private:
  std::string localised(std::string text) const;
  Language language_;
};

/// The English texts, which the console and JSON use.
inline Texts english() {
  return Texts(Language::en);
}

}  // namespace luxodus
