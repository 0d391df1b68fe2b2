// Beast does the protocol; this file decides what is sent, and when.
#include "gateway/page_session.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <charconv>

#include "gateway/server_core_session.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::size_t kLinesMissAt = 8, kSessionLinesMax = 4'000;
constexpr std::int64_t kSilent_s = 30, kFarewell_s = 2, kExtrasEvery_ms = 100;
constexpr std::size_t kTypeWithin = 64;  // bytes of a large message

const std::string kTooLarge =
    "a message is larger than " + std::to_string(viewer_protocol::kMessageBytesMax) +
    " bytes, or of a file to add " + std::to_string(viewer_protocol::kAdditionBytesMax) + "";

/// The page was closed or reloaded: browsers do not always say so before the connection ends.
bool has_left(const beast::error_code& error) {
    return error == websocket::error::closed || error == asio::error::operation_aborted ||
           error == asio::error::connection_reset || error == asio::error::broken_pipe ||
           error == asio::ssl::error::stream_truncated || error == asio::error::eof;
}

/// A request that carries a file.
bool adds(const PageRequest& request) {
    const auto* control = std::get_if<ControlArguments>(&request.what);
    return control != nullptr && !control->words.empty() && control->words.front() == "add";
}

/// The page's number in its last connection, as `was=N` of the request says; 0: none.
std::uint64_t number_in(beast::string_view target) {
    constexpr std::string_view kName = "was=";
    const std::string_view text(target.data(), target.size());
    std::uint64_t number = 0;
    const std::size_t at = text.find(kName);
    if (at == std::string_view::npos) return 0;
    const auto [end, error] =
        std::from_chars(text.data() + at + kName.size(), text.data() + text.size(), number);
    return error == std::errc() ? number : 0;
}

}  // namespace

PageSession::PageSession(PageStream&& stream, ServerCore& core, std::uint64_t number, std::string peer,
                         PageUser user)
    : socket_(std::move(stream)),
      core_(core),
      number_(number),
      peer_(std::move(peer)),
      user_(std::move(user)),
      timer_(socket_.get_executor()),
      rate_(static_cast<double>(viewer_protocol::kMessagesASecondMax)) {}

void PageSession::start(const Request& request) {
    socket_.next_layer().tcp().expires_never();
    websocket::stream_base::timeout timeout =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.idle_timeout = std::chrono::seconds(kSilent_s);
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.set(beast::http::field::sec_websocket_protocol, viewer_protocol::kSubprotocol);
        response.set(beast::http::field::server, "roboss");
    }));
    socket_.read_message_max(user_.role == PageRole::kWatch ? viewer_protocol::kMessageBytesMax
                                                            : viewer_protocol::kAdditionBytesMax);
    socket_.write_buffer_bytes(1 << 16);
    socket_.auto_fragment(false);
    before_ = number_in(request.target());
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
        if (error) return self->end("the handshake failed: " + error.message());
        self->open_ = true;
        if (self->core_.scene()) self->greet();
        self->core_.entered(*self);
        self->core_.watch_changed();
        self->show_state();
        self->read();
    });
}

void PageSession::close() {
    beast::error_code ignored;
    socket_.next_layer().tcp().socket().close(ignored);
}

std::string PageSession::title() const {
    return "page " + std::to_string(number_) + " of " +
           name_of(OpenPage{number_, peer_, user_.role, user_.name});
}

void PageSession::leave() {
    leaving_ = true;
    write_next();
}

void PageSession::end(const std::string& why, const std::string& code) {
    if (std::exchange(ended_, true)) return;
    const bool says_why =
        std::exchange(open_, false) && !code.empty() && code != "broken" && code != "timeout";
    if (!why.empty())
        core_.notice("viewer: " + title() + ": " + why + (code.empty() ? "" : " [" + code + "]"));
    timer_.cancel();
    says_why ? close_because(code + ": " + why) : close();
    core_.dismiss(number_, {why, code});
}

/// Beast allows a close beside a read and a write. A client that does not answer it is cut off.
void PageSession::close_because(const std::string& why) {
    constexpr std::size_t kReasonMax = 123;  // bytes, of the protocol
    std::string reason = why.substr(0, kReasonMax);
    while (!reason.empty() && (static_cast<unsigned char>(why[reason.size()]) & 0xC0) == 0x80)
        reason.pop_back();
    timer_.expires_after(std::chrono::seconds(kFarewell_s));
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error) self->close();
    });
    socket_.async_close({websocket::close_code::policy_error, reason},
                        [self = shared_from_this()](beast::error_code) {
                            self->timer_.cancel();
                            self->close();
                        });
}

void PageSession::read() {
    buffer_.clear();
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
        if (self->ended_) return;
        if (has_left(error)) return self->end();
        if (error == websocket::error::message_too_big) return self->end(kTooLarge, "too-large");
        if (error == beast::error::timeout) return self->end("it timed out", "timeout");
        if (error) return self->end("the connection broke: " + error.message(), "broken");
        if (!self->socket_.got_text()) return self->end("it sent a binary message", "binary-message");
        if (!self->rate_.take(steady_ms()))
            return self->end("too many messages: more than " +
                                 std::to_string(viewer_protocol::kMessagesASecondMax) +
                                 " messages per second",
                             "flood");
        self->take(beast::buffers_to_string(self->buffer_.data()));
        if (!self->ended_) self->read();
    });
}

