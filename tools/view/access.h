// Access control: keeps other sites' pages and other users out.
#pragma once

#include <string>
#include <string_view>

namespace mocap {

/// Headers of a request that show its origin; empty if absent.
struct RequestSource {
  std::string_view host;        ///< Host.
  std::string_view origin;      ///< Origin: browsers send it with requests that may have effects.
  std::string_view fetch_site;  ///< Sec-Fetch-Site, of browsers.
  std::string_view fetch_mode;  ///< Sec-Fetch-Mode, of browsers.
};

/// Whether a Host header names this machine itself, with or without a port. Another site can point
/// any other name here (DNS rebinding).
bool IsOwnHost(std::string_view host);

/// Whether a request comes from the page itself, from no page, or from a link to the page.
/// @param is_page  the request is for the page, not for data.
bool IsFromOwnPage(const RequestSource& source, bool is_page);

/// Returns 128 random bits in hexadecimal. @throws std::runtime_error  when the system has none.
std::string MakeToken();

/// Whether an Authorization header is "Bearer" and the token. Takes constant time, so timing does
/// not reveal how much was right.
bool HoldsToken(std::string_view authorization, std::string_view token);

}  // namespace mocap
