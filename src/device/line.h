// DeviceLine: a serial port or a UDP socket to a device, that never waits.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace roboss {

class DeviceLine {
  public:
    virtual ~DeviceLine() = default;
    /// Sends the bytes, or one datagram, in the background. An Error: the line is broken, or takes nothing.
    virtual Result<> send(std::string_view bytes) = 0;
    /// What has arrived: datagrams, or pieces of the stream. An Error: the line is broken.
    virtual Result<std::vector<std::string>> receive() = 0;
    /// Opens a broken line again.
    virtual Result<> reopen() = 0;
    /// As on the command line.
    virtual const std::string& address() const = 0;
};

/// `serial:PATH[,BAUD]` (9600 baud, 8 bits, no parity, 2 stop bits) or `udp:HOST:PORT`. Errors:
/// "bad-address"; "no-line", if it cannot be opened.
Result<std::unique_ptr<DeviceLine>> open_line(const std::string& address);

}  // namespace roboss
