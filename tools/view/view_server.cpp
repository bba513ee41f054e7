#include "tools/view/view_server.h"

// clang-format off
#include <utility>  // Boost 1.74 needs it and does not say so.
// clang-format on

#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <list>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/printable_text.h"
#include "tools/view/access.h"
#include "tools/view/http_replies.h"
#include "tools/view/refusals.h"
#include "tools/view/request_target.h"

namespace mocap {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using ErrorCode = boost::system::error_code;
using Request = HttpRequest;
using Response = HttpResponse;
using Stream = websocket::stream<beast::tcp_stream>;
template <typename T>
using Task = asio::awaitable<T>;

/// Limit of connections; a browser holds about six. Beyond it, the one that has waited longest for
/// a request is closed, or else the new one.
constexpr std::size_t kMostConnections = 128;
constexpr std::size_t kMostPages = 64;
/// Silent clients are disconnected after this time.
constexpr std::chrono::seconds kPatience{10};
/// A page that vanished is detected by missing pongs, or because it takes nothing.
constexpr std::chrono::seconds kPagePatience{20};
constexpr std::uint32_t kMostHeaderBytes = 8192;
constexpr std::uint64_t kMostBodyBytes = 4096;
constexpr std::size_t kMostPageMessageBytes = 1024;
/// Kept small: data in the system's buffers becomes stale.
constexpr int kPageBufferBytes = 64 << 10;
constexpr std::size_t kAnswerThreads = 3;
constexpr int kWaitingConnections = 128;
constexpr std::chrono::milliseconds kTellPeriod{500};

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

tcp::acceptor OpenPort(asio::io_context& io, std::uint16_t port) {
  if (sd_listen_fds(0) >= 1) return tcp::acceptor(io, tcp::v4(), SD_LISTEN_FDS_START);
  tcp::acceptor acceptor(io, tcp::v4());
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  ErrorCode error;
  acceptor.bind({asio::ip::address_v4::loopback(), port}, error);
  if (!error) acceptor.listen(kWaitingConnections, error);
  if (error) {
    throw SetupError("127.0.0.1:" + std::to_string(port) + ": the port cannot be opened: " +
                     error.message() + "; choose another one with --port, or 0 for any");
  }
  return acceptor;
}

}  // namespace

class ViewServer::Impl {
 public:
  explicit Impl(Options options)
      : options_(std::move(options)), acceptor_(OpenPort(io_, options_.port)) {}

  void Run() {
    signals_.async_wait([this](ErrorCode, int) { io_.stop(); });
    asio::co_spawn(io_, Accept(), EndOnFailure);
    Every(kTellPeriod, [this] {
      const std::string line = refusals_.Line(SteadyNs());
      if (!line.empty()) std::fprintf(stderr, "mocap view: %s\n", Printable(line).c_str());
    });
    io_.run();
    pool_.stop();
  }

  void Stop() { io_.stop(); }

  void Every(std::chrono::milliseconds period, std::function<void()> call) {
    asio::co_spawn(io_, Repeat(period, std::move(call)), EndOnFailure);
  }

  void OnReadable(int descriptor, std::function<void()> call) {
    asio::co_spawn(io_, Read(dup(descriptor), std::move(call)), EndOnFailure);
  }

  void Aside(std::function<void()> work, std::function<void()> then) {
    asio::post(pool_, [this, work = std::move(work), then = std::move(then)]() mutable {
      work();
      asio::post(io_, std::move(then));
    });
  }

  void Put(std::size_t slot, LiveMessage message) {
    board_.Put(slot, std::move(message));
    for (asio::steady_timer* waiting : waiting_) waiting->cancel();
  }
  std::size_t live_pages() const { return board_.readers(); }
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  struct Connection {
    explicit Connection(tcp::socket socket) : stream(std::move(socket)) {}
    beast::tcp_stream stream;
    beast::flat_buffer buffer;  ///< Received part of a request.
    /// Since when it has waited for a request, by the steady clock; empty: it is being answered.
    std::optional<std::int64_t> waits_since_ns = SteadyNs();
  };
  using Place = std::list<std::shared_ptr<Connection>>::iterator;

