// The DDS participant of a process: which network it is on, how it finds others, when it counts as gone; and
// the topics it knows.
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "core/result.h"
#include "dds/dds_options.h"

namespace roboss {

class Participant : private eprosima::fastdds::dds::DomainParticipantListener {
  public:
    static Result<std::unique_ptr<Participant>> create(const DdsOptions& options);
    /// The interface is up and all who are named can be found, now: both may change while a process runs.
    static Result<> possible(const DdsOptions& options);
    ~Participant() override;

    eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
    eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }
    /// Made on first use.
    eprosima::fastdds::dds::Topic* topic(const std::string& name);
    /// Somebody else reads this topic.
    bool read_elsewhere(const std::string& topic) const;

  private:
    Participant() = default;
    void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                 eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;

    eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
    eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
    eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
    std::map<std::string, eprosima::fastdds::dds::Topic*> topics_;
    mutable std::mutex mutex_;
    std::map<std::string, std::set<eprosima::fastrtps::rtps::GUID_t>> readers_;  // of other participants
};

}  // namespace roboss
