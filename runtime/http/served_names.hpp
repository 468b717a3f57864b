// Accepted names of a server, against DNS rebinding: a page of another site can make its name
// resolve to this machine, and then speaks to this server as its own; Host and Origin agree, and
// both are that site's. So every request must name the address at which it arrived, or an allowed
// name. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// A name or an address with a port, as in a Host header or a URL.
struct NamedPlace {
  std::string name;  // lower case, without brackets
  std::optional<uint16_t> port;
};

/// Parses "name", "name:port", "[address]" or "[address]:port"; nothing for other texts.
std::optional<NamedPlace> named_place_of(std::string_view text);

/// "host:port", with brackets around an IPv6 address.
std::string named_place(const std::string& host, uint16_t port);

/// Where a request arrived.
struct ServedAt {
  std::string address;  // this end of the connection, numeric
  bool loopback = true;
  uint16_t port = 0;
};

/// Whether a Host header names the place: its address, or localhost if that is this machine, with
/// its port; or one of `allowed`, where "name" allows any port and "name:port" only one.
bool names_place(std::string_view host, const ServedAt& place,
                 const std::vector<std::string>& allowed);

/// Whether an Origin header belongs to the page that this Host header asks for.
bool is_own_page(std::string_view origin, std::string_view host);

/// "http://host:port", with brackets around an IPv6 address.
std::string http_address(const std::string& address, uint16_t port);

/// Whether a text can be allowed as a name.
Result<void> check_allowed_host(const std::string& text);

}  // namespace luxodus
