// Server: the thread on which clients of the Foxglove protocol are served. Everything in it belongs to that
// thread once it has started, but for url() and the destructor.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "foxglove/foxglove_transport.h"
#include "foxglove/hub.h"

namespace roboss::foxglove {

class ClientSession;

class Server {
  public:
    Server(Hub& hub, const FoxgloveOptions& options);
    /// Says goodbye to the clients and ends the thread.
    ~Server();

    Result<> listen();
    void start();
    std::string url() const;

    // --- for sessions
    Hub& hub() { return hub_; }
    bool has_room() const { return hub_.clients() < options_.clients_max; }
    /// Why a web page may not connect, of the header Origin; empty: it may.
    std::string refusal(const std::string& origin) const;
    void ended(ClientSession* session);

  private:
    void serve();
    void accept();

    Hub& hub_;
    FoxgloveOptions options_;
    std::set<ClientSession*> sessions_;  // sessions take themselves out, the last ones when io_ ends
    std::atomic<std::size_t> open_ = 0;  // the size of it
    boost::asio::io_context io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    boost::asio::steady_timer pause_;  // before the next connection is accepted, after an error
    std::thread thread_;
};

}  // namespace roboss::foxglove
