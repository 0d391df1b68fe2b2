// Inbox and Outbox: one DDS reader or writer each, with the quality of service of its topic kind.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <map>
#include <mutex>
#include <vector>

#include "bus/bus.h"
#include "dds/byte_sample.h"
#include "dds/fragments.h"
#include "dds/participant.h"

namespace roboss {

/// Reliable, in order: all messages but heartbeats. Heartbeats are useful only while they are fresh: best
/// effort.
enum class TopicKind { kReliable, kHeartbeats };

/// Lets the threads of the DDS layer wake up the thread of the roles.
class Bell {
  public:
    void ring();
    /// Returns when it has rung since the last call, at the latest after ms_max.
    void wait(std::int64_t ms_max);

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool rung_ = false;
};

class Inbox : private eprosima::fastdds::dds::DataReaderListener {
  public:
    using Writer = eprosima::fastdds::dds::InstanceHandle_t;

    /// nullptr: DDS refused to make it.
    static std::unique_ptr<Inbox> open(Participant& participant, const std::string& topic, TopicKind kind,
                                       Bell& bell);
    ~Inbox() override;

    /// Calls take(writer, message) for every message that is complete.
    template <class Take>
    void drain(Take&& take) {
        while (const std::optional<Writer> writer = next_sample())
            if (auto message = assemblies_[*writer].take(sample_.bytes)) take(*writer, std::move(*message));
    }
    /// Writers that are gone since the last call.
    std::vector<Writer> take_vanished();

  private:
    Inbox(Participant& participant, Bell& bell) : participant_(participant), bell_(bell) {}
    std::optional<Writer> next_sample();
    void on_data_available(eprosima::fastdds::dds::DataReader*) override { bell_.ring(); }
    void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                                 const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override;

    Participant& participant_;
    Bell& bell_;
    eprosima::fastdds::dds::DataReader* reader_ = nullptr;
    ByteSample sample_;
    std::map<Writer, Assembly> assemblies_;
    std::mutex mutex_;
    std::vector<Writer> vanished_;
};

class Outbox : private eprosima::fastdds::dds::DataWriterListener {
  public:
    static std::unique_ptr<Outbox> open(Participant& participant, const std::string& topic, TopicKind kind,
                                        Bell& bell);
    ~Outbox() override;

    /// Fragments the message and sends what the other side can take now. False: it is too long.
    bool send(std::span<const std::uint8_t> message, std::int64_t now_ms);
    /// Sends more. False: some pieces wait until the other side has taken those in flight.
    bool pump(std::int64_t now_ms);
    bool connected() const { return readers_ > 0; }
    std::int64_t opened_ms() const { return opened_ms_; }
    /// No reader and nothing to send for so long.
    bool idle_since(std::int64_t then_ms) const {
        return !connected() && waiting_.empty() && used_ms_ < then_ms;
    }
    bool acknowledged(std::int64_t ms_max);

  private:
    Outbox(Participant& participant, Bell& bell, TopicKind kind)
        : participant_(participant), bell_(bell), kind_(kind) {}
    void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                                const eprosima::fastdds::dds::PublicationMatchedStatus& status) override;
    bool has_room(std::size_t bytes);

    Participant& participant_;
    Bell& bell_;
    TopicKind kind_;
    eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
    std::atomic<int> readers_ = 0;
    bool was_connected_ = false;
    struct Piece {
        std::int64_t sent_ms = 0;
        ByteSample sample;
    };
    std::deque<Piece> waiting_;
    std::size_t under_way_ = 0, under_way_max_ = 0;  // bytes not known to have arrived
    std::uint32_t serial_ = 0;
    std::int64_t opened_ms_ = monotonic_ms(), used_ms_ = 0;
};

}  // namespace roboss
