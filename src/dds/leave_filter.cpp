// Submessages of RTPS, as far as needed.
#include "dds/leave_filter.h"

#include <algorithm>
#include <array>

namespace roboss {
namespace {

namespace rtps = eprosima::fastdds::rtps;
namespace fastrtps = eprosima::fastrtps::rtps;

constexpr std::size_t kHeaderBytes = 20;           // "RTPS", version, vendor, prefix
constexpr std::size_t kSubmessageHeaderBytes = 4;  // kind, flags, length
constexpr std::uint8_t kPad = 0x01, kTimestamp = 0x09, kData = 0x15;
constexpr std::uint8_t kLittleEndian = 0x01, kHasData = 0x04;
constexpr std::size_t kWriterAt = 8;  // in a DATA submessage, behind its header
constexpr std::array<std::uint8_t, 4> kParticipantWriter{0x00, 0x01, 0x00, 0xC2};

class LeaveFilter : public rtps::ChainingTransport {
  public:
    using ChainingTransport::ChainingTransport;

    rtps::TransportDescriptorInterface* get_configuration() override {
        return low_level_transport_->get_configuration();
    }

    bool send(fastrtps::SenderResource* lower, const fastrtps::octet* bytes, std::uint32_t size,
              fastrtps::LocatorsIterator* first, fastrtps::LocatorsIterator* last,
              const std::chrono::steady_clock::time_point& until) override {
        return lower->send(bytes, size, first, last, until);
    }

    void receive(rtps::TransportReceiverInterface* next, const fastrtps::octet* bytes, std::uint32_t size,
                 const fastrtps::Locator_t& local, const fastrtps::Locator_t& remote) override {
        if (!announces_leave({bytes, size})) next->OnDataReceived(bytes, size, local, remote);
    }
};

struct LeaveFilterDescriptor : rtps::ChainingTransportDescriptor {
    using ChainingTransportDescriptor::ChainingTransportDescriptor;
    rtps::TransportInterface* create_transport() const override { return new LeaveFilter(*this); }
};

}  // namespace

bool announces_leave(std::span<const std::uint8_t> datagram) {
    std::size_t at = kHeaderBytes;
    while (at + kSubmessageHeaderBytes <= datagram.size()) {
        const std::uint8_t kind = datagram[at], flags = datagram[at + 1];
        const std::size_t low = datagram[at + 2], high = datagram[at + 3];
        std::size_t bytes = (flags & kLittleEndian) != 0 ? low | high << 8 : high | low << 8;
        at += kSubmessageHeaderBytes;
        const std::size_t rest = datagram.size() - at;
        if (bytes == 0 && kind != kPad && kind != kTimestamp) bytes = rest;  // the last one
        const auto body = datagram.subspan(at, std::min(bytes, rest));
        if (kind == kData && (flags & kHasData) == 0 &&
            body.size() >= kWriterAt + kParticipantWriter.size() &&
            std::equal(kParticipantWriter.begin(), kParticipantWriter.end(), body.begin() + kWriterAt))
            return true;
        at += body.size();
    }
    return false;
}

std::shared_ptr<rtps::TransportDescriptorInterface> without_leaves(
    std::shared_ptr<rtps::TransportDescriptorInterface> lower) {
    return std::make_shared<LeaveFilterDescriptor>(std::move(lower));
}

}  // namespace roboss
