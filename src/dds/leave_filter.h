// A transport that hides announced leaves from Fast DDS: members are removed by their lease alone, in one
// thread. In Fast DDS 2.9 such an announcement, handled while a lease check of the same member waits for a
// mutex, aborts the process (decision 0021). Endpoints of a member that ends are removed at once all the
// same, by messages of their own.
#pragma once

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <cstdint>
#include <memory>
#include <span>

namespace roboss {

/// Whether a datagram announces that a participant leaves: RTPS 2.2, a DATA submessage of the built-in
/// participant writer that carries no data.
bool announces_leave(std::span<const std::uint8_t> datagram);

/// For DomainParticipantQos::transport(); everything but leaves goes through as it is.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> without_leaves(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> lower);

}  // namespace roboss