void PageSession::take(const std::string& text) {
    const bool large = text.size() > viewer_protocol::kMessageBytesMax;
    if (large && text.substr(0, kTypeWithin).find(R"("type":"control")") == std::string::npos)
        return end(kTooLarge, "too-large");
    Result<PageRequest> request = parse_page_request(text);
    if (!request) return end(request.error().message, request.error().code);
    if (large && !adds(request.value())) return end(kTooLarge, "too-large");
    if (std::holds_alternative<PageWatch>(request.value().what)) {
        watch_ = std::get<PageWatch>(request.value().what);
        core_.watch_changed();
    } else if (std::holds_alternative<PageWhole>(request.value().what)) {
        shelf_.whole = true;
        shelf_.extras = 0;
        show_state();
    } else if (const auto* desk = std::get_if<PageDesk>(&request.value().what)) {
        core_.take(*this, *desk, request.value().id);
    } else {
        core_.call(*this, std::move(request).value());
    }
}

bool PageSession::greet() {
    if (!open_ || std::exchange(greeted_, true)) return false;
    send(core_.hello(before_), false);
    if (!core_.timeline().empty()) send(core_.timeline(), false);
    return true;
}

void PageSession::send(std::string text, bool may_miss) {
    if (!open_ || (may_miss && lines_.size() >= kLinesMissAt)) return;
    if (lines_.size() >= kSessionLinesMax) return end("it does not read its replies", "slow");
    lines_.push_back(std::move(text));
    write_next();
}

void PageSession::show_preview(std::vector<std::uint8_t> state) {
    preview_ = std::move(state);
    write_next();
}

void PageSession::show_picture(const PictureWish& wish, std::vector<std::uint8_t> message) {
    for (auto& [waiting, old] : pictures_)
        if (waiting.key() == wish.key()) return old = std::move(message), void();
    pictures_.emplace_back(wish, std::move(message));
    write_next();
}

void PageSession::begin_scene() {
    shelf_ = {};
    preview_.clear();
    pictures_.clear();
    state_wanted_ = false;
}

void PageSession::show_state() {
    state_wanted_ = true;
    write_next();
}

/// At its rate, within a tenth; if it is too early, a timer is set.
bool PageSession::state_due() {
    if (!core_.book().known() || !(watch_.rate > 0)) return false;
    const auto interval_ms = static_cast<std::int64_t>(900 / watch_.rate);
    const std::int64_t left_ms = state_ms_ + interval_ms - steady_ms();
    if (left_ms <= 0) return true;
    if (std::exchange(timing_, true)) return false;
    timer_.expires_after(std::chrono::milliseconds(left_ms));
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        self->timing_ = false;
        if (!error) self->write_next();
    });
    return false;
}

/// Surfaces and bonds have changed, and it is not too early to say so; they go out before the next State.
bool PageSession::extras_due() {
    const std::uint64_t serial = core_.book().extras_serial();
    if (!state_wanted_ || shelf_.extras == serial || steady_ms() - extras_ms_ < kExtrasEvery_ms) return false;
    shelf_.extras = serial;
    extras_ms_ = steady_ms();
    return true;
}

void PageSession::write_next() {
    if (!open_ || writing_) return;
    const auto done = [self = shared_from_this()](beast::error_code error, std::size_t bytes) {
        self->writing_ = false;
        self->sent_bytes_ += bytes;
        self->core_.count_sent(bytes);
        if (error) return self->end(has_left(error) ? "" : "the connection broke: " + error.message());
        self->write_next();
    };
    if (lines_.empty() && extras_due()) lines_.push_back(core_.extras_line());
    if (!lines_.empty()) {
        line_under_way_ = std::move(lines_.front());
        lines_.pop_front();
        writing_ = true;
        socket_.text(true);
        return socket_.async_write(asio::buffer(line_under_way_), done);
    }
    if (leaving_) {
        writing_ = true;
        return socket_.async_close(websocket::close_code::going_away,
                                   [self = shared_from_this()](beast::error_code) { self->end(); });
    }
    if (!preview_.empty()) {
        state_under_way_ = std::exchange(preview_, {});
    } else if (!pictures_.empty() && (state_was_last_ || !state_wanted_ || !state_due())) {
        state_was_last_ = false;
        state_under_way_ = std::move(pictures_.front().second);
        pictures_.pop_front();
    } else {
        if (!state_wanted_ || !state_due()) return;
        state_was_last_ = true;
        state_wanted_ = false;
        state_ms_ = steady_ms();
        state_under_way_ = core_.book().message(shelf_);
    }
    writing_ = true;
    socket_.binary(true);
    socket_.async_write(asio::buffer(state_under_way_), done);
}

}  // namespace roboss
