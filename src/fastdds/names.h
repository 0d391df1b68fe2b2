// Names of topics, types and hashes as ROS 2 carries them over DDS (rmw_fastrtps, rmw_cyclonedds).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace roboss::fastdds {

/// Names a participant, reader or writer: 12 bytes of its participant, 4 of its own.
using Guid = std::array<std::uint8_t, 16>;

/// A topic of DDS and its type.
struct DdsTopic {
    std::string name,  ///< "rt/chatter"
        type;          ///< "std_msgs::msg::dds_::String_"
};

/// "/chatter" and "std_msgs/msg/String" as DDS has them.
DdsTopic message_topic(const std::string& topic, const std::string& type);
/// The topic of a service's requests.
DdsTopic request_topic(const std::string& service, const std::string& type);
/// The topic of a service's replies.
DdsTopic reply_topic(const std::string& service, const std::string& type);
/// "/chatter" of "rt/chatter"; names that ROS 2 does not make stay.
std::string ros_topic(const std::string& name);
/// "std_msgs/msg/String" of "std_msgs::msg::dds_::String_"; names that ROS 2 does not make stay.
std::string ros_type(const std::string& type);

/// USER_DATA of a reader or writer, which tells its type's hash.
std::string user_data(const std::string& hash);
/// The hash in USER_DATA; empty: there is none.
std::string hash_in(std::string_view user_data);
/// True of the USER_DATA of services and clients of Cyclone DDS.
bool is_cyclone_service(std::string_view user_data);

}  // namespace roboss::fastdds
