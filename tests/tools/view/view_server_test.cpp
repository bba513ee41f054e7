#include "tools/view/view_server.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <string>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "daemon/base/file_descriptor.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A server in a thread of its own, with one page, one answer, and a board.
class ViewServerTest : public ::testing::Test {
 protected:
  ViewServerTest() {
    server_.Put(0, {true, std::make_shared<const std::string>("{\"type\":\"studio\"}")});
    thread_ = std::thread([this] { server_.Run(); });
  }
  ~ViewServerTest() override {
    server_.Stop();
    thread_.join();
  }

  FileDescriptor Connect() const {
    FileDescriptor fd(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server_.port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    // Only a server that hangs takes so long.
    const timeval patience{60, 0};
    setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    return fd;
  }
  static void Say(const FileDescriptor& to, const std::string& text) {
    send(to.get(), text.data(), text.size(), MSG_NOSIGNAL);
  }
  /// What comes until `end` is in it, or the connection ends.
  static std::string Hear(const FileDescriptor& from, const std::string& end) {
    std::string heard;
    char bytes[4096];
    while (end.empty() || heard.find(end) == std::string::npos) {
      const ssize_t count = recv(from.get(), bytes, sizeof bytes, 0);
      if (count <= 0) break;
      heard.append(bytes, static_cast<std::size_t>(count));
    }
    return heard;
  }
  /// All of an answer, headers and body.
  std::string Ask(const std::string& first_line, const std::string& headers = kOwnHost) const {
    const FileDescriptor fd = Connect();
    Say(fd, first_line + " HTTP/1.1\r\n" + headers + "Connection: close\r\n\r\n");
    return Hear(fd, "");
  }

  static constexpr const char* kOwnHost = "Host: 127.0.0.1\r\n";
  ViewServer server_{{.port = 0,
                      .files = {{"/", {"text/html", "<!DOCTYPE html>page"}}},
                      .answer = [](const ViewRequest& request) -> ViewReply {
                        if (request.path != "/echo") return {404, "", ""};
                        return {200, "text/plain", request.method + ' ' + request.query.at("say")};
                      },
                      .is_live = true}};
  std::thread thread_;
};

TEST_F(ViewServerTest, ServesThePageWithAStrictPolicy) {
  const std::string answer = Ask("GET /");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(answer, HasSubstr("Content-Security-Policy: default-src 'none'"));
  EXPECT_THAT(answer, HasSubstr("<!DOCTYPE html>page"));
}

TEST_F(ViewServerTest, PassesRequestsOn) {
  EXPECT_THAT(Ask("GET /echo?say=a%20b"), HasSubstr("GET a b"));
  EXPECT_THAT(Ask("GET /nothing"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(Ask("GET /../../etc/passwd"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(Ask("DELETE /"), StartsWith("HTTP/1.1 405"));
}

TEST_F(ViewServerTest, HeadIsGetWithoutTheBody) {
  for (const char* path : {"/", "/echo?say=a", "/nothing"}) {
    const std::string whole = Ask(std::string("GET ") + path);
    const std::string head = Ask(std::string("HEAD ") + path);
    EXPECT_EQ(head, whole.substr(0, whole.find("\r\n\r\n") + 4)) << path;
  }
  EXPECT_THAT(Ask("HEAD /"), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("Content-Length: 19")));
}

TEST_F(ViewServerTest, AnAnswerThatFailsIsTold) {
  EXPECT_THAT(Ask("GET /echo"), StartsWith("HTTP/1.1 500"));
}

TEST_F(ViewServerTest, StrangersGetNothing) {
  EXPECT_THAT(Ask("GET /", "Host: evil.example\r\n"), StartsWith("HTTP/1.1 421"));
  const std::string foreign = std::string(kOwnHost) + "Origin: http://evil.example\r\n";
  EXPECT_THAT(Ask("GET /echo?say=secret", foreign), Not(HasSubstr("secret")));
  EXPECT_THAT(Ask("POST /echo?say=secret", foreign), StartsWith("HTTP/1.1 403"));
}

TEST_F(ViewServerTest, WhatIsNoRequestIsRefusedWithAReason) {
  EXPECT_THAT(Ask("\x16\x03\x01 /"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(Ask("GET /", "X: " + std::string(20000, 'x') + "\r\n"), StartsWith("HTTP/1.1 431"));
  EXPECT_THAT(Ask("POST /echo?say=x", std::string(kOwnHost) + "Content-Length: 99999\r\n"),
              StartsWith("HTTP/1.1 413"));
}

constexpr const char* kUpgrade =
    "GET /live HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

TEST_F(ViewServerTest, APageIsToldTheLatest) {
  const FileDescriptor page = Connect();
  Say(page, std::string(kUpgrade) + "\r\n");
  const std::string heard = Hear(page, "}");
  EXPECT_THAT(heard, StartsWith("HTTP/1.1 101"));
  EXPECT_THAT(heard, HasSubstr("{\"type\":\"studio\"}"));
}

TEST_F(ViewServerTest, APageOfAnotherOriginIsToldNothing) {
  const FileDescriptor page = Connect();
  Say(page, std::string(kUpgrade) + "Origin: http://evil.example\r\n\r\n");
  const std::string heard = Hear(page, "this request");
  EXPECT_THAT(heard, StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(heard, Not(HasSubstr("studio")));
}

TEST_F(ViewServerTest, ConnectionsThatSayNothingKeepNobodyOut) {
  std::vector<FileDescriptor> silent;
  for (int i = 0; i < 300; ++i) {
    silent.push_back(Connect());
    if (i % 2 == 0) Say(silent.back(), "GET / HT");
  }
  EXPECT_THAT(Ask("GET /"), StartsWith("HTTP/1.1 200"));
}

TEST_F(ViewServerTest, WhoSaidNothingForLongestMakesRoom) {
  const FileDescriptor asks = Connect();
  const std::string request = std::string("GET / HTTP/1.1\r\n") + kOwnHost + "\r\n";
  std::vector<FileDescriptor> silent;
  for (int i = 0; i < 300; ++i) {
    silent.push_back(Connect());
    if (i % 50 != 0) continue;
    // This one is accepted after all others.
    EXPECT_THAT(Ask("GET /"), StartsWith("HTTP/1.1 200"));
    Say(asks, request);
    ASSERT_THAT(Hear(asks, "page"), StartsWith("HTTP/1.1 200")) << i;
  }
}

TEST_F(ViewServerTest, DataBeforeAWebSocketIsAcceptedIsRefused) {
  const FileDescriptor page = Connect();
  Say(page, std::string(kUpgrade) + "\r\n" + std::string("\x85\x80\0\0\0\0", 6));
  EXPECT_THAT(Hear(page, ""), StartsWith("HTTP/1.1 400"));
}

TEST_F(ViewServerTest, AFrameThatIsNoneEndsThatPageAlone) {
  const FileDescriptor good = Connect(), bad = Connect();
  Say(good, std::string(kUpgrade) + "\r\n");
  Hear(good, "}");
  Say(bad, std::string(kUpgrade) + "\r\n");
  Hear(bad, "}");
  // A frame without a mask, which clients may not send.
  Say(bad, std::string("\x81\x05hello", 7));
  Hear(bad, "");
  // A ping, masked with nothing, and its pong.
  Say(good, std::string("\x89\x82\0\0\0\0ok", 8));
  EXPECT_THAT(Hear(good, "ok"), HasSubstr("ok"));
}

TEST(ViewServer, APortThatIsInUseIsRefusedWithARemedy) {
  ViewServer first({.port = 0, .files = {}, .answer = {}, .is_live = false});
  try {
    ViewServer second({.port = first.port(), .files = {}, .answer = {}, .is_live = false});
    FAIL() << "it took the port";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("choose another one with --port"));
  }
}

}  // namespace
}  // namespace mocap
