// Services of std_srvs. A service is a struct with its name and two messages, Request and Response; its type
// hash follows from them (service_type.h).
#pragma once

#include "ros2_types/field_types.h"

namespace roboss::ros2::std_srvs {

/// std_srvs/srv/Empty
struct Empty {
    static constexpr const char* kName = "std_srvs/srv/Empty";
    /// The call.
    struct Request {
        static constexpr const char* kName = "std_srvs/srv/Empty_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "std_srvs/srv/Empty_Response";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
};

/// std_srvs/srv/Trigger
struct Trigger {
    static constexpr const char* kName = "std_srvs/srv/Trigger";
    /// The call.
    struct Request {
        static constexpr const char* kName = "std_srvs/srv/Trigger_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "std_srvs/srv/Trigger_Response";
        bool success = false;  ///< it was done
        std::string message;   ///< for people

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
            visit("message", m.message);
        }
    };
};

/// std_srvs/srv/SetBool
struct SetBool {
    static constexpr const char* kName = "std_srvs/srv/SetBool";
    /// The call.
    struct Request {
        static constexpr const char* kName = "std_srvs/srv/SetBool_Request";
        bool data = false;  ///< on or off

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("data", m.data);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "std_srvs/srv/SetBool_Response";
        bool success = false;  ///< it was done
        std::string message;   ///< for people

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
            visit("message", m.message);
        }
    };
};

}  // namespace roboss::ros2::std_srvs
