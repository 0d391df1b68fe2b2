// Reads in the thread of the io_context; writes in the thread that sends, as far as the socket takes it.
#include "net/connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <fcntl.h>
#include <linux/sockios.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <cerrno>
#include <cstring>

#include "bus/bus.h"

namespace roboss {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

constexpr std::size_t kReadAtOnce = 128 * 1024, kWriteAtOnce = 256 * 1024;

/// Where bytes of any connection arrive; one thread reads them all.
std::span<std::uint8_t> arrivals() {
    static thread_local std::vector<std::uint8_t> bytes(kReadAtOnce);
    return bytes;
}

void set_option(int socket, int option, int value, int level = IPPROTO_TCP) {
    ::setsockopt(socket, level, option, &value, sizeof value);
}

std::string name_of(const Tcp::socket& socket) {
    boost::system::error_code error;
    const Tcp::endpoint end = socket.remote_endpoint(error);
    return error ? "?" : end.address().to_string() + ":" + std::to_string(end.port());
}

}  // namespace

struct Connection::Socket {
    asio::io_context& context;
    Tcp::socket stream;
};

std::shared_ptr<Connection> Connection::open(asio::io_context& context, int socket,
                                             std::unique_ptr<TlsSession> session, Events events) {
    const std::shared_ptr<Connection> connection(
        new Connection(context, socket, std::move(session), std::move(events)));
    asio::post(context, [connection] {
        connection->receive({});  // without a session, the other end can be judged now
        connection->read();
    });
    return connection;
}

Connection::Connection(asio::io_context& context, int socket, std::unique_ptr<TlsSession> session,
                       Events events)
    : socket_(std::make_unique<Socket>(Socket{context, Tcp::socket(context, Tcp::v4(), socket)})),
      events_(std::move(events)),
      where_(name_of(socket_->stream)),
      opened_ms_(monotonic_ms()),
      heard_ms_(opened_ms_),
      sent_ms_(opened_ms_),
      session_(std::move(session)) {
    ::fcntl(socket, F_SETFD, FD_CLOEXEC);
    set_option(socket, TCP_NODELAY, 1);
    // Unsent bytes wait here, where short messages overtake them, and not in the kernel.
    set_option(socket, TCP_NOTSENT_LOWAT, static_cast<int>(kWriteAtOnce));
}

Connection::~Connection() = default;

// --- receiving

void Connection::read() {
    if (reading_ || ended_ || paused_) return;
    reading_ = true;
    socket_->stream.async_wait(Tcp::socket::wait_read, [self = shared_from_this()](const auto& error) {
        self->reading_ = false;
        if (error) return self->end(error.message());
        const std::span<std::uint8_t> into = arrivals();
        const ssize_t bytes =
            ::recv(self->socket_->stream.native_handle(), into.data(), into.size(), MSG_DONTWAIT);
        if (bytes == 0) return self->end("the other end has closed the connection");
        if (bytes < 0 && errno != EAGAIN && errno != EINTR) return self->end(std::strerror(errno));
        if (bytes > 0) {
            self->heard_ms_ = monotonic_ms();
            self->receive(into.first(static_cast<std::size_t>(bytes)));
        }
        self->read();
    });
}

void Connection::receive(std::span<const std::uint8_t> data) {
    std::string failure;
    bool established = true;
    {
        const std::lock_guard lock(mutex_);
        if (session_) {
            if (!session_->receive(data, reader_.buffer())) failure = session_->failure();
            established = session_->established();
            if (std::string stuck = pump_locked(); failure.empty()) failure = std::move(stuck);
        } else {
            reader_.buffer().insert(reader_.buffer().end(), data.begin(), data.end());
        }
    }
    if (established && !announced_) announced_ = true, events_.ready(*this);
    for (Frame frame; !ended_ && closing_ms_ == 0 && reader_.next(frame);)
        if (!take(frame)) return end("a message is longer than " + std::to_string(kMessageMost) + " bytes");
    if (!reader_.broken().empty() && closing_ms_ == 0) return end(reader_.broken());
    if (!failure.empty()) end(failure);
}

bool Connection::take(const Frame& frame) {
    switch (frame.kind) {
        case FrameKind::kWhole:
            events_.message(*this, {frame.content.begin(), frame.content.end()});
            return true;
        case FrameKind::kPiece:
        case FrameKind::kLast:
            if (!accepted || joined_.size() + frame.content.size() > kMessageMost) return false;
            joined_.insert(joined_.end(), frame.content.begin(), frame.content.end());
            if (frame.kind == FrameKind::kLast) events_.message(*this, std::exchange(joined_, {}));
            return true;
        default:
            events_.frame(*this, frame);
            return true;
    }
}

void Connection::pause() {
    paused_ = true;
}

void Connection::resume() {
    if (!paused_) return;
    heard_ms_ = monotonic_ms();  // it could not be heard while nothing was read
    paused_ = false;
    asio::post(socket_->context, [self = shared_from_this()] { self->read(); });
}

// --- sending

bool Connection::queue(std::deque<Outgoing>& line, Outgoing message) {
    std::string failure;
    {
        const std::lock_guard lock(mutex_);
        if (ended_ || closing_ms_ != 0 || waiting_bytes_ > kWaitingMost) return false;
        waiting_bytes_ += message.bytes.size();
        line.push_back(std::move(message));
        if (!waits_) failure = pump_locked();
    }
    if (!failure.empty())
        asio::post(socket_->context,
                   [self = shared_from_this(), failure] { self->end_after_reading(failure); });
    return failure.empty();
}

bool Connection::send_message(std::vector<std::uint8_t> bytes, bool urgent) {
    const bool overtakes = urgent && bytes.size() <= kFrameMost;
    return queue(overtakes ? urgent_ : waiting_, {std::move(bytes), 0, FrameKind::kWhole});
}

