// See server_session.h.
#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>

#include "foxglove/client_session.h"
#include "foxglove/server_session.h"

namespace roboss::foxglove {

namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

constexpr std::size_t kConnectionsMost = 64;  // with those that are no clients yet
constexpr int kSendBytes = 256 << 10;         // what lies in a socket is old when it is read: not much of it
constexpr auto kFarewell = std::chrono::milliseconds(300);
constexpr auto kPause = std::chrono::milliseconds(100);

Error not_encrypted(const std::string& address) {
    return {"the Foxglove server at " + address + " would be reachable by others, without encryption",
            "listen on this computer and let others connect by `ssh -L 8765:localhost:8765 THIS_COMPUTER`, "
            "or give --insecure: then everybody who reaches it can read and drive the run",
            "not-encrypted"};
}

/// The host of "https://HOST:PORT", an IPv6 address without its brackets; empty: it is none.
std::string_view host_of(std::string_view origin) {
    const std::size_t mark = origin.find("://");
    if (mark == std::string_view::npos) return {};
    origin.remove_prefix(mark + 3);
    if (origin.starts_with('[')) return origin.substr(1, origin.find(']') - 1);
    return origin.substr(0, origin.find(':'));
}

}  // namespace

Server::Server(Hub& hub, const FoxgloveOptions& options)
    : hub_(hub), options_(options), io_(1), acceptor_(io_), pause_(io_) {}

Server::~Server() {
    if (!thread_.joinable()) return;
    asio::post(io_, [this] {
        boost::system::error_code ignored;
        acceptor_.close(ignored);
        pause_.cancel();
        for (ClientSession* session : std::set(sessions_)) session->say_farewell();
    });
    const auto until = std::chrono::steady_clock::now() + kFarewell;
    do {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (open_ > 0 && std::chrono::steady_clock::now() < until);
    io_.stop();
    thread_.join();
}

Result<> Server::listen() {
    boost::system::error_code error;
    const auto ip = asio::ip::make_address(options_.address, error);
    if (error)
        return Error{"'" + options_.address + "' is not an address of this computer",
                     "give an IPv4 or IPv6 address, for example 0.0.0.0 for all", "bad-address"};
    if (!ip.is_loopback() && !options_.insecure) return not_encrypted(options_.address);
    const tcp::endpoint endpoint(ip, options_.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return Ok{};
    return Error{"the Foxglove server cannot listen at " + options_.address + ":" +
                     std::to_string(options_.port) + ": " + error.message(),
                 "give another port, as --foxglove=8766 of a run or --listen 8766 of `roboss foxglove`",
                 "cannot-listen"};
}

std::string Server::url() const {
    boost::system::error_code error;
    const auto endpoint = acceptor_.local_endpoint(error);
    const bool is_local = endpoint.address().is_loopback();
    const std::string text = endpoint.address().to_string();
    const std::string host = is_local ? "localhost" : endpoint.address().is_v6() ? "[" + text + "]" : text;
    return "ws://" + host + ":" + std::to_string(endpoint.port());
}

void Server::start() {
    hub_.notice("open " + url() + " in Foxglove or Lichtblick [listening]");
    if (!acceptor_.local_endpoint().address().is_loopback())
        hub_.notice("everybody who reaches " + url() + " can read and drive this run [insecure]");
    accept();
    thread_ = std::thread([this] { serve(); });
}

/// Nothing that a client sends may end the process.
void Server::serve() {
    for (;;) {
        try {
            io_.run();
            return;
        } catch (const std::exception& why) {
            hub_.notice(std::string("Foxglove server: ") + why.what());
        }
    }
}

void Server::accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted) return;
        if (error) {  // perhaps no file descriptor is left
            pause_.expires_after(kPause);
            return pause_.async_wait([this](boost::system::error_code ended) {
                if (!ended) accept();
            });
        }
        if (sessions_.size() < kConnectionsMost) {
            boost::system::error_code ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            socket.set_option(asio::socket_base::send_buffer_size(kSendBytes), ignored);
            const auto session = std::make_shared<ClientSession>(std::move(socket), *this);
            sessions_.insert(session.get());
            open_ = sessions_.size();
            session->start();
        }
        accept();
    });
}

void Server::ended(ClientSession* session) {
    sessions_.erase(session);
    open_ = sessions_.size();
}

/// Programs send no Origin, desktop viewers that of a file.
std::string Server::refusal(const std::string& origin) const {
    if (origin.empty() || origin.starts_with("file://")) return {};
    const std::string_view host = host_of(origin);
    boost::system::error_code error;
    const auto ip = asio::ip::make_address(std::string(host), error);
    const bool is_local = host == "localhost" || (!error && ip.is_loopback());
    const bool is_foxglove =
        origin.starts_with("https://") && (host == "app.foxglove.dev" || host == "studio.foxglove.dev");
    if (is_local || is_foxglove || std::ranges::find(options_.origins, origin) != options_.origins.end())
        return {};
    return "pages of " + origin.substr(0, 100) + " may not connect; if you trust them, allow it with " +
           "--allow-origin " + origin.substr(0, 100) + " [wrong-origin]";
}

}  // namespace roboss::foxglove
