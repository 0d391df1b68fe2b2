// POSIX sockets: one thread accepts and reads, the run's thread writes replies.
#include "app/local/control_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "bus/bus.h"
#include "wire/codec.h"

namespace roboss {
namespace {

constexpr std::size_t kPathMost = 100;
constexpr std::uint32_t kBytesMost = 256u << 20;  // a file to add, or the names of a million robots
constexpr timeval kSlowest{2, 0};

std::optional<sockaddr_un> address_of(const std::filesystem::path& path) {
    const std::string text = path.string();
    if (text.size() > kPathMost) return std::nullopt;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, text.c_str(), text.size() + 1);
    return address;
}

bool send_all(int connection, const std::uint8_t* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t sent = ::send(connection, bytes, count, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes += sent, count -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int connection, std::uint8_t* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t got = ::recv(connection, bytes, count, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes += got, count -= static_cast<std::size_t>(got);
    }
    return true;
}

bool send_message(int connection, Message message) {
    const std::vector<std::uint8_t> bytes =
        encode({Address{Role::kClient, 1}, kControllerAddress, std::move(message)});
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::uint8_t head[4];
    for (unsigned i = 0; i < 4; ++i) head[i] = static_cast<std::uint8_t>(size >> (8 * i));
    return send_all(connection, head, 4) && send_all(connection, bytes.data(), bytes.size());
}

/// None: the other end has gone or was too slow.
std::optional<Result<Envelope>> receive_message(int connection) {
    std::uint8_t head[4];
    if (!receive_all(connection, head, 4)) return std::nullopt;
    std::uint32_t size = 0;
    for (unsigned i = 0; i < 4; ++i) size |= static_cast<std::uint32_t>(head[i]) << (8 * i);
    if (size > kBytesMost) return std::nullopt;
    std::vector<std::uint8_t> bytes(size);
    if (!receive_all(connection, bytes.data(), size)) return std::nullopt;
    return decode_envelope(bytes);
}

void limit_time(int connection, bool reading) {
    ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &kSlowest, sizeof kSlowest);
    if (reading) ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &kSlowest, sizeof kSlowest);
}

Error no_reply() {
    return {"the run ended before it replied", "look at its own messages", "no-reply"};
}

}  // namespace

ControlSocket::Call::~Call() {
    if (connection_ >= 0) ::close(connection_);
}

void ControlSocket::Call::answer(ControlOutcome outcome) {
    if (connection_ < 0) return;
    (void)send_message(connection_, ControlReply{1, std::move(outcome)});
    ::close(std::exchange(connection_, -1));
}

Result<std::unique_ptr<ControlSocket>> ControlSocket::open(const std::filesystem::path& path) {
    const auto failed = [&](const std::string& why) {
        return Error{path.string() + " cannot be opened for `roboss control`: " + why,
                     "set XDG_RUNTIME_DIR to a folder of yours with a short name", "no-control-socket"};
    };
    const std::optional<sockaddr_un> address = address_of(path);
    if (!address) return failed("its name is too long");
    const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (listener < 0) return failed(std::strerror(errno));
    ::unlink(path.c_str());  // of a killed process that had this number
    if (::bind(listener, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
        ::listen(listener, 16) != 0) {
        const std::string why = std::strerror(errno);
        ::close(listener);
        return failed(why);
    }
    const int wake = ::eventfd(0, EFD_CLOEXEC);
    return std::unique_ptr<ControlSocket>(new ControlSocket(listener, wake, path));
}

ControlSocket::ControlSocket(int listener, int wake, std::filesystem::path path)
    : listener_(listener), wake_(wake), path_(std::move(path)), thread_([this] { serve(); }) {}

ControlSocket::~ControlSocket() {
    ended_ = true;
    const std::uint64_t one = 1;
    (void)!::write(wake_, &one, sizeof one);
    thread_.join();
    ::close(listener_);
    ::close(wake_);
    ::unlink(path_.c_str());
}

void ControlSocket::serve() {
    while (!ended_) {
        pollfd watched[2] = {{listener_, POLLIN, 0}, {wake_, POLLIN, 0}};
        if (::poll(watched, 2, -1) < 0 && errno != EINTR) return;
        if (!ended_ && (watched[0].revents & POLLIN) != 0) accept_one();
    }
}

void ControlSocket::accept_one() {
    const int connection = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) return;
    limit_time(connection, true);
    const std::optional<Result<Envelope>> read = receive_message(connection);
    if (!read) {
        ::close(connection);
        return;
    }
    const auto* request = read->ok() ? std::get_if<ControlRequest>(&read->value().message) : nullptr;
    Call call(connection, request != nullptr ? request->action : ControlAction{});
    if (request == nullptr)
        return call.answer(
            ControlRefused(read->ok() ? Error{"not a request to a run", "use `roboss control`", "bad-request"}
                                      : read->error()));
    const std::lock_guard lock(mutex_);
    calls_.push_back(std::move(call));
    waiting_.store(true, std::memory_order_release);
}

std::vector<ControlSocket::Call> ControlSocket::take_calls() {
    if (!has_calls()) return {};
    const std::lock_guard lock(mutex_);
    waiting_ = false;
    return std::exchange(calls_, {});
}

Result<ControlOutcome> ask_run(const std::filesystem::path& socket, const ControlAction& action) {
    const std::optional<sockaddr_un> address = address_of(socket);
    const int connection = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (!address || connection < 0 ||
        ::connect(connection, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
        if (connection >= 0) ::close(connection);
        return Error{"the run does not answer at " + socket.string(), "it has just ended; see `roboss runs`",
                     "no-run"};
    }
    limit_time(connection, false);
    std::optional<Result<Envelope>> read;
    if (send_message(connection, ControlRequest{1, action})) read = receive_message(connection);
    ::close(connection);
    if (!read) return no_reply();
    if (!read->ok()) return read->error();
    if (const auto* reply = std::get_if<ControlReply>(&read->value().message)) return reply->outcome;
    return no_reply();
}

}  // namespace roboss