  /// Without its callbacks the server would be useless: the exception leaves Run.
  static void EndOnFailure(const std::exception_ptr& failure) {
    if (failure) std::rethrow_exception(failure);
  }

  static Task<void> Repeat(std::chrono::milliseconds period, std::function<void()> call) {
    asio::steady_timer timer(co_await asio::this_coro::executor);
    for (;;) {
      timer.expires_after(period);
      co_await timer.async_wait(asio::use_awaitable);
      call();
    }
  }

  static Task<void> Read(int descriptor, std::function<void()> call) {
    asio::posix::stream_descriptor readable(co_await asio::this_coro::executor, descriptor);
    for (;;) {
      co_await readable.async_wait(asio::posix::descriptor_base::wait_read, asio::use_awaitable);
      call();
    }
  }

  Task<void> Accept() {
    for (;;) {
      ErrorCode error;
      tcp::socket socket =
          co_await acceptor_.async_accept(asio::redirect_error(asio::use_awaitable, error));
      if (error) {
        // No descriptors left: pending connections make room.
        refusals_.Add(error.message());
        std::ignore = MakeRoom();
        asio::steady_timer pause(io_, kTellPeriod);
        co_await pause.async_wait(asio::use_awaitable);
        continue;
      }
      if (connections_.size() >= kMostConnections && !MakeRoom()) continue;
      const auto place =
          connections_.insert(connections_.end(), std::make_shared<Connection>(std::move(socket)));
      asio::co_spawn(io_, Attend(place), asio::detached);
    }
  }

  /// Closes the connection that has waited longest for a request.
  /// @return  false: all are being answered.
  bool MakeRoom() {
    const auto waits_since = [](const std::shared_ptr<Connection>& connection) {
      return connection->waits_since_ns.value_or(std::numeric_limits<std::int64_t>::max());
    };
    const auto longest = std::ranges::min_element(connections_, {}, waits_since);
    const bool is_found = longest != connections_.end() && (*longest)->waits_since_ns;
    refusals_.Add(is_found ? "a connection that waited longest, as there were too many"
                           : "a connection beyond the limit");
    if (!is_found) return false;
    (*longest)->waits_since_ns.reset();
    ErrorCode ignored;
    (*longest)->stream.socket().close(ignored);
    return true;
  }

  Task<void> Attend(Place place) {
    const std::shared_ptr<Connection> connection = *place;
    std::optional<Request> upgrade;
    try {
      upgrade = co_await ServeRequests(*connection);
    } catch (const boost::system::system_error&) {
      // The client left before the answer.
    }
    connections_.erase(place);
    if (upgrade) co_await ServePage(std::move(connection->stream), std::move(*upgrade));
  }

  /// Ends a connection without a complete request. Browsers keep spare connections open; these are
  /// closed silently.
  Task<void> EndWithoutRequest(Connection& connection, ErrorCode error) {
    if (error == beast::error::timeout && connection.buffer.size() > 0) {
      refusals_.Add("an incomplete request");
    }
    if (!IsMalformed(error)) co_return;
    refusals_.Add("a request: " + error.message());
    Request unread;
    unread.keep_alive(false);
    const Response response = Refuse(unread, StatusOf(error), error.message());
    connection.stream.expires_after(kPatience);
    co_await http::async_write(connection.stream, response, asio::use_awaitable);
  }

