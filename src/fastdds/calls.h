// Calls: requests to a service and the form of their replies. Middlewares tell in three dialects to which
// request a reply belongs:
// - rmw_fastrtps names the client's reader of replies in related_sample_identity;
// - Cyclone DDS puts 16 bytes before the fields of request and reply: the client, and a number;
// - plain DDS-RPC repeats the request's identity (its writer and number) in the reply.
// Sources: rmw_fastrtps, rmw_cyclonedds, OMG DDS-RPC 7.6.2.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "fastdds/names.h"
#include "ros2_types/transport.h"

namespace roboss::fastdds {

/// Values of CallId::dialect.
enum class Dialect : std::uint8_t { kNamesReader = 1, kHeader = 2, kPlain = 3 };

/// A request as it has arrived.
struct Arrival {
    Guid writer{};            ///< of the client
    std::int64_t number = 0;  ///< of the request, at that writer
    Guid reader{};            ///< of the client's replies; zeros: the request names none
    std::string bytes;        ///< CDR, in the client's dialect
    bool is_cyclone = false;  ///< discovery says that the client is one of Cyclone DDS
};

/// A reply as it is to be sent.
struct Reply {
    Guid related{};           ///< related_sample_identity
    std::int64_t number = 0;  ///< the same
    std::string bytes;        ///< CDR, in the client's dialect
    Guid reader{};            ///< of the client; if only its participant is known, the last 4 bytes are zeros
};

/// The calls of a service. Safe to use from many threads.
class Calls {
  public:
    /// The call, with the bytes of the request alone. Nothing: these bytes are no request.
    std::optional<ros2::Incoming> open(Arrival arrival);
    /// The reply to a call. Nothing: there was no such call.
    std::optional<Reply> close(const ros2::CallId& call, std::string_view cdr);

  private:
    // A header of Cyclone DDS holds the client in 8 bytes; CallId has the number.
    struct Header {
        ros2::CallId call;
        std::string client;
    };

    std::mutex mutex_;
    std::deque<Header> headers_;
};

/// True if a reply's reader is one of these.
bool has_reader(const std::set<Guid>& readers, const Reply& reply);

}  // namespace roboss::fastdds
