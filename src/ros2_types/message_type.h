// MessageType: a type of messages, as others must know it.
#pragma once

#include <string>

#include "ros2_types/type_description.h"

namespace roboss::ros2 {

/// A type of messages, as others must know it.
struct MessageType {
    std::string name,  ///< "sensor_msgs/msg/LaserScan"
        hash,          ///< RIHS01
        definition;    ///< in the format ros2msg
};

/// The type of a message; made once.
template <Message M>
const MessageType& type_of() {
    static const MessageType type = [] {
        const TypeDescription described = describe<M>();
        return MessageType{described.name, type_hash(described), definition_text(described)};
    }();
    return type;
}

}  // namespace roboss::ros2
