// A reader and a writer of a topic, whose messages are bytes.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "fastdds/participant.h"

namespace roboss::fastdds {

/// A message as it has arrived.
struct Sample {
    Guid writer{};            ///< of the sender
    std::int64_t number = 0;  ///< at that writer, from 1
    Guid related{};           ///< writer_guid of related_sample_identity; zeros: there is none
    std::string bytes;        ///< CDR
};

/// Sends messages to all who read the topic. One thread uses it.
class Writer : dds::DataWriterListener {
  public:
    /// Makes one. `on_match` is called, in a thread of Fast DDS, when a reader elsewhere appears.
    static Result<std::unique_ptr<Writer>> open(Participant& participant, const DdsTopic& topic,
                                                const std::string& hash, const ros2::Qos& qos,
                                                std::function<void()> on_match = {});
    ~Writer() override;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    Guid guid() const { return to_guid(writer_->guid()); }
    /// Sends a message without blocking. False: there is no memory for it.
    bool send(std::string_view cdr, rtps::WriteParams parameters = {});
    /// Waits until all reliable readers have confirmed all messages.
    bool await_confirmed(std::int64_t ms_max);
    /// Readers elsewhere.
    std::set<Guid> readers() const;
    std::size_t reader_count() const;

  private:
    Writer(Participant& participant, std::string topic, std::function<void()> on_match)
        : participant_(participant), topic_(std::move(topic)), on_match_(std::move(on_match)) {}
    void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override;

    Participant& participant_;
    std::string topic_;
    std::function<void()> on_match_;
    dds::DataWriter* writer_ = nullptr;
    mutable std::mutex mutex_;
    std::set<Guid> readers_;
};

/// Gets the messages of a topic. One thread makes and destroys it.
class Reader : dds::DataReaderListener {
  public:
    /// Makes one. `on_sample` gets each message, in a thread of Fast DDS.
    static Result<std::unique_ptr<Reader>> open(Participant& participant, const DdsTopic& topic,
                                                const std::string& hash, const ros2::Qos& qos,
                                                std::function<void(Sample)> on_sample);
    ~Reader() override;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    Guid guid() const { return to_guid(reader_->guid()); }
    /// The name of its topic in DDS.
    const std::string& topic() const { return topic_; }
    /// Writers elsewhere.
    std::size_t writer_count() const { return writers_; }

  private:
    Reader(Participant& participant, std::string topic, std::function<void(Sample)> on_sample)
        : participant_(participant), topic_(std::move(topic)), on_sample_(std::move(on_sample)) {}
    void on_data_available(dds::DataReader* reader) override;
    void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
        writers_ = static_cast<std::size_t>(std::max(status.current_count, 0));
        participant_.count_match();
    }

    Participant& participant_;
    std::string topic_;
    std::function<void(Sample)> on_sample_;
    dds::DataReader* reader_ = nullptr;
    std::atomic<std::size_t> writers_{0};
};

}  // namespace roboss::fastdds
