// See service_type.h.
#include "ros2_types/service_type.h"

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

namespace {

/// service_msgs/msg/ServiceEventInfo: only its description is needed.
struct ServiceEventInfo {
    static constexpr const char* kName = "service_msgs/msg/ServiceEventInfo";
    std::uint8_t event_type = 0;
    Time stamp;
    std::array<std::uint8_t, 16> client_gid{};
    std::int64_t sequence_number = 0;

    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("event_type", m.event_type);
        visit("stamp", m.stamp);
        visit("client_gid", m.client_gid);
        visit("sequence_number", m.sequence_number);
    }
};

FieldDescription nested(const char* name, const std::string& type, std::uint8_t container,
                        std::uint64_t capacity) {
    return {name, kNested, container, capacity, type};
}

}  // namespace

TypeDescription describe_service(const std::string& name, TypeDescription request, TypeDescription response) {
    TypeDescription event{
        name + "_Event",
        {nested("info", ServiceEventInfo::kName, kSingle, 0), nested("request", request.name, kBounded, 1),
         nested("response", response.name, kBounded, 1)},
        {},
        {}};
    TypeDescription service{name,
                            {nested("request_message", request.name, kSingle, 0),
                             nested("response_message", response.name, kSingle, 0),
                             nested("event_message", event.name, kSingle, 0)},
                            {},
                            {}};
    add_nested(service, describe<ServiceEventInfo>());
    add_nested(service, std::move(event));
    add_nested(service, std::move(request));
    add_nested(service, std::move(response));
    return service;
}

}  // namespace roboss::ros2
