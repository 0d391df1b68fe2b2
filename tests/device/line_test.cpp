// Real sockets and pseudo terminals of this computer.
#include "device/line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace roboss::test {
namespace {

/// All that arrives within a second, or as much as is waited for.
std::string heard(DeviceLine& line, std::size_t size) {
    std::string all;
    for (int i = 0; i < 1000 && all.size() < size; ++i) {
        auto pieces = line.receive();
        if (!pieces) return all + "<" + pieces.error().code + ">";
        for (const std::string& piece : pieces.value()) all += piece;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
}

TEST(DeviceLine, AddressesThatAreNoneAreRefused) {
    for (const char* address : {"", "tty", "serial:", "serial:/dev/tty,fast", "serial:/dev/tty,0", "udp:host",
                                "udp::5", "udp:host:", "udp:host:0", "udp:host:65536", "udp:host:5x"})
        EXPECT_EQ(open_line(address).error().code, "bad-address") << address;
    EXPECT_EQ(open_line("serial:/dev/no_such_port").error().code, "no-line");
}

TEST(DeviceLine, ASerialLineCarriesBytesBothWaysAndBreaksWithItsOtherEnd) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(master, 0);
    ASSERT_EQ(grantpt(master), 0);
    ASSERT_EQ(unlockpt(master), 0);
    auto line = open_line("serial:" + std::string(ptsname(master)) + ",38400");
    ASSERT_TRUE(line.ok()) << line.error().text();
    ASSERT_EQ(::write(master, "n,1\r\n", 5), 5);
    EXPECT_EQ(heard(*line.value(), 5), "n,1\r\n");  // raw: no character is changed
    ASSERT_TRUE(line.value()->send("D,1,1\n").ok());
    char text[16] = {};
    EXPECT_EQ(::read(master, text, sizeof text), 6);
    EXPECT_STREQ(text, "D,1,1\n");
    ::close(master);
    EXPECT_EQ(heard(*line.value(), 1), "<no-line>");
    EXPECT_FALSE(line.value()->send("D,0,0\n").ok());
    EXPECT_FALSE(line.value()->reopen().ok());
}

TEST(DeviceLine, AFloodIsReadInParts) {
    const int device = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET, here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    ASSERT_EQ(::bind(device, reinterpret_cast<sockaddr*>(&here), size), 0);
    ASSERT_EQ(::getsockname(device, reinterpret_cast<sockaddr*>(&here), &size), 0);
    auto line = open_line("udp:127.0.0.1:" + std::to_string(ntohs(here.sin_port)));
    ASSERT_TRUE(line.ok()) << line.error().text();
    ASSERT_TRUE(line.value()->send("here").ok());
    char text[8];
    sockaddr_in there{};
    ASSERT_EQ(::recvfrom(device, text, sizeof text, 0, reinterpret_cast<sockaddr*>(&there), &size), 4);
    std::atomic<bool> ends = false;
    std::thread flood([&] {
        while (!ends)
            (void)::sendto(device, "flood", 5, 0, reinterpret_cast<const sockaddr*>(&there), sizeof there);
    });
    std::size_t pieces = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (pieces < 3000 && std::chrono::steady_clock::now() < end) {
        const auto got = line.value()->receive();
        ASSERT_TRUE(got.ok());
        EXPECT_LE(got.value().size(), 1000u);
        pieces += got.value().size();
    }
    ends = true;
    flood.join();
    ::close(device);
    EXPECT_GE(pieces, 3000u);
}

TEST(DeviceLine, AUdpLineWaitsForADeviceThatIsNotThereYet) {
    auto line = open_line("udp:127.0.0.1:9");
    ASSERT_TRUE(line.ok()) << line.error().text();
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(line.value()->send("hello").ok());
        EXPECT_TRUE(line.value()->receive().ok());
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace
}  // namespace roboss::test
