#include "runtime/http/served_names.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace luxodus {

namespace {

constexpr uint16_t http_port = 80;  // the default of a URL

std::string in_small_letters(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace

std::optional<NamedPlace> named_place_of(std::string_view text) {
  const bool bracketed = !text.empty() && text.front() == '[';
  const size_t end = bracketed ? text.find(']') : std::min(text.find(':'), text.size());
  if (end == std::string_view::npos || end == 0) return std::nullopt;
  NamedPlace out{in_small_letters(bracketed ? text.substr(1, end - 1) : text.substr(0, end)), {}};
  const std::string_view rest = text.substr(bracketed ? end + 1 : end);
  if (out.name.empty()) return std::nullopt;
  if (rest.empty()) return out;
  uint16_t port = 0;
  const char* const last = rest.data() + rest.size();
  const auto read = std::from_chars(rest.data() + 1, last, port);
  if (rest.front() != ':' || read.ec != std::errc() || read.ptr != last) return std::nullopt;
  out.port = port;
  return out;
}

bool names_place(std::string_view host, const ServedAt& place,
                 const std::vector<std::string>& allowed) {
  const auto asked = named_place_of(host);
  if (!asked) return false;
  const bool here = asked->name == in_small_letters(place.address) ||
                    (place.loopback && (asked->name == "localhost" || asked->name == "127.0.0.1" ||
                                        asked->name == "::1"));
  if (here && asked->port.value_or(http_port) == place.port) return true;
  return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& text) {
    const auto one = named_place_of(text);
    return one && one->name == asked->name &&
           (!one->port || *one->port == asked->port.value_or(http_port));
  });
}

bool is_own_page(std::string_view origin, std::string_view host) {
  const size_t scheme = origin.find("://");
  if (scheme == std::string_view::npos) return false;
  const std::string kind = in_small_letters(origin.substr(0, scheme));
  return (kind == "http" || kind == "https") &&
         in_small_letters(origin.substr(scheme + 3)) == in_small_letters(host);
}

std::string named_place(const std::string& host, uint16_t port) {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::string http_address(const std::string& address, uint16_t port) {
  return "http://" + named_place(address, port);
}

Result<void> check_allowed_host(const std::string& text) {
  if (named_place_of(text) && text.find_first_of("/*@ ") == std::string::npos) return {};
  return problem("\"" + text + "\" is no name of a host: write view.example.org or localhost:9000");
}

}  // namespace luxodus
