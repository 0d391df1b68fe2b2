// A Controller that was started again has other keys. A member that has read the earlier ones just before
// calls again with the new ones, and does not end.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <support/loopback_bus.h>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <thread>

#include "net/key_folder.h"
#include "net/network.h"
#include "net/run_keys.h"

namespace roboss {
namespace {

using test::becomes, test::controller_of, test::loopback, test::member_of;
using Tcp = boost::asio::ip::tcp;

/// A port that takes calls for another one, and passes each on only after `before`.
class Detour {
  public:
    Detour(std::uint16_t to, std::function<void()> before) : to_(to), before_(std::move(before)) {
        thread_ = std::thread([this] { serve(); });
    }
    ~Detour() {
        done_ = true;
        thread_.join();
    }
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  private:
    static constexpr int kTurn_ms = 20;

    void serve() {
        pollfd waiting{acceptor_.native_handle(), POLLIN, 0};
        while (!done_) {
            if (::poll(&waiting, 1, kTurn_ms) <= 0) continue;
            Tcp::socket caller = acceptor_.accept(), called(context_);
            before_();
            called.connect({boost::asio::ip::make_address_v4("127.0.0.1"), to_});
            while (!done_ && pass(caller.native_handle(), called.native_handle())) {
            }
        }
    }

    /// False: one of both has closed the connection.
    static bool pass(int a, int b) {
        std::array<pollfd, 2> ends{{{a, POLLIN, 0}, {b, POLLIN, 0}}};
        ::poll(ends.data(), ends.size(), kTurn_ms);
        for (std::size_t k = 0; k < 2; ++k) {
            if (ends[k].revents == 0) continue;
            std::array<char, 4096> bytes{};
            const ssize_t count = ::recv(ends[k].fd, bytes.data(), bytes.size(), 0);
            if (count <= 0) return false;
            if (::send(ends[1 - k].fd, bytes.data(), static_cast<std::size_t>(count), MSG_NOSIGNAL) != count)
                return false;
        }
        return true;
    }

    std::uint16_t to_;
    std::function<void()> before_;
    boost::asio::io_context context_;
    Tcp::acceptor acceptor_{context_, {boost::asio::ip::make_address_v4("127.0.0.1"), 0}};
    std::atomic<bool> done_ = false;
    std::thread thread_;
};

/// The note of a Controller, with the keys of an earlier one, and calls on a detour.
class ReplacedKeys : public testing::Test {
  protected:
    std::uint16_t port() const {
        return host_port(MeetingPlace::find(options_.simulation)->address).value().port;
    }
    void leave_keys(const Credentials& keys) const {
        EXPECT_TRUE(write_keys(test::run_keys(options_.simulation), keys).ok());
    }
    NetOptions on_detour(const Detour& detour) const {
        NetOptions options = options_;
        options.controller = "127.0.0.1:" + std::to_string(detour.port());
        return options;
    }

    NetOptions options_ = loopback("replaced");
    std::unique_ptr<StreamBus> controller_ = controller_of(options_);
    const Credentials now_ = *MeetingPlace::find(options_.simulation)->keys;
    const Credentials before_ = new_run_keys(options_.simulation).value().member;
    const Address self_{Role::kSimulator, 1};
};

TEST_F(ReplacedKeys, ThatWereReadTooEarlyAreReadAgain) {
    leave_keys(before_);
    const Detour detour(port(), [&] { leave_keys(now_); });
    const auto member = member_of(on_detour(detour), self_);
    EXPECT_TRUE(becomes([&] { return member->present(kControllerAddress); }));
    EXPECT_FALSE(member->refusal().has_value());
}

TEST_F(ReplacedKeys, ThatStayWrongAreRefused) {
    leave_keys(before_);
    const Detour detour(port(), [] {});
    const auto member = member_of(on_detour(detour), self_);
    EXPECT_TRUE(becomes([&] { return member->refusal().has_value(); }));
    EXPECT_EQ(member->refusal()->code, "bad-certificate");
}

}  // namespace
}  // namespace roboss
