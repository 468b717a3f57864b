// Under which names a server is asked for. A page of another site can have its name lead to this
// machine (DNS rebinding) and then speaks to this server as its own: Host and Origin agree, and
// both are that site's. So every request has to name the place where it arrived, or a name that was
// allowed. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// A name or an address with a port, as a Host header and an URL write them.
struct NamedPlace {
  std::string name;  // in small letters, without brackets
  std::optional<uint16_t> port;
};

/// "name", "name:port", "[address]" or "[address]:port"; none where it is something else.
std::optional<NamedPlace> named_place_of(std::string_view text);

/// "host:port", with brackets around an IPv6 address.
std::string named_place(const std::string& host, uint16_t port);

/// Where a request arrived.
struct ServedAt {
  std::string address;  // of this end of the connection, numeric
  bool loopback = true;
  uint16_t port = 0;
};

/// Whether a Host header names the place: its address, or localhost where that is this machine,
/// with its port; or one of `allowed`, "name" with any port or "name:port".
bool names_place(std::string_view host, const ServedAt& place,
                 const std::vector<std::string>& allowed);

/// Whether an Origin header is of the page that this Host header asks for.
bool is_own_page(std::string_view origin, std::string_view host);

/// "http://host:port", with brackets around an IPv6 address.
std::string http_address(const std::string& address, uint16_t port);

/// Whether a text can be allowed as a name.
Result<void> check_allowed_host(const std::string& text);

}  // namespace luxodus
