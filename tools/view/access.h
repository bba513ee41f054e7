// Who may look and who may act: what keeps other sites' pages and other users out.
#pragma once

#include <string>
#include <string_view>

namespace mocap {

/// What a request says of where it comes from; empty where it says nothing.
struct RequestSource {
  std::string_view host;        ///< Host.
  std::string_view origin;      ///< Origin: browsers send it with whatever could do something.
  std::string_view fetch_site;  ///< Sec-Fetch-Site, of browsers.
  std::string_view fetch_mode;  ///< Sec-Fetch-Mode, of browsers.
};

/// Whether a Host names this machine itself, with or without a port. Any other name may be one that
/// another site has let point here (DNS rebinding).
bool IsOwnHost(std::string_view host);

/// Whether a request comes from the page itself, from no page at all, or from somebody who follows
/// a link to the page.
/// @param is_page  the page is asked for, and no data.
bool IsFromOwnPage(const RequestSource& source, bool is_page);

/// 128 random bits as hexadecimal digits. @throws std::runtime_error  when the system has none.
std::string MakeToken();

/// Whether an Authorization is "Bearer" and the token. How long it takes does not tell how much of
/// it was right.
bool HoldsToken(std::string_view authorization, std::string_view token);

}  // namespace mocap
