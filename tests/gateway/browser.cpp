// Beast as a client.
#include "browser.h"

#include <boost/asio/connect.hpp>
#include <boost/beast/http.hpp>
#include <cstring>

#include "wire/viewer_protocol.h"

namespace roboss::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace protocol = viewer_protocol;
using tcp = asio::ip::tcp;

tcp::endpoint endpoint_of(const ViewerUrl& url) {
    return {asio::ip::make_address(url.host), static_cast<std::uint16_t>(std::stoi(url.port))};
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value{};
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

}  // namespace

ViewerUrl::ViewerUrl(const std::string& url) {
    const std::size_t begin = url.find("://") + 3, colon = url.find(':', begin), slash = url.find('/', begin);
    host = url.substr(begin, colon - begin);
    port = url.substr(colon + 1, slash - colon - 1);
    if (const std::size_t mark = url.find("token="); mark != std::string::npos) token = url.substr(mark + 6);
}

HttpAnswer http_get(const ViewerUrl& url, const std::string& target, const std::string& host_header,
                    const std::string& cookie) {
    asio::io_context io;
    tcp::socket socket(io);
    beast::error_code error;
    socket.connect(endpoint_of(url), error);
    if (error) return {};
    http::request<http::empty_body> request(http::verb::get, target, 11);
    request.set(http::field::host, host_header.empty() ? url.authority() : host_header);
    request.set(http::field::connection, "close");
    if (!cookie.empty()) request.set(http::field::cookie, cookie);
    http::write(socket, request, error);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(256u << 20);
    http::read(socket, buffer, parser, error);
    if (!parser.is_done()) return {};
    HttpAnswer answer{static_cast<int>(parser.get().result_int()), {}, parser.get().body()};
    for (const auto& field : parser.get())
        answer.headers[std::string(field.name_string())] = std::string(field.value());
    return answer;
}

int http_raw(const ViewerUrl& url, const std::string& request) {
    asio::io_context io;
    tcp::socket socket(io);
    beast::error_code error;
    socket.connect(endpoint_of(url), error);
    asio::write(socket, asio::buffer(request), error);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    http::read_header(socket, buffer, parser, error);
    return error ? 0 : static_cast<int>(parser.get().result_int());
}

SilentSocket::SilentSocket(const ViewerUrl& url, const std::string& beginning) {
    beast::error_code error;
    socket_.connect(endpoint_of(url), error);
    connected_ = !error;
    if (!beginning.empty()) asio::write(socket_, asio::buffer(beginning), error);
}

bool SilentSocket::closed() {
    if (!connected_) return true;
    beast::error_code error;
    socket_.non_blocking(true, error);
    char byte = 0;
    socket_.read_some(asio::buffer(&byte, 1), error);
    return error && error != asio::error::would_block;
}

Browser::Browser(const ViewerUrl& url, const SocketHeaders& headers) : socket_(io_) {
    beast::error_code error;
    auto& tcp_socket = beast::get_lowest_layer(socket_).socket();
    tcp_socket.open(endpoint_of(url).protocol(), error);
    if (headers.receive_bytes > 0)
        tcp_socket.set_option(asio::socket_base::receive_buffer_size(headers.receive_bytes), error);
    tcp_socket.connect(endpoint_of(url), error);
    if (error) return;
    socket_.read_message_max(64u << 20);
    socket_.set_option(beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
        if (headers.subprotocol != kLeftOut)
            request.set(http::field::sec_websocket_protocol, headers.subprotocol);
        if (headers.origin != kLeftOut)
            request.set(http::field::origin,
                        headers.origin.empty() ? url.scheme + "://" + url.authority() : headers.origin);
    }));
    const std::string host = headers.host.empty() ? url.authority() : headers.host;
    socket_.handshake(host, headers.target, error);
    connected_ = !error;
    if (connected_) read();
}

Browser::~Browser() = default;

void Browser::read() {
    if (!reading_) return;
    pending_ = true;
    socket_.async_read(buffer_, [this](beast::error_code error, std::size_t) {
        pending_ = false;
        if (error) {
            closed_ = true;
            return;
        }
        const std::string bytes = beast::buffers_to_string(buffer_.data());
        buffer_.consume(buffer_.size());
        if (socket_.got_binary()) {
            if (!bytes.empty() && bytes[0] == protocol::kPictureKind)
                take_picture(bytes);
            else
                take_state(bytes);
        } else {
            Json message = Json::parse(bytes);
            const std::string type = message["type"];
            if (type == "answer")
                answers_[message["id"].get<int>()] =
                    (message["done"] ? "yes " : "no ") + message["text"].get<std::string>();
            if (type == "scene") robots_.clear();
            last_[type] = std::move(message);
        }
        read();
    });
}

