// HTTP responses of mocap view.
#pragma once

#include <boost/beast/http.hpp>
#include <string>
#include <utility>  // Boost 1.74 needs it and does not say so.

namespace mocap {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// Returns a response with the headers that protect the page; for HEAD, of GET without its body.
HttpResponse Respond(const HttpRequest& request, int status, const std::string& type,
                     std::string body);
/// Returns a response of one line of text.
HttpResponse Refuse(const HttpRequest& request, int status, const std::string& why);
/// Whether the received data is an invalid request, rather than none.
bool IsMalformed(boost::system::error_code error);
/// The status that answers an invalid request.
int StatusOf(boost::system::error_code malformed);

}  // namespace mocap
