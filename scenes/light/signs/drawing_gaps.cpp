#include "scenes/light/signs/drawing_gaps.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "runtime/core/printable.hpp"
#include "runtime/core/text.hpp"

namespace luxodus {

namespace {

constexpr std::string_view white_space = " \t\r\n";
/// Elements whose `href` names what is drawn. That of a link or a script is not.
constexpr std::array<std::string_view, 8> drawn_by_name{
    "image", "use", "linearGradient", "radialGradient", "pattern", "textPath", "tref", "mesh"};
/// Pictures that librsvg reads within a drawing.
constexpr std::array<std::string_view, 5> known_pictures{"image/png", "image/jpeg", "image/jpg",
                                                         "image/gif", "image/svg+xml"};

template <size_t count>
bool is_one_of(std::string_view word, const std::array<std::string_view, count>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The name without the prefix of its namespace.
std::string_view local(std::string_view name) {
  return name.substr(name.rfind(':') == std::string_view::npos ? 0 : name.rfind(':') + 1);
}

class GapFinder {
 public:
  explicit GapFinder(std::string_view svg) : svg_(svg) {}

  std::vector<std::string> find() {
    for (size_t at = svg_.find('<'); at != std::string_view::npos; at = svg_.find('<', at))
      at = take_markup(at);
    if (more_ > 0) gaps_.push_back("it names " + std::to_string(more_) + " more that are left out");
    return std::move(gaps_);
  }

 private:
  /// The place behind what begins at `at`, or the end of the drawing.
  size_t after(std::string_view end, size_t at) const {
    const size_t found = svg_.find(end, at);
    return found == std::string_view::npos ? svg_.size() : found + end.size();
  }

  size_t take_markup(size_t at) {
    const std::string_view rest = svg_.substr(at);
    if (rest.starts_with("<!--")) return after("-->", at);
    if (rest.starts_with("<![CDATA[")) return after("]]>", at);
    if (rest.starts_with("<?")) return take_instruction(at);
    if (rest.starts_with("<!") || rest.starts_with("</")) return at + 2;
    return take_element(at + 1);
  }

  size_t take_instruction(size_t at) {
    const size_t end = after("?>", at);
    if (svg_.substr(at).starts_with("<?xml-stylesheet"))
      tell("its style sheet is left out: a drawing loads no other file; write its styles into it");
    return end;
  }

  size_t take_element(size_t at) {
    const size_t end = std::min(svg_.find_first_of(" \t\r\n/>", at), svg_.size());
    const std::string_view name = local(svg_.substr(at, end - at));
    if (name == "text")
      tell(
          "its text is drawn in a font of this machine, or not at all if there is none: convert "
          "it to paths");
    at = take_attributes(name, end);
    if (name != "style") return at;
    const size_t close = std::min(svg_.find("</", at), svg_.size());
    take_styles(svg_.substr(at, close - at));
    return close;
  }

  /// Takes the attributes of an element, and gives the place behind its tag.
  size_t take_attributes(std::string_view element, size_t at) {
    while (at < svg_.size() && svg_[at] != '>') {
      const size_t equals = svg_.find_first_of("=>", at);
      if (equals == std::string_view::npos || svg_[equals] == '>')
        return std::min(equals, svg_.size());
      const size_t quote = svg_.find_first_not_of(white_space, equals + 1);
      if (quote == std::string_view::npos) return svg_.size();
      if (svg_[quote] != '"' && svg_[quote] != '\'') {
        at = quote;
        continue;
      }
      const size_t close = std::min(svg_.find(svg_[quote], quote + 1), svg_.size());
      const std::string_view key = local(trimmed(svg_.substr(at, equals - at)));
      const std::string_view value = trimmed(svg_.substr(quote + 1, close - quote - 1));
      if (key == "href" && is_one_of(element, drawn_by_name)) take_reference(element, value);
      take_styles(value);
      at = std::min(close + 1, svg_.size());
    }
    return at;
  }

  void take_reference(std::string_view element, std::string_view value) {
    if (value.empty() || value.starts_with('#')) return;
    if (!value.starts_with("data:")) return tell_other_file("its " + std::string(element), value);
    const std::string_view type = value.substr(5, value.find_first_of(";,") - 5);
    if (element == "image" && !is_one_of(type, known_pictures))
      tell("its image of the format \"" + excerpt(type) +
           "\" may be left out: embed it as PNG, or draw it");
  }

  /// url(...) and @import in attributes and style sheets.
  void take_styles(std::string_view styles) {
    if (styles.find("@import") != std::string_view::npos)
      tell("its style sheet is left out: a drawing loads no other file; write its styles into it");
    for (size_t at = styles.find("url("); at != std::string_view::npos;
         at = styles.find("url(", at + 1)) {
      const size_t close = std::min(styles.find(')', at), styles.size());
      std::string_view target = trimmed(styles.substr(at + 4, close - at - 4));
      const size_t first = target.find_first_not_of("\"'");
      target = first == std::string_view::npos ? "" : target.substr(first);
      target = target.substr(0, target.find_first_of("\"'"));
      if (!target.empty() && !target.starts_with('#') && !target.starts_with("data:"))
        tell_other_file("its url", target);
    }
  }

  void tell_other_file(const std::string& what, std::string_view target) {
    tell(what + " \"" + excerpt(target) +
         "\" is left out: a drawing loads no other file; embed it, or draw it");
  }

  void tell(const std::string& gap) {
    if (!told_.insert(gap).second) return;
    if (gaps_.size() < limits::max_drawing_gaps)
      gaps_.push_back(gap);
    else
      ++more_;
  }

  std::string_view svg_;
  std::vector<std::string> gaps_;
  std::set<std::string> told_;
  size_t more_ = 0;
};

}  // namespace

std::vector<std::string> drawing_gaps(std::string_view svg) {
  return GapFinder(svg).find();
}

}  // namespace luxodus
