// A browser as the gateway sees one: HTTP requests, and a WebSocket that keeps the latest place of every
// robot as the page would. For tests and benchmarks.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wire/viewer_protocol.h"

namespace roboss::test {

struct HttpAnswer {
    int status = 0;  // 0: the connection was closed
    std::map<std::string, std::string> headers;
    std::string body;
};

/// "http://127.0.0.1:8090/?token=..." in its parts.
struct ViewerUrl {
    std::string host, port, token, scheme = "http";  // that of the Origin
    explicit ViewerUrl(const std::string& url);
    std::string authority() const { return host + ":" + port; }
};

HttpAnswer http_get(const ViewerUrl& url, const std::string& target, const std::string& host_header = {},
                    const std::string& cookie = {});

/// The status line's number for a request that is sent as it is; 0: no answer.
int http_raw(const ViewerUrl& url, const std::string& request);

/// Connects and says nothing, as long as it lives.
class SilentSocket {
  public:
    explicit SilentSocket(const ViewerUrl& url, const std::string& beginning = {});
    /// The gateway has closed it.
    bool closed();

  private:
    boost::asio::io_context io_;
    boost::asio::ip::tcp::socket socket_{io_};
    bool connected_ = false;
};

/// In `origin` and `subprotocol`: the header is left out.
inline constexpr char kLeftOut[] = "-";

struct SocketHeaders {
    std::string target = "/ws";
    std::string origin, host;  // empty: the right one
    std::string subprotocol = viewer_protocol::kSubprotocol;
    int receive_bytes = 0;  // of the socket's buffer; 0: as usual
};

class Browser {
  public:
    using Json = nlohmann::json;

    explicit Browser(const ViewerUrl& url, const SocketHeaders& headers = {});
    ~Browser();

    bool connected() const { return connected_; }
    bool closed() const { return closed_; }
    /// What the gateway said as it closed the WebSocket.
    std::string reason() const { return std::string(socket_.reason().reason.c_str()); }
    void send(const Json& message) { send_text(message.dump()); }
    void send_text(const std::string& text, bool binary = false);
    /// Bytes outside of any frame.
    void send_raw(const std::string& bytes);
    /// Goes without a word.
    void vanish();
    /// From now on nothing is read.
    void stop_reading() { reading_ = false; }
    void read_again() {
        reading_ = true;
        if (!pending_) read();
    }

    /// Works until `done` or the time is over; whether it is done.
    bool until(const std::function<bool()>& done, int ms_max = 10'000);
    void live(int ms) {
        until([] { return false; }, ms);
    }
    /// The text of the answer to `id`, if it came: "yes ..." or "no ...".
    std::optional<std::string> answer(int id) const;
    const Json* last(const std::string& type) const;

    struct Shown {
        float position[3] = {};
        std::int16_t orientation[4] = {};
        std::vector<std::int16_t> coordinates;
    };
    /// `coordinates`: how many the robots of this scene have, in its order.
    void know(std::vector<std::size_t> coordinates, std::uint32_t scene = 1) {
        coordinates_[scene] = std::move(coordinates);
    }
    /// A Picture message: its header's numbers, its JSON and its file.
    struct Picture {
        double tick = 0;
        std::uint32_t scene = 0, robot = 0, sensor = 0;
        Json about;
        std::vector<std::uint8_t> file;
    };
    const std::vector<Picture>& pictures() const { return pictures_; }
    const std::map<std::uint32_t, Shown>& robots() const { return robots_; }
    std::uint64_t states() const { return states_; }
    std::uint64_t state_bytes() const { return state_bytes_; }
    double tick() const { return tick_; }
    double first_tick() const { return first_tick_; }
    std::uint32_t scene() const { return scene_; }
    bool last_was_whole() const { return whole_; }
    bool damaged() const { return damaged_; }

  private:
    void read();
    void take_state(const std::string& bytes);
    void take_picture(const std::string& bytes);

    boost::asio::io_context io_;
    boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
    boost::beast::flat_buffer buffer_;
    bool connected_ = false, closed_ = false, reading_ = true, whole_ = false, damaged_ = false,
         pending_ = false;
    std::map<std::string, Json> last_;
    std::map<int, std::string> answers_;
    std::map<std::uint32_t, std::vector<std::size_t>> coordinates_;  // by scene
    std::map<std::uint32_t, Shown> robots_;
    std::vector<Picture> pictures_;
    std::uint64_t states_ = 0, state_bytes_ = 0;
    double tick_ = -1, first_tick_ = -1;
    std::uint32_t scene_ = 0;
};

}  // namespace roboss::test