  /// @return  a request to upgrade to a WebSocket.
  Task<std::optional<Request>> ServeRequests(Connection& connection) {
    for (;;) {
      http::request_parser<http::string_body> parser;
      parser.header_limit(kMostHeaderBytes);
      parser.body_limit(kMostBodyBytes);
      connection.stream.expires_after(kPatience);
      connection.waits_since_ns = SteadyNs();
      ErrorCode error;
      co_await http::async_read(connection.stream, connection.buffer, parser,
                                asio::redirect_error(asio::use_awaitable, error));
      connection.waits_since_ns.reset();
      if (error) {
        co_await EndWithoutRequest(connection, error);
        co_return std::nullopt;
      }
      Request request = parser.release();
      const bool is_page = options_.files.contains(std::string(View(request.target())));
      Response response;
      if (std::optional<Response> refusal = RefusalOf(request, is_page)) {
        refusals_.Add("a request that is not the page's own");
        response = std::move(*refusal);
      } else if (websocket::is_upgrade(request)) {
        // A browser sends nothing more before the answer.
        const bool is_sound = connection.buffer.size() == 0;
        if (is_sound && options_.is_live && request.target() == "/live" &&
            live_pages() < kMostPages) {
          co_return request;
        }
        if (!is_sound) refusals_.Add("a WebSocket: data before it was accepted");
        response = Refuse(request, is_sound ? 404 : 400,
                          is_sound ? "no WebSocket is served here, or too many are open"
                                   : "data may only follow after the WebSocket was accepted");
        response.keep_alive(is_sound);
      } else {
        response = co_await Answer(request);
      }
      connection.stream.expires_after(kPatience);
      co_await http::async_write(connection.stream, response, asio::use_awaitable);
      if (!response.keep_alive()) co_return std::nullopt;
    }
  }

  static std::optional<Response> RefusalOf(const Request& request, bool is_page) {
    const RequestSource source{View(request[http::field::host]), View(request[http::field::origin]),
                               View(request["Sec-Fetch-Site"]), View(request["Sec-Fetch-Mode"])};
    if (!IsOwnHost(source.host)) return Refuse(request, 421, "the address is 127.0.0.1");
    if (!IsFromOwnPage(source, is_page)) {
      return Refuse(request, 403, "only the page of mocap view may send this request");
    }
    return {};
  }

  Task<Response> Answer(const Request& request) {
    RequestTarget target = ParseRequestTarget(View(request.target()));
    ViewRequest asked;
    asked.path = std::move(target.path);
    asked.query = std::move(target.query);
    const bool is_get = request.method() == http::verb::get || request.method() == http::verb::head;
    if (!is_get && request.method() != http::verb::post) {
      co_return Refuse(request, 405, "expected GET, HEAD or POST");
    }
    const auto file = options_.files.find(asked.path);
    if (is_get && file != options_.files.end()) {
      co_return Respond(request, 200, file->second.type, file->second.body);
    }
    asked.method = is_get ? "GET" : "POST";
    asked.authorization = View(request[http::field::authorization]);
    asked.body = request.body();
    ViewReply reply =
        co_await asio::co_spawn(pool_, AnswerAside(std::move(asked)), asio::use_awaitable);
    if (reply.status == 404) co_return Refuse(request, 404, "there is nothing at this address");
    co_return Respond(request, reply.status, reply.type, std::move(reply.body));
  }

  Task<ViewReply> AnswerAside(ViewRequest asked) {
    try {
      co_return options_.answer(asked);
    } catch (const std::exception& error) {
      co_return ViewReply{500, "text/plain; charset=utf-8", Printable(error.what())};
    }
  }

