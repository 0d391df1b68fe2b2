// A client for tests: Foxglove's protocol by hand, on this computer.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

namespace roboss::foxglove {

/// See the top of the file.
class TestClient {
  public:
    using Json = nlohmann::json;

    /// Connects; is_open() says whether it may.
    explicit TestClient(std::uint16_t port, const std::string& subprotocols = "foxglove.sdk.v1",
                        const std::string& origin = "") {
        namespace http = boost::beast::http;
        namespace websocket = boost::beast::websocket;
        socket_.next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
        socket_.set_option(websocket::stream_base::decorator([=](websocket::request_type& request) {
            if (!subprotocols.empty()) request.set(http::field::sec_websocket_protocol, subprotocols);
            if (!origin.empty()) request.set(http::field::origin, origin);
        }));
        socket_.read_message_max(0);
        websocket::response_type response;
        boost::beast::error_code error;
        socket_.handshake(response, "localhost", "/", error);
        is_open_ = !error;
        const auto subprotocol = response[http::field::sec_websocket_protocol];
        subprotocol_ = std::string(subprotocol.data(), subprotocol.size());
    }

    bool is_open() const { return is_open_; }
    const std::string& subprotocol() const { return subprotocol_; }

    void send(const Json& json) { send_text(json.dump()); }
    void send_text(const std::string& text) {
        socket_.binary(false);
        socket_.write(boost::asio::buffer(text));
    }
    void send_bytes(const std::string& bytes) {
        socket_.binary(true);
        socket_.write(boost::asio::buffer(bytes));
    }

    /// The next frame; empty: none within this time, or the connection is closed.
    std::string receive(std::chrono::milliseconds wait = std::chrono::seconds(10)) {
        if (!is_reading_) {
            buffer_.clear();
            is_reading_ = true;
            socket_.async_read(buffer_, [this](boost::beast::error_code error, std::size_t) {
                is_reading_ = false;
                is_closed_ = static_cast<bool>(error);
            });
        }
        io_.restart();
        io_.run_for(wait);
        if (is_reading_ || is_closed_) return {};
        return boost::beast::buffers_to_string(buffer_.data());
    }
    /// The next frame of text of this kind; others are skipped. Null: there was none.
    Json receive_op(const std::string& op) {
        for (std::string text = receive(); !text.empty(); text = receive())
            if (const Json json = Json::parse(text, nullptr, false); json.is_object() && json["op"] == op)
                return json;
        return {};
    }
    /// The next binary frame of this opcode; others are skipped.
    std::string receive_bytes(char opcode) {
        for (std::string bytes = receive(); !bytes.empty(); bytes = receive())
            if (bytes[0] == opcode) return bytes;
        return {};
    }
    bool is_closed() const { return is_closed_; }

  private:
    boost::asio::io_context io_;
    boost::beast::websocket::stream<boost::asio::ip::tcp::socket> socket_{io_};
    boost::beast::flat_buffer buffer_;
    std::string subprotocol_;
    bool is_open_ = false, is_reading_ = false, is_closed_ = false;
};

}  // namespace roboss::foxglove
