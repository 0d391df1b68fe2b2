// Lines by Boost.Asio: reads and writes are started, and finished whenever the owner looks.
#include "device/line.h"

#include <array>
#include <boost/asio.hpp>
#include <charconv>
#include <cstdint>
#include <deque>
#include <optional>

namespace roboss {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::size_t kMostWaiting = 64;    // writes; with more, the device does not read
constexpr std::size_t kMostAtOnce = 1'000;  // pieces that are read before they are taken

Error broken(const std::string& address, const error_code& why) {
    return {"the line " + address + " is broken: " + why.message(), "check the cable and the device's power",
            "no-line"};
}

/// What both kinds of lines share. `Port` has async_read_some and async_write_some, or their counterparts.
template <class Transport>
class AsioLine final : public DeviceLine {
  public:
    AsioLine(std::string address, typename Transport::Place place)
        : address_(std::move(address)), place_(std::move(place)) {}
    ~AsioLine() override { close(); }

    Result<> open() {
        close();
        port_.emplace(io_);
        if (const error_code failed = Transport::open(*port_, place_); failed) {
            port_.reset();
            return Error{"the line " + address_ + " cannot be opened: " + failed.message(),
                         Transport::kRemedy, "no-line"};
        }
        failed_ = {};
        is_full_ = false;
        read();
        return Ok{};
    }

    Result<> send(std::string_view bytes) override {
        if (!port_ || failed_) return broken(address_, failed_);
        if (outbox_.size() >= kMostWaiting)
            return Error{"the line " + address_ + " takes no more bytes", "check the device's power",
                         "no-line"};
        outbox_.emplace_back(bytes);
        if (outbox_.size() == 1) write();
        turn();
        return Ok{};
    }

    Result<std::vector<std::string>> receive() override {
        turn();
        if (inbox_.empty() && (!port_ || failed_)) return broken(address_, failed_);
        std::vector<std::string> pieces = std::exchange(inbox_, {});
        if (std::exchange(is_full_, false)) read();
        return pieces;
    }

    Result<> reopen() override { return open(); }
    const std::string& address() const override { return address_; }

  private:
    void close() {
        if (port_) {
            error_code ignored;
            port_->close(ignored);
        }
        turn();  // ends what was started
        port_.reset();
        outbox_.clear();
        inbox_.clear();
    }
    void turn() {
        io_.restart();
        io_.poll();
    }
    void read() {
        Transport::read(*port_, asio::buffer(buffer_), [this](const error_code& failed, std::size_t size) {
            if (Transport::is_passing(failed)) return read();
            if (failed) {
                failed_ = failed;
                return;
            }
            inbox_.emplace_back(buffer_.data(), size);
            is_full_ = inbox_.size() >= kMostAtOnce;  // else a flood would never let go of this thread
            if (!is_full_) read();
        });
    }
    void write() {
        Transport::write(*port_, asio::buffer(outbox_.front()),
                         [this](const error_code& failed, std::size_t) {
                             if (failed && !Transport::is_passing(failed)) {
                                 failed_ = failed;
                                 return;
                             }
                             if (!outbox_.empty()) outbox_.pop_front();
                             if (!outbox_.empty()) write();
                         });
    }

    std::string address_;
    typename Transport::Place place_;
    asio::io_context io_;
    std::optional<typename Transport::Port> port_;
    std::array<char, 65536> buffer_{};
    std::deque<std::string> outbox_;  // the first is being written
    std::vector<std::string> inbox_;
    bool is_full_ = false;  // nothing is read until it is emptied
    error_code failed_;
};

struct Serial {
    using Port = asio::serial_port;
    struct Place {
        std::string path;
        unsigned baud = 9600;
    };
    static constexpr const char* kRemedy =
        "check the path and the cable; a user reads serial ports as a member of the group dialout";

    static error_code open(Port& port, const Place& place) {
        error_code failed;
        const auto set = [&](const auto& option) {
            if (!failed) port.set_option(option, failed);
        };
        port.open(place.path, failed);
        set(Port::baud_rate(place.baud));
        set(Port::character_size(8));
        set(Port::parity(Port::parity::none));
        set(Port::stop_bits(Port::stop_bits::two));
        set(Port::flow_control(Port::flow_control::none));
        return failed;
    }
    template <class Done>
    static void read(Port& port, asio::mutable_buffer buffer, Done done) {
        port.async_read_some(buffer, done);
    }
    template <class Done>
    static void write(Port& port, asio::const_buffer buffer, Done done) {
        asio::async_write(port, buffer, done);
    }
    static bool is_passing(const error_code&) { return false; }
};

struct Udp {
    using Port = asio::ip::udp::socket;
    struct Place {
        std::string host, port;
    };
    static constexpr const char* kRemedy = "check the name and the port of the host";

    static error_code open(Port& port, const Place& place) {
        error_code failed;
        asio::ip::udp::resolver resolver(port.get_executor());
        const auto found = resolver.resolve(place.host, place.port, failed);
        if (failed) return failed;
        const asio::ip::udp::endpoint endpoint = *found.begin();
        port.open(endpoint.protocol(), failed);
        if (!failed) port.connect(endpoint, failed);
        return failed;
    }
    template <class Done>
    static void read(Port& port, asio::mutable_buffer buffer, Done done) {
        port.async_receive(buffer, done);
    }
    template <class Done>
    static void write(Port& port, asio::const_buffer buffer, Done done) {
        port.async_send(buffer, done);
    }
    /// Nobody listens there yet: the host says so, and the device may still come.
    static bool is_passing(const error_code& failed) {
        return failed == asio::error::connection_refused || failed == asio::error::host_unreachable ||
               failed == asio::error::network_unreachable;
    }
};

template <class Transport>
Result<std::unique_ptr<DeviceLine>> opened(const std::string& address, typename Transport::Place place) {
    auto line = std::make_unique<AsioLine<Transport>>(address, std::move(place));
    if (Result<> open = line->open(); !open) return open.error();
    return std::unique_ptr<DeviceLine>(std::move(line));
}

Error bad_address(const std::string& address) {
    return {"'" + address + "' is no address of a device",
            "write serial:PATH, serial:PATH,BAUD or udp:HOST:PORT, for example serial:/dev/ttyUSB0,38400",
            "bad-address"};
}

}  // namespace

Result<std::unique_ptr<DeviceLine>> open_line(const std::string& address) {
    if (address.starts_with("serial:")) {
        Serial::Place place{address.substr(7)};
        if (const std::size_t comma = place.path.find(','); comma != std::string::npos) {
            const std::string baud = place.path.substr(comma + 1);
            const auto [end, failed] = std::from_chars(baud.data(), baud.data() + baud.size(), place.baud);
            if (failed != std::errc() || end != baud.data() + baud.size() || place.baud == 0)
                return bad_address(address);
            place.path.resize(comma);
        }
        if (place.path.empty()) return bad_address(address);
        return opened<Serial>(address, place);
    }
    const std::size_t colon = address.rfind(':');
    if (!address.starts_with("udp:") || colon <= 4) return bad_address(address);
    std::uint16_t port = 0;
    const char* const last = address.data() + address.size();
    const auto [end, failed] = std::from_chars(address.data() + colon + 1, last, port);
    if (failed != std::errc() || end != last || port == 0) return bad_address(address);
    return opened<Udp>(address, {address.substr(4, colon - 4), address.substr(colon + 1)});
}

}  // namespace roboss
