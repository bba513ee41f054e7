#include "tools/view/http_replies.h"

namespace mocap {
namespace {

namespace http = boost::beast::http;

/// Only content from this address may run in the page, or be reached by it.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

HttpResponse Respond(const HttpRequest& request, int status, const std::string& type,
                     std::string body) {
  HttpResponse response(static_cast<http::status>(status), request.version());
  response.set("Content-Security-Policy", kContentPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
  if (!type.empty()) response.set(http::field::content_type, type);
  response.keep_alive(request.keep_alive());
  const std::size_t size = body.size();
  const bool is_head = request.method() == http::verb::head;
  if (!is_head) response.body() = std::move(body);
  response.prepare_payload();
  if (is_head && size > 0) response.content_length(size);
  return response;
}

HttpResponse Refuse(const HttpRequest& request, int status, const std::string& why) {
  return Respond(request, status, "text/plain; charset=utf-8", why + "\n");
}

bool IsMalformed(boost::system::error_code error) {
  return error.category() == http::make_error_code(http::error::end_of_stream).category() &&
         error != http::error::end_of_stream;
}

int StatusOf(boost::system::error_code malformed) {
  if (malformed == http::error::header_limit) return 431;
  return malformed == http::error::body_limit ? 413 : 400;
}

}  // namespace mocap