  Task<void> ServePage(beast::tcp_stream stream, Request request) {
    ErrorCode ignored;
    stream.socket().set_option(asio::socket_base::send_buffer_size(kPageBufferBytes), ignored);
    const auto page = std::make_shared<Stream>(std::move(stream));
    beast::get_lowest_layer(*page).expires_never();
    page->set_option(websocket::stream_base::timeout{kPatience, kPagePatience, true});
    page->read_message_max(kMostPageMessageBytes);
    page->auto_fragment(false);
    try {
      co_await page->async_accept(request, asio::use_awaitable);
    } catch (const boost::system::system_error&) {
      co_return;
    }
    const auto wake = std::make_shared<asio::steady_timer>(io_);
    asio::co_spawn(io_, Hear(page, wake), asio::detached);
    waiting_.insert(wake.get());
    try {
      co_await Tell(page, *wake);
    } catch (const boost::system::system_error& error) {
      if (error.code() == beast::error::timeout) refusals_.Add("a page that stopped responding");
    }
    waiting_.erase(wake.get());
    beast::get_lowest_layer(*page).socket().close(ignored);
  }

  /// Receives pings and the close; ignores what a page sends.
  Task<void> Hear(std::shared_ptr<Stream> page, std::shared_ptr<asio::steady_timer> wake) {
    beast::flat_buffer said;
    ErrorCode error;
    while (!error) {
      co_await page->async_read(said, asio::redirect_error(asio::use_awaitable, error));
      said.clear();
    }
    const bool is_violation =
        error != websocket::error::closed &&
        error.category() == websocket::make_error_code(websocket::error::closed).category();
    if (is_violation) refusals_.Add("a WebSocket: " + error.message());
    ErrorCode ignored;
    beast::get_lowest_layer(*page).socket().close(ignored);
    wake->cancel();
  }

  /// Pongs alone do not prove that a page reads: each message has to be taken in time.
  Task<void> Tell(std::shared_ptr<Stream> page, asio::steady_timer& wake) {
    LiveBoard::Reader reader(board_, SteadyNs());
    asio::steady_timer patience(io_);
    while (beast::get_lowest_layer(*page).socket().is_open()) {
      if (const std::optional<LiveMessage> message = reader.Next()) {
        patience.expires_after(kPagePatience);
        patience.async_wait([this, page](ErrorCode stopped) {
          if (stopped) return;
          refusals_.Add("a page that did not read its messages");
          ErrorCode ignored;
          beast::get_lowest_layer(*page).socket().close(ignored);
        });
        page->text(message->is_text);
        co_await page->async_write(asio::buffer(*message->bytes), asio::use_awaitable);
        patience.cancel();
        continue;
      }
      ErrorCode woken;
      wake.expires_at(asio::steady_timer::time_point::max());
      co_await wake.async_wait(asio::redirect_error(asio::use_awaitable, woken));
    }
  }

  const Options options_;
  LiveBoard board_;
  std::set<asio::steady_timer*> waiting_;  ///< Of pages that may wait for updates.
  Refusals refusals_;
  // Members used by coroutines precede the loop; members that use the loop follow it.
  asio::io_context io_{1};
  // From now on, a client that reads the address may end the server before it runs.
  asio::signal_set signals_{io_, SIGINT, SIGTERM};
  std::list<std::shared_ptr<Connection>> connections_;
  tcp::acceptor acceptor_;
  asio::thread_pool pool_{kAnswerThreads};
};

ViewServer::ViewServer(Options options) : impl_(std::make_unique<Impl>(std::move(options))) {}
ViewServer::~ViewServer() = default;
std::uint16_t ViewServer::port() const { return impl_->port(); }
std::size_t ViewServer::live_pages() const { return impl_->live_pages(); }
void ViewServer::OnReadable(int descriptor, std::function<void()> call) {
  impl_->OnReadable(descriptor, std::move(call));
}
void ViewServer::Every(std::chrono::milliseconds period, std::function<void()> call) {
  impl_->Every(period, std::move(call));
}
void ViewServer::Aside(std::function<void()> work, std::function<void()> then) {
  impl_->Aside(std::move(work), std::move(then));
}
void ViewServer::Put(std::size_t slot, LiveMessage message) {
  impl_->Put(slot, std::move(message));
}
void ViewServer::Run() { impl_->Run(); }
void ViewServer::Stop() { impl_->Stop(); }

}  // namespace mocap
