#include "actors/results/formats/file_names.hpp"

#include <algorithm>
#include <set>

namespace luxodus {

namespace {

bool is_plain(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '-' || c == '_' || byte >= 0x80;
}

std::string without_capitals(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

std::string file_name_of(std::string_view name) {
  std::string out(name);
  for (char& c : out)
    if (!is_plain(c)) c = '_';
  if (out.empty()) return "_";
  if (out[0] == '.' || out[0] == '-') out[0] = '_';
  return out;
}

std::vector<std::string> file_names_of(std::span<const std::string> names,
                                       std::span<const char* const> endings) {
  std::set<std::string> taken;
  std::vector<std::string> out;
  for (const std::string& name : names) {
    const std::string plain = file_name_of(name);
    std::string chosen = plain;
    const auto is_taken = [&](const char* ending) {
      return taken.contains(without_capitals(chosen + ending));
    };
    for (int n = 2; std::any_of(endings.begin(), endings.end(), is_taken); ++n)
      chosen = plain + "-" + std::to_string(n);
    for (const char* ending : endings) taken.insert(without_capitals(chosen + ending));
    out.push_back(std::move(chosen));
  }
  return out;
}

}  // namespace luxodus
