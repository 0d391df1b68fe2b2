// ServiceType: a type of services, as others must know it. A service is a struct with its name and two
// messages, Request and Response. Source: REP 2016; rosidl adds the messages named _Event, by which calls can
// be watched and which nobody here sends; they count in the hash.
#pragma once

#include <string>

#include "ros2_types/type_description.h"

namespace roboss::ros2 {

/// A type of services, as others must know it.
struct ServiceType {
    std::string name,                ///< "std_srvs/srv/Empty"
        hash,                        ///< RIHS01
        request_hash,                ///< of its requests, a type of messages: "std_srvs/srv/Empty_Request"
        reply_hash;                  ///< of its replies: "std_srvs/srv/Empty_Response"
    std::string request_definition,  ///< in the format ros2msg
        reply_definition;            ///< the same
};

/// A service: a struct with its name, as "std_srvs/srv/Empty", and the messages Request and Response.
template <class T>
concept Service = Message<typename T::Request> && Message<typename T::Response> && requires {
    {T::kName};
};

/// The description of a service with these messages.
TypeDescription describe_service(const std::string& name, TypeDescription request, TypeDescription response);

/// The description of a service.
template <Service S>
TypeDescription describe() {
    return describe_service(S::kName, describe<typename S::Request>(), describe<typename S::Response>());
}

/// The type of a service; made once.
template <Service S>
const ServiceType& type_of_service() {
    static const ServiceType type{S::kName,
                                  type_hash(describe<S>()),
                                  type_hash(describe<typename S::Request>()),
                                  type_hash(describe<typename S::Response>()),
                                  definition_text(describe<typename S::Request>()),
                                  definition_text(describe<typename S::Response>())};
    return type;
}

}  // namespace roboss::ros2
