#include "scenes/formats/dxf/dxf_names.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "runtime/core/printable.hpp"
#include "runtime/core/text.hpp"

namespace luxodus {
namespace {

/// The page as iconv names it: "ANSI_1252" is CP1252, "dos850" CP850. "" where it is not known.
std::string iconv_page(std::string_view told) {
  std::string name;
  for (const char c : told)
    if (c != '-' && c != '_' && c != ' ')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "ansi1200" || name == "utf8") return "UTF-8";
  if (name == "ansi1361" || name == "johab") return "JOHAB";
  if (name == "big5" || name == "gb2312") return name == "big5" ? "CP950" : "CP936";
  if (name == "ksc5601") return "CP949";
  if (name == "ascii") return "CP1252";
  if (name == "macroman") return "MACINTOSH";
  for (const std::string_view head : {"ansi", "dos", "cp", "iso8859"}) {
    if (!name.starts_with(head)) continue;
    const std::string number = name.substr(head.size());
    if (number.empty() || number.size() > 4 ||
        number.find_first_not_of("0123456789") != std::string::npos)
      continue;
    return (head == "iso8859" ? "ISO-8859-" : "CP") + number;
  }
  return "";
}

/// The bytes of a page as UTF-8; nothing where they are not of this page, or it is not known here.
std::optional<std::string> converted(const std::string& page, std::string_view bytes) {
  const iconv_t converter = ::iconv_open("UTF-8", page.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string in(bytes), out(4 * bytes.size() + 4, '\0');
  char* from = in.data();
  char* to = out.data();
  size_t left = in.size(), room = out.size();
  const bool done = ::iconv(converter, &from, &left, &to, &room) != static_cast<size_t>(-1) &&
                    ::iconv(converter, nullptr, nullptr, &to, &room) != static_cast<size_t>(-1);
  ::iconv_close(converter);
  if (!done) return std::nullopt;
  out.resize(out.size() - room);
  return out;
}

bool is_utf8(std::string_view text) {
  for (size_t length = 0; !text.empty(); text.remove_prefix(length)) {
    length = utf8_length(text);
    if (length == 0) return false;
  }
  return true;
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::optional<uint32_t> hex(std::string_view digits) {
  uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 4 || error != std::errc() || end != digits.data() + 4) return std::nullopt;
  return value;
}

std::string utf8_of(uint32_t code) {
  std::string out;
  append_utf8(out, code);
  return out;
}

/// The letter of an escape at the start of `text`, and the bytes that it takes; 0 where there is
/// none. Autodesk's "DXF Reference" and "Drawing code pages".
std::pair<std::string, size_t> escaped_letter(std::string_view text) {
  if (text.starts_with("\\U+")) {
    const auto high = hex(text.substr(3, 4));
    if (!high) return {"", 0};
    if (*high < 0xd800 || *high > 0xdfff) return {utf8_of(*high), 7};
    const auto low = text.substr(7).starts_with("\\U+") ? hex(text.substr(10, 4)) : std::nullopt;
    if (*high > 0xdbff || !low || *low < 0xdc00 || *low > 0xdfff) return {"", 0};
    return {utf8_of(0x10000 + ((*high - 0xd800) << 10) + (*low - 0xdc00)), 14};
  }
  if (text.starts_with("\\M+") && text.size() >= 8 && text[3] >= '1' && text[3] <= '5') {
    constexpr const char* pages[] = {"CP932", "CP950", "CP949", "JOHAB", "CP936"};
    const auto code = hex(text.substr(4, 4));
    if (!code) return {"", 0};
    const std::string bytes = {static_cast<char>(*code >> 8), static_cast<char>(*code & 0xff)};
    if (const auto letter = converted(pages[text[3] - '1'], bytes)) return {*letter, 8};
  }
  return {"", 0};
}

}  // namespace

DxfNames::DxfNames(std::string_view version, std::string_view code_page)
    : page_(iconv_page(code_page)), page_told_(excerpt(code_page)) {
  // From release 2007 (AC1021) on, drawings are in UTF-8, whatever code page they name.
  if (version.starts_with("AC") && version.size() == 6 && version >= "AC1021") page_ = "UTF-8";
}

std::string DxfNames::decoded(std::string_view raw) {
  if (is_ascii(raw)) return std::string(raw);
  std::string page = page_;
  if (page.empty()) {  // a guess, which is told where the header names a page
    page = is_utf8(raw) ? "UTF-8" : "CP1252";
    if (!page_told_.empty() && page_told_ != "undefined") wrong_.insert(std::string(raw));
  }
  if (page == "UTF-8" && is_utf8(raw)) return std::string(raw);
  if (page != "UTF-8")
    if (const auto text = converted(page, raw)) return *text;
  wrong_.insert(std::string(raw));
  std::string out;
  for (const char c : raw) append_utf8(out, static_cast<unsigned char>(c));
  return out;
}

const std::string& DxfNames::utf8(std::string_view raw) {
  if (const auto it = known_.find(raw); it != known_.end()) return it->second;
  std::string out;
  const std::string text = decoded(raw);
  for (size_t at = 0; at < text.size();) {
    const auto [letter, length] = escaped_letter(std::string_view(text).substr(at));
    out += length > 0 ? letter : text.substr(at, 1);
    at += std::max<size_t>(length, 1);
  }
  return known_.emplace(raw, std::move(out)).first->second;
}

std::vector<std::string> DxfNames::notes() const {
  if (wrong_.empty()) return {};
  return {
      fmt::format("{} name{} not in the code page of the drawing ({}) and may show wrong "
                  "letters: save the drawing as DXF of release 2007 or later",
                  wrong_.size(), wrong_.size() == 1 ? " is" : "s are",
                  page_ == "UTF-8"     ? "UTF-8"
                  : page_told_.empty() ? "none is stated"
                                       : page_told_)};
}

}  // namespace luxodus
