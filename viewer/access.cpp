#include "viewer/access.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "base/text_parts.hpp"
#include "model/text_scan.hpp"

namespace cleancolor {
namespace {

bool is_every_address(std::string_view address) {
  return address == "0.0.0.0" || address == "::";
}

/// As it stands in a URL.
std::string bracketed(const std::string& address) {
  return address.find(':') == address.npos ? address : "[" + address + "]";
}

/// "[::1]" or "127.0.0.1".
bool is_number_address(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> ignored;
  if (name.starts_with('[') && name.ends_with(']'))
    return inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), ignored.data()) == 1;
  return inet_pton(AF_INET, name.c_str(), ignored.data()) == 1;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

/// One way to write each address: "::0:1" is "::1", "FE80::1" is "fe80::1". Names in lower case.
std::string written_plainly(std::string name) {
  std::ranges::transform(name, name.begin(), lower);
  if (name.starts_with('[') && name.ends_with(']')) name = name.substr(1, name.size() - 2);
  in6_addr address;
  std::array<char, INET6_ADDRSTRLEN> text;
  if (inet_pton(AF_INET6, name.c_str(), &address) == 1 && inet_ntop(AF_INET6, &address, text.data(), text.size()))
    return text.data();
  return name;
}

std::string machine_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bits;
  if (getrandom(bits.data(), bits.size(), 0) != ssize_t(bits.size()))
    throw SystemError("the system gives no random numbers for the token");
  std::string token;
  for (const unsigned char byte : bits) token += fmt::format("{:02x}", byte);
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference |= unsigned(a[i] ^ other);
  }
  return difference == 0;
}

std::string_view cookie_value(std::string_view header, std::string_view name) {
  for (const std::string_view piece : split(header, ';')) {
    const std::string_view pair = trimmed(piece);
    const std::size_t equals = pair.find('=');
    if (equals != pair.npos && pair.substr(0, equals) == name) return pair.substr(equals + 1);
  }
  return {};
}

std::string_view bearer_token(std::string_view header) {
  const std::size_t blank = header.find(' ');
  if (blank == header.npos || !is_keyword(header.substr(0, blank), "bearer")) return {};
  return trimmed(header.substr(blank));
}

std::string Access::cookie_name() const {
  return fmt::format("cleancolor_{}", port);
}

std::string Access::url() const {
  return fmt::format("http://{}:{}", bracketed(is_every_address(address) ? "127.0.0.1" : address), port);
}

bool Access::is_host(std::string_view host) const {
  // A browser leaves out the port where it is HTTP's own.
  const std::string ending = fmt::format(":{}", port);
  if (host.ends_with(ending))
    host.remove_suffix(ending.size());
  else if (port != 80)
    return false;
  std::string name(host);
  std::ranges::transform(name, name.begin(), lower);
  const bool brackets = name.starts_with('['), needs_brackets = address.find(':') != address.npos;
  if (brackets == needs_brackets && written_plainly(name) == written_plainly(address)) return true;
  if (name == "localhost") return true;
  return is_every_address(address) && !name.empty() && (is_number_address(name) || name == machine_name());
}

bool Access::is_origin(const Headers& headers) const {
  return headers.origin.empty() || headers.origin == "http://" + headers.host;
}

bool Access::knows_token(const Headers& headers) const {
  // Both are looked at, whichever is right.
  const bool by_cookie = same_secret(cookie_value(headers.cookie, cookie_name()), token);
  const bool by_header = same_secret(bearer_token(headers.authorization), token);
  return !token.empty() && (by_cookie || by_header);
}

}  // namespace cleancolor