void Browser::take_picture(const std::string& bytes) {
    damaged_ = damaged_ || bytes.size() < protocol::kPictureBytes;
    if (damaged_) return;
    const auto about = at<std::uint32_t>(bytes, protocol::kPictureAboutBytesAt);
    damaged_ = bytes.size() - protocol::kPictureBytes < about;
    if (damaged_) return;
    Picture picture;
    picture.tick = at<double>(bytes, protocol::kPictureTickAt);
    picture.scene = at<std::uint32_t>(bytes, protocol::kPictureSceneAt);
    picture.robot = at<std::uint32_t>(bytes, protocol::kPictureRobotAt);
    picture.sensor = at<std::uint32_t>(bytes, protocol::kPictureSensorAt);
    picture.about = Json::parse(bytes.substr(protocol::kPictureBytes, about));
    picture.file.assign(bytes.begin() + protocol::kPictureBytes + about, bytes.end());
    pictures_.push_back(std::move(picture));
}

void Browser::take_state(const std::string& bytes) {
    damaged_ = damaged_ || bytes.size() < protocol::kStateBytes;
    if (damaged_) return;
    ++states_;
    state_bytes_ += bytes.size();
    whole_ = (at<std::uint8_t>(bytes, protocol::kStateFlagsAt) & protocol::kFlagWhole) != 0;
    scene_ = at<std::uint32_t>(bytes, protocol::kStateSceneAt);
    tick_ = at<double>(bytes, protocol::kStateTickAt);
    if (first_tick_ < 0) first_tick_ = tick_;
    const auto known = coordinates_.find(scene_);
    if (known == coordinates_.end()) return;
    const std::vector<std::size_t>& widths = known->second;
    std::size_t offset = protocol::kStateBytes;
    for (std::uint32_t i = at<std::uint32_t>(bytes, protocol::kStateRobotsAt); i > 0; --i) {
        damaged_ = damaged_ || bytes.size() - offset < protocol::kStateEntryBytes;
        if (damaged_) return;
        const auto robot = at<std::uint32_t>(bytes, offset);
        damaged_ = robot >= widths.size();
        if (damaged_) return;
        Shown& shown = robots_[robot];
        std::memcpy(shown.position, bytes.data() + offset + protocol::kStateEntryPositionAt,
                    sizeof(shown.position));
        std::memcpy(shown.orientation, bytes.data() + offset + protocol::kStateEntryOrientationAt,
                    sizeof(shown.orientation));
        shown.coordinates.resize(widths[robot]);
        std::memcpy(shown.coordinates.data(), bytes.data() + offset + protocol::kStateEntryCoordinatesAt,
                    2 * widths[robot]);
        offset += protocol::kStateEntryBytes + 2 * widths[robot];
    }
    damaged_ = damaged_ || offset != bytes.size();
}

void Browser::send_text(const std::string& text, bool binary) {
    beast::error_code error;
    socket_.binary(binary);
    socket_.write(asio::buffer(text), error);
    closed_ = closed_ || error;
}

void Browser::send_raw(const std::string& bytes) {
    beast::error_code error;
    asio::write(beast::get_lowest_layer(socket_).socket(), asio::buffer(bytes), error);
    closed_ = closed_ || error;
}

void Browser::vanish() {
    beast::error_code error;
    beast::get_lowest_layer(socket_).socket().set_option(asio::socket_base::linger(true, 0), error);
    beast::get_lowest_layer(socket_).socket().close(error);
    closed_ = true;
}

bool Browser::until(const std::function<bool()>& done, int ms_max) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms_max);
    while (!done() && std::chrono::steady_clock::now() < end) {
        io_.restart();
        io_.run_for(std::chrono::milliseconds(5));
    }
    return done();
}

std::optional<std::string> Browser::answer(int id) const {
    const auto found = answers_.find(id);
    return found == answers_.end() ? std::nullopt : std::optional(found->second);
}

const Browser::Json* Browser::last(const std::string& type) const {
    const auto found = last_.find(type);
    return found == last_.end() ? nullptr : &found->second;
}

}  // namespace roboss::test
