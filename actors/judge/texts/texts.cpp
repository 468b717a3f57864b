#include "actors/judge/texts/texts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "actors/judge/texts/text_files.hpp"
#include "runtime/core/output_text.hpp"
#include "runtime/toml/document.hpp"

namespace luxodus {

namespace {

constexpr size_t max_text_file_bytes = size_t{1} << 20;

using TextsByKey = std::map<std::string, std::string, std::less<>>;

TextsByKey read_texts(std::string_view language) {
  const std::string file = std::string(language) + ".toml";
  const auto document = toml::parse(text_file(language), file, max_text_file_bytes);
  if (!document) throw std::logic_error(document.problem().text());
  TextsByKey out;
  for (const toml::Entry& entry : document->top.entries()) {
    const std::string* text = entry.value.as_text();
    if (text == nullptr) throw std::logic_error(file + ": no text: " + entry.key);
    out.emplace(entry.key, *text);
  }
  return out;
}

/// A placeholder such as "{1:.2f}": the index of its argument and the format.
struct Place {
  size_t argument = 0;
  std::string format;  // "{}", "{:.2f}"
};

Place place_of(std::string_view inside) {
  const size_t colon = inside.find(':');
  return {static_cast<size_t>(std::stoul(std::string(inside.substr(0, colon)))),
          colon == std::string_view::npos ? "{}" : "{" + std::string(inside.substr(colon)) + "}"};
}

}  // namespace

const std::map<std::string, std::string, std::less<>>& texts_of(Language language) {
  static const auto all = [] {
    std::array<TextsByKey, language_words.size()> out;
    std::transform(language_words.begin(), language_words.end(), out.begin(), read_texts);
    return out;
  }();
  return all.at(static_cast<size_t>(language));
}

Language language_of(std::string_view word) {
  const auto at = std::find(language_words.begin(), language_words.end(), word);
  if (at == language_words.end())
    throw std::logic_error("there is no language " + std::string(word));
  return static_cast<Language>(at - language_words.begin());
}

const char* Texts::operator()(std::string_view key) const {
  const auto& texts = texts_of(language_);
  const auto at = texts.find(key);
  if (at == texts.end()) throw std::logic_error("there is no text " + std::string(key));
  return at->second.c_str();
}

std::string Texts::word(std::string_view list, std::string_view word) const {
  const auto& texts = texts_of(language_);
  const auto at = texts.find(std::string(list) + "." + std::string(word));
  return at == texts.end() ? std::string(word) : at->second;
}

std::string Texts::remark(const Remark& remark) const {
  const std::string_view pattern = (*this)("remark." + std::string(kind_of(remark.id).name));
  std::string out;
  for (size_t from = 0; from < pattern.size();) {
    const size_t open = std::min(pattern.find('{', from), pattern.size());
    out += pattern.substr(from, open - from);
    if (open == pattern.size()) break;
    const size_t close = pattern.find('}', open);
    const Place place = place_of(pattern.substr(open + 1, close - open - 1));
    const RemarkArgument& argument = remark.arguments.at(place.argument);
    if (const double* number = std::get_if<double>(&argument))
      out += localised(fmt::format(fmt::runtime(place.format), *number));
    else
      out += std::get<std::string>(argument);
    from = close + 1;
  }
  return out;
}

std::string Texts::remarks(const Remarks& remarks) const {
  std::string out;
  for (const Remark& one : remarks)
    out += (out.empty() ? "" : (*this)("remark.join")) + remark(one);
  return out;
}

std::string Texts::subject(const Subject& subject) const {
  const std::string quoted = say("name.quoted", subject.name);
  if (subject.kind == SubjectKind::emphasis)
    return quoted + " (" +
           word("emphasis", emphasis_words.at(static_cast<size_t>(subject.emphasis))) + ")";
  const std::string kind = word("subject", name_of(subject.kind));
  return subject.name.empty() ? kind : kind + " " + quoted;
}

std::string Texts::rule_title(std::string_view id) const {
  return (*this)("rule." + std::string(id));
}

std::string Texts::clause(const Rule& rule) const {
  return rule.carried_over() && !rule.clause.empty() ? say("clause.of_2013", rule.clause)
                                                     : rule.clause;
}

std::string Texts::localised(std::string text) const {
  if (language_ != Language::en)
    for (char& c : text)
      if (c == '.') c = ',';
  return text;
}

std::string Texts::number(double value, int digits) const {
  if (!std::isfinite(value)) return (*this)("word.none");
  return localised(readable_number(value, digits));
}

std::string Texts::fixed(double value, int decimals) const {
  // Avoids "-0.00".
  const double step = std::pow(10.0, -decimals);
  return localised(fmt::format("{:.{}f}", std::abs(value) < step / 2 ? 0.0 : value, decimals));
}

std::string Texts::place(double x, double y, double z) const {
  const char* between = language_ == Language::en ? ", " : "; ";
  return "(" + fixed(x) + between + fixed(y) + between + fixed(z) + ")";
}

std::string Texts::percent(double share) const {
  const double value = 100 * share;
  const double shown = std::abs(value) < 0.5 ? 0.0 : value;
  return std::string(shown < 0 ? "−" : "+") + fixed(std::abs(shown), 0) + "\u00a0%";
}

}  // namespace luxodus
