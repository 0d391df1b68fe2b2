// PageStream: the connection to a browser, plain or in TLS, as one type, so that sessions are written once.
// It is a stream as Beast wants one.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "core/result.h"
#include "gateway/gateway.h"

namespace roboss {

class PageStream {
  public:
    using Plain = boost::beast::tcp_stream;
    using Tls = boost::asio::ssl::stream<Plain>;
    using executor_type = Plain::executor_type;

    explicit PageStream(boost::asio::ip::tcp::socket&& socket)
        : way_(std::in_place_type<Plain>, std::move(socket)) {}

    /// The TCP stream below TLS; its timeouts hold for both.
    Plain& tcp() {
        Tls* tls = std::get_if<Tls>(&way_);
        return tls != nullptr ? tls->next_layer() : std::get<Plain>(way_);
    }
    executor_type get_executor() { return tcp().get_executor(); }
    bool encrypted() const { return std::holds_alternative<Tls>(way_); }
    void close() { tcp().close(); }

    /// Becomes encrypted. `begun`: what has been read of the handshake; it lives until `then(error)`.
    template <class Then>
    void shake_hands(boost::asio::ssl::context& context, boost::beast::flat_buffer& begun, Then then) {
        Plain plain = std::move(std::get<Plain>(way_));
        Tls& tls = way_.emplace<Tls>(std::move(plain), context);
        tls.async_handshake(Tls::server, begun.data(),
                            [&begun, then = std::move(then)](boost::beast::error_code error, std::size_t) {
                                begun.clear();
                                then(error);
                            });
    }

    /// Says that nothing more will be sent. In TLS, `session` lives until the other end has said so, too.
    void finish(std::shared_ptr<void> session);

    template <class Buffers, class Handler>
    void async_read_some(const Buffers& buffers, Handler&& handler) {
        std::visit([&](auto& way) { way.async_read_some(buffers, std::forward<Handler>(handler)); }, way_);
    }
    template <class Buffers, class Handler>
    void async_write_some(const Buffers& buffers, Handler&& handler) {
        std::visit([&](auto& way) { way.async_write_some(buffers, std::forward<Handler>(handler)); }, way_);
    }

    // --- called by Beast's WebSocket
    friend void beast_close_socket(PageStream& stream) { stream.close(); }
    template <class Handler>
    friend void async_teardown(boost::beast::role_type role, PageStream& stream, Handler&& handler) {
        using boost::beast::websocket::async_teardown;
        std::visit([&](auto& way) { async_teardown(role, way, std::forward<Handler>(handler)); },
                   stream.way_);
    }

  private:
    std::variant<Plain, Tls> way_;
};

/// TLS 1.2 and 1.3 with this certificate. An Error [bad-certificate]: the texts are no certificate and key,
/// or do not belong together.
Result<std::shared_ptr<boost::asio::ssl::context>> tls_context(const KeyPair& pair);

/// SHA-256 of the certificate, as browsers show it: "AB:CD:...".
std::string fingerprint_of(boost::asio::ssl::context& context);

}  // namespace roboss
