#include "tools/view/access.h"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace mocap {

bool IsOwnHost(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool is_port = colon != std::string_view::npos &&
                       host.find_first_not_of("0123456789", colon + 1) == std::string_view::npos;
  const std::string_view name = is_port ? host.substr(0, colon) : host;
  return name == "127.0.0.1" || name == "localhost" || name == "[::1]";
}

bool IsFromOwnPage(const RequestSource& source, bool is_page) {
  if (!source.origin.empty() && source.origin != "http://" + std::string(source.host)) return false;
  const bool is_ours = source.fetch_site.empty() || source.fetch_site == "same-origin" ||
                       source.fetch_site == "none";
  return is_ours || (is_page && source.fetch_mode == "navigate");
}

std::string MakeToken() {
  std::array<unsigned char, 16> bits;
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size())) {
    throw std::runtime_error("the system provides no random numbers for a token");
  }
  std::string token;
  for (const unsigned char byte : bits) {
    token += "0123456789abcdef"[byte >> 4];
    token += "0123456789abcdef"[byte & 15];
  }
  return token;
}

bool HoldsToken(std::string_view authorization, std::string_view token) {
  constexpr std::string_view kScheme = "Bearer ";
  if (token.empty() || !authorization.starts_with(kScheme)) return false;
  const std::string_view given = authorization.substr(kScheme.size());
  int differences = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(given.size(), token.size()); ++i) {
    differences |= given[i] ^ token[i];
  }
  return differences == 0;
}

}  // namespace mocap
