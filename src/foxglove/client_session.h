// ClientSession: a connection of a client: its request, then its WebSocket. It is read frame by frame and
// written at the pace at which the client reads.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <memory>
#include <optional>
#include <string>

#include "foxglove/hub.h"

namespace roboss::foxglove {

class Server;

class ClientSession : public std::enable_shared_from_this<ClientSession> {
  public:
    ClientSession(boost::asio::ip::tcp::socket&& socket, Server& server);
    ~ClientSession();
    void start();
    /// The server ends: closes it by the protocol.
    void say_farewell();

  private:
    using Request = boost::beast::http::request<boost::beast::http::empty_body>;

    void serve();
    void refuse(boost::beast::http::status status, const std::string& why);
    void upgrade(const std::string& subprotocol);
    void read();
    void write();
    void end(const std::string& why = {});
    void close();
    boost::beast::tcp_stream& tcp() { return socket_.next_layer(); }

    boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
    Server& server_;
    std::string peer_;
    boost::beast::flat_buffer buffer_;
    std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_;
    Request request_;
    ClientNumber client_ = 0;     // 0: it is none yet, or no more
    std::optional<Frame> frame_;  // under way
    bool has_ended_ = false;
};

}  // namespace roboss::foxglove