bool Connection::send_frame(FrameKind kind, const std::vector<std::uint8_t>& content, bool urgent) {
    return queue(urgent ? urgent_ : waiting_, {content, 0, kind});
}

void Connection::close_after_sending() {
    const std::lock_guard lock(mutex_);
    closing_ms_ = monotonic_ms();
    if (!waits_ && !ended_) pump_locked();
}

void Connection::wait_until_writable() {
    asio::post(socket_->context, [self = shared_from_this()] {
        if (self->ended_) return;
        self->socket_->stream.async_wait(Tcp::socket::wait_write, [self](const auto& error) {
            std::string failure = error ? error.message() : "";
            if (!error) {
                const std::lock_guard lock(self->mutex_);
                self->waits_ = false;
                failure = self->pump_locked();
            }
            if (!failure.empty()) self->end_after_reading(failure);
        });
    });
}

/// Sends what the socket takes at once. The answer: why the connection has failed; empty: it has not.
std::string Connection::pump_locked() {
    std::string failure;
    if (ended_) return failure;
    const int socket = socket_->stream.native_handle();
    for (std::size_t sent = 0; sent < kWriteAtOnce;) {
        if (wire_at_ == wire_.size() && !fill_locked(failure)) return failure;
        const ssize_t bytes =
            ::send(socket, wire_.data() + wire_at_, wire_.size() - wire_at_, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (bytes < 0 && errno == EINTR) continue;
        if (bytes < 0 && errno != EAGAIN && errno != EWOULDBLOCK) return std::strerror(errno);
        if (bytes < 0) break;
        wire_at_ += static_cast<std::size_t>(bytes);
        sent += static_cast<std::size_t>(bytes);
        sent_ms_ = monotonic_ms();
    }
    waits_ = true;
    wait_until_writable();
    return failure;
}

/// Makes the next bytes for the socket. False: there are none, or TLS has failed.
bool Connection::fill_locked(std::string& failure) {
    wire_.clear();
    wire_at_ = 0;
    if (session_) {
        session_->take_output(wire_);
        if (!wire_.empty()) return true;
        if (!session_->established()) return false;
    }
    plain_.clear();
    add_pieces_locked();
    if (plain_.empty()) {
        if (closing_ms_ != 0 && !std::exchange(shut_, true))
            ::shutdown(socket_->stream.native_handle(), SHUT_WR);
        return false;
    }
    if (!session_) {
        wire_.swap(plain_);
        return true;
    }
    if (!session_->send(plain_)) failure = session_->failure();
    session_->take_output(wire_);
    return failure.empty();
}

/// Fills one round of plain bytes with frames: all that are urgent, then the oldest of the others.
void Connection::add_pieces_locked() {
    const auto done = [&](std::deque<Outgoing>& line) {
        waiting_bytes_ -= line.front().bytes.size();
        line.pop_front();
    };
    while (!urgent_.empty() && plain_.size() < kFrameMost) {
        append_frame(plain_, urgent_.front().kind, urgent_.front().bytes);
        done(urgent_);
    }
    while (!waiting_.empty() && plain_.size() < kFrameMost) {
        Outgoing& first = waiting_.front();
        const std::span<const std::uint8_t> rest = std::span(first.bytes).subspan(first.at);
        const std::span<const std::uint8_t> piece = rest.first(std::min(rest.size(), kFrameMost));
        const bool is_last = piece.size() == rest.size();
        append_frame(plain_,
                     first.at > 0 || !is_last ? (is_last ? FrameKind::kLast : FrameKind::kPiece) : first.kind,
                     piece);
        first.at += piece.size();
        if (is_last) done(waiting_);
    }
}

bool Connection::all_sent() const {
    const std::lock_guard lock(mutex_);
    if (ended_) return true;
    if (!urgent_.empty() || !waiting_.empty() || wire_at_ < wire_.size()) return false;
    int in_kernel = 0;
    return ::ioctl(socket_->stream.native_handle(), SIOCOUTQ, &in_kernel) != 0 || in_kernel == 0;
}

void Connection::turn_deaf() {
    const std::lock_guard lock(mutex_);
    deaf = true;
    urgent_.clear();
    waiting_.clear();
    waiting_bytes_ = 0;
    const int socket = socket_->stream.native_handle();
    set_option(socket, SO_KEEPALIVE, 1, SOL_SOCKET);
    for (const auto& [option, value] : {std::pair{TCP_KEEPIDLE, 60}, {TCP_KEEPINTVL, 20}, {TCP_KEEPCNT, 3}})
        set_option(socket, option, value);
}

std::string Connection::who() const {
    std::string who;
    if (session_ && !session_->peer().name.empty()) who += "'" + session_->peer().name + "' ";
    if (!hello.name.empty()) who += hello.name + " ";
    return who + "at " + where_;
}

// --- ending

void Connection::close(const std::string& reason) {
    asio::post(socket_->context, [self = shared_from_this(), reason] { self->end(reason); });
}

/// Nothing can be sent any more; what the other end said before may still be here.
void Connection::end_after_reading(const std::string& reason) {
    const std::span<std::uint8_t> into = arrivals();
    while (!ended_) {
        const ssize_t bytes = ::recv(socket_->stream.native_handle(), into.data(), into.size(), MSG_DONTWAIT);
        if (bytes <= 0) break;
        receive(into.first(static_cast<std::size_t>(bytes)));
    }
    end(reason);
}

void Connection::end(const std::string& reason) {
    {
        const std::lock_guard lock(mutex_);
        if (ended_.exchange(true)) return;
        boost::system::error_code ignored;
        socket_->stream.close(ignored);
    }
    events_.closed(*this, reason);
}

}  // namespace roboss
