// viewer/access.hpp
//
// Who may ask: the secret token, and from which names.
//
// The token keeps other users of the machine away. Sites that the same browser visits are kept away by the cookie
// (SameSite=Strict), by Host (no name of their own leads here) and by Origin (other ports of this machine count as the
// same site for cookies).
#pragma once

#include <string>
#include <string_view>

namespace cleancolor {

/// 32 hexadecimal digits, 128 bits, from the system.  Throws SystemError where it gives none.
std::string random_token();

/// Whether both are the same; how long that takes tells nothing of where they differ.
bool same_secret(std::string_view a, std::string_view b);

/// Of the headers of one request; empty where there is none.
struct Headers {
  std::string host, origin, cookie, authorization;
};

struct Access {
  std::string token;
  std::string address;  // that the server listens at: "127.0.0.1", "0.0.0.0", "::1"
  int port = 0;

  /// With the port in it, because browsers share cookies between all ports of a host.
  std::string cookie_name() const;

  /// "http://127.0.0.1:8737"
  std::string url() const;

  /// Host is the address, or localhost; where the server listens at all addresses: any number, or the machine's name.
  bool is_host(std::string_view host) const;

  /// No Origin, or this server.
  bool is_origin(const Headers& headers) const;

  /// Cookie, or Authorization: Bearer.
  bool knows_token(const Headers& headers) const;
};

/// The value of a cookie in a Cookie header, "" where there is none. Of several of one name the first.
std::string_view cookie_value(std::string_view header, std::string_view name);

/// The token of "Bearer TOKEN"; "" for anything else.
std::string_view bearer_token(std::string_view header);

}  // namespace cleancolor
