// See client_session.h.
#include "foxglove/client_session.h"

#include <array>
#include <boost/asio/post.hpp>

#include "foxglove/server_session.h"

namespace roboss::foxglove {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr auto kPatience = std::chrono::seconds(20);  // for a request
constexpr auto kSilence = std::chrono::seconds(30);   // without even an answer to a ping
constexpr std::uint32_t kHeaderBytesMost = 16u << 10;
constexpr std::size_t kFrameBytesMost = 4u << 20;  // one may subscribe to 100,000 channels

std::string text_of(beast::string_view text) {
    return {text.data(), text.size()};
}

std::string name_of(const asio::ip::tcp::socket& socket) {
    beast::error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    return error ? "someone" : endpoint.address().to_string() + ":" + std::to_string(endpoint.port());
}

/// The first of the client's subprotocols that is spoken here; empty: there is none.
std::string chosen_subprotocol(beast::string_view offered) {
    for (const beast::string_view name : http::token_list(offered))
        for (const char* known : kSubprotocols)
            if (name == known) return known;
    return {};
}

/// The client has gone, not always with a word.
bool has_left(const beast::error_code& error) {
    return error == websocket::error::closed || error == asio::error::operation_aborted ||
           error == asio::error::connection_reset || error == asio::error::broken_pipe ||
           error == asio::error::eof || error == beast::error::timeout;
}

}  // namespace

ClientSession::ClientSession(asio::ip::tcp::socket&& socket, Server& server)
    : socket_(std::move(socket)), server_(server), peer_(name_of(tcp().socket())) {}

ClientSession::~ClientSession() {
    if (client_ != 0) server_.hub().leave(client_);
    server_.ended(this);
}

void ClientSession::start() {
    parser_.emplace();
    parser_->header_limit(kHeaderBytesMost);
    parser_->body_limit(0);
    tcp().expires_after(kPatience);
    http::async_read(tcp(), buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) return self->close();
                         self->request_ = self->parser_->release();
                         self->serve();
                     });
}

void ClientSession::serve() {
    if (!websocket::is_upgrade(request_))
        return refuse(http::status::upgrade_required,
                      "this is a server for Foxglove and Lichtblick: open " + server_.url() + " there");
    if (const std::string why = server_.refusal(text_of(request_[http::field::origin])); !why.empty())
        return refuse(http::status::forbidden, why);
    const std::string subprotocol = chosen_subprotocol(request_[http::field::sec_websocket_protocol]);
    if (subprotocol.empty())
        return refuse(http::status::bad_request, std::string("the WebSocket must offer the subprotocol ") +
                                                     kSubprotocols[0] + " or " + kSubprotocols[1] +
                                                     " [no-subprotocol]");
    if (!server_.has_room())
        return refuse(http::status::service_unavailable, "too many clients are connected [too-many-clients]");
    upgrade(subprotocol);
}

void ClientSession::refuse(http::status status, const std::string& why) {
    if (status != http::status::upgrade_required)
        server_.hub().notice("Foxglove server: " + peer_ + " is refused: " + why);
    auto response = std::make_shared<http::response<http::string_body>>(status, request_.version());
    response->set(http::field::content_type, "text/plain; charset=utf-8");
    response->body() = why + "\n";
    response->keep_alive(false);
    response->prepare_payload();
    tcp().expires_after(kPatience);
    http::async_write(tcp(), *response,
                      [self = shared_from_this(), response](beast::error_code, std::size_t) {
                          beast::error_code ignored;
                          self->tcp().socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
                      });
}

void ClientSession::upgrade(const std::string& subprotocol) {
    tcp().expires_never();
    websocket::stream_base::timeout timeout =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.idle_timeout = kSilence;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, subprotocol);
        response.set(http::field::server, "roboss");
    }));
    socket_.read_message_max(kFrameBytesMost);
    socket_.auto_fragment(false);
    socket_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
        if (error || self->has_ended_ || !self->server_.has_room()) return self->close();
        const std::weak_ptr<ClientSession> weak = self;
        self->client_ =
            self->server_.hub().enter(self->peer_, [weak, executor = self->socket_.get_executor()] {
                asio::post(executor, [weak] {
                    if (const auto session = weak.lock()) session->write();
                });
            });
        self->read();
    });
}

void ClientSession::read() {
    buffer_.clear();
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
        if (self->has_ended_) return;
        if (has_left(error)) return self->end();
        if (error == websocket::error::message_too_big) return self->end("its message is too large");
        if (error) return self->end("the connection broke: " + error.message());
        const auto bytes = self->buffer_.cdata();
        const std::string_view frame(static_cast<const char*>(bytes.data()), bytes.size());
        self->socket_.got_text() ? self->server_.hub().take_text(self->client_, frame)
                                 : self->server_.hub().take_binary(self->client_, frame);
        if (self->server_.hub().is_lost(self->client_)) return self->end("it does not read our answers");
        self->read();
    });
}

void ClientSession::write() {
    if (has_ended_ || client_ == 0) return;
    if (server_.hub().is_lost(client_)) return end("it does not read what it must have");
    frame_ = server_.hub().next(client_);
    if (!frame_) return;
    socket_.text(frame_->is_text);
    const asio::const_buffer body = frame_->body ? asio::buffer(*frame_->body) : asio::const_buffer();
    socket_.async_write(std::array{asio::const_buffer(asio::buffer(frame_->head)), body},
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                            if (error) return self->end();
                            self->write();
                        });
}

/// `why` is for the log; empty: it left by itself.
void ClientSession::end(const std::string& why) {
    if (std::exchange(has_ended_, true)) return;
    if (!why.empty()) server_.hub().notice("Foxglove server: " + peer_ + " is disconnected: " + why);
    if (client_ != 0) server_.hub().leave(std::exchange(client_, 0));
    close();
}

void ClientSession::close() {
    beast::error_code ignored;
    tcp().socket().close(ignored);
}

void ClientSession::say_farewell() {
    if (client_ == 0 || std::exchange(has_ended_, true)) return close();
    server_.hub().leave(std::exchange(client_, 0));
    socket_.async_close({websocket::close_code::going_away, "the run is over"},
                        [self = shared_from_this()](beast::error_code) { self->close(); });
}

}  // namespace roboss::foxglove
