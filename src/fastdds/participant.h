// The participant: this process as others of a domain see it, and the topics that it has.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

#include "fastdds/names.h"
#include "fastdds/peers.h"
#include "fastdds/versions.h"
#include "ros2_types/transport.h"

namespace roboss::fastdds {

/// A Guid of Fast DDS.
Guid to_guid(const rtps::GUID_t& guid);
/// The same as Fast DDS has it.
rtps::GUID_t to_fastdds(const Guid& guid);

/// The settings by which a participant is found and reached. An Error: a host has no address.
Result<dds::DomainParticipantQos> participant_qos(const ros2::TransportOptions& options);

/// See the top of the file. One thread uses it.
class Participant : EndpointListener {
  public:
    /// Joins the domain.
    static Result<std::unique_ptr<Participant>> join(const ros2::TransportOptions& options, Peers& peers);
    ~Participant() override;
    Participant(const Participant&) = delete;
    Participant& operator=(const Participant&) = delete;

    /// A topic, for as long as it is not released as often as used. An Error if it has another type here.
    Result<dds::Topic*> use(const DdsTopic& topic, const std::string& hash);
    /// See use().
    void release(const std::string& topic);
    /// Its name on the wire.
    Guid guid() const { return to_guid(participant_->guid()); }
    dds::DomainParticipant& operator*() { return *participant_; }
    dds::Publisher& publisher() { return *publisher_; }
    dds::Subscriber& subscriber() { return *subscriber_; }
    /// An endpoint here has met one elsewhere, or lost it.
    void count_match() { ++matches_; }
    /// How often that was so.
    std::uint64_t matches() const { return matches_; }

  private:
    struct Use {
        dds::Topic* topic = nullptr;
        int count = 0;
    };

    explicit Participant(Peers& peers) : peers_(peers) {}
    void found(const rtps::GUID_t& guid, std::string topic, std::string type, std::string user_data,
               bool is_writer) override;
    void lost(const rtps::GUID_t& guid) override;
    bool register_type(const std::string& name);

    Peers& peers_;
    std::atomic<std::uint64_t> matches_{0};
    dds::DomainParticipant* participant_ = nullptr;
    dds::Publisher* publisher_ = nullptr;
    dds::Subscriber* subscriber_ = nullptr;
    std::unordered_map<std::string, Use> topics_;
};

}  // namespace roboss::fastdds
