// The end of a service in this process: a reader of requests and a writer of replies.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "fastdds/calls.h"
#include "fastdds/endpoints.h"
#include "fastdds/inbox.h"
#include "fastdds/notices.h"

namespace roboss::fastdds {

/// One thread uses it.
class ServiceEnd {
  public:
    /// The parts that it works with.
    struct Parts {
        Participant& participant;
        Peers& peers;
        Inbox& inbox;  ///< gets the requests
        Notices& notices;
    };

    /// Makes one.
    static Result<std::unique_ptr<ServiceEnd>> open(const Parts& parts, ros2::EntityId entity,
                                                    const std::string& name, const ros2::ServiceType& type);

    Guid reader() const { return requests_->guid(); }
    Guid writer() const { return replies_->guid(); }
    /// Sends a reply, as soon as its client reads replies.
    void reply(const ros2::CallId& call, std::string_view cdr);
    /// Sends replies whose clients read by now; those that have waited for seconds are dropped.
    void send_waiting();

  private:
    struct Waiting {
        Reply reply;
        std::int64_t until_ms = 0;
    };

    ServiceEnd(const Parts& parts, ros2::EntityId entity, std::string name)
        : parts_(parts), entity_(entity), name_(std::move(name)) {}
    void take_request(Sample sample);
    bool send(const Reply& reply);

    Parts parts_;
    ros2::EntityId entity_;
    std::string name_;
    Calls calls_;
    std::deque<Waiting> waiting_;
    std::unique_ptr<Writer> replies_;  // before the reader: a request may come at once
    std::unique_ptr<Reader> requests_;
};

}  // namespace roboss::fastdds
