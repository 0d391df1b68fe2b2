// Qualities of service: decision 0009 says why each is as it is.
#include "dds/endpoints.h"

#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <algorithm>
#include <chrono>

#include "dds/network.h"

namespace roboss {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using ReturnCode_t = eprosima::fastrtps::types::ReturnCode_t;

namespace {

constexpr std::int64_t kUnreadFor_ms = 2'000;  // messages unread for so long will be requested again
constexpr std::int32_t kReliableUnderWay = 4'096;
constexpr std::int32_t kHeartbeatsKept = 256;

eprosima::fastrtps::Duration_t from_ms(std::uint32_t ms) {
    return {static_cast<std::int32_t>(ms / 1000), ms % 1000 * 1'000'000};
}

template <class Qos>
void set_common(Qos& qos, TopicKind kind) {
    const bool words = kind == TopicKind::kReliable;
    qos.reliability().kind = words ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.reliability().max_blocking_time = {0, 0};
    qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = words ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = words ? 1 : kHeartbeatsKept;
    qos.resource_limits().max_samples = words ? kReliableUnderWay : kHeartbeatsKept;
    qos.resource_limits().max_instances = 1;
    qos.resource_limits().max_samples_per_instance = qos.resource_limits().max_samples;
    qos.resource_limits().allocated_samples = 16;
    qos.data_sharing().off();
    qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
}

}  // namespace

void Bell::ring() {
    {
        const std::lock_guard lock(mutex_);
        rung_ = true;
    }
    changed_.notify_one();
}

void Bell::wait(std::int64_t ms_max) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(ms_max), [this] { return rung_; });
    rung_ = false;
}

std::unique_ptr<Inbox> Inbox::open(Participant& participant, const std::string& topic, TopicKind kind,
                                   Bell& bell) {
    dds::DataReaderQos qos;
    set_common(qos, kind);
    qos.reliable_reader_qos().times.heartbeatResponseDelay = {0, 1'000'000};
    std::unique_ptr<Inbox> inbox(new Inbox(participant, bell));
    const auto wanted = dds::StatusMask::data_available()
                        << dds::StatusMask::liveliness_changed() << dds::StatusMask::subscription_matched();
    inbox->reader_ =
        participant.subscriber().create_datareader(participant.topic(topic), qos, inbox.get(), wanted);
    return inbox->reader_ == nullptr ? nullptr : std::move(inbox);
}

Inbox::~Inbox() {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    participant_.subscriber().delete_datareader(reader_);
}

std::optional<Inbox::Writer> Inbox::next_sample() {
    dds::SampleInfo info;
    while (reader_->take_next_sample(&sample_, &info) == ReturnCode_t::RETCODE_OK)
        if (info.valid_data) return info.publication_handle;
    return std::nullopt;
}

void Inbox::on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) {
    if (status.current_count_change >= 0) return;
    {
        const std::lock_guard lock(mutex_);
        vanished_.push_back(status.last_publication_handle);
    }
    bell_.ring();
}

std::vector<Inbox::Writer> Inbox::take_vanished() {
    std::vector<Writer> result;
    {
        const std::lock_guard lock(mutex_);
        result.swap(vanished_);
    }
    return result;
}

std::unique_ptr<Outbox> Outbox::open(Participant& participant, const std::string& topic, TopicKind kind,
                                     Bell& bell) {
    dds::DataWriterQos qos;
    set_common(qos, kind);
    qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
    qos.reliable_writer_qos().times.heartbeatPeriod = {0, 20'000'000};
    qos.reliable_writer_qos().times.nackResponseDelay = {0, 1'000'000};
    std::unique_ptr<Outbox> outbox(new Outbox(participant, bell, kind));
    const std::uint32_t buffer = socket_buffer_max();
    outbox->under_way_max_ = std::clamp<std::size_t>(buffer / 2, kPieceBytesMax + 1, 1u << 20);
    outbox->writer_ = participant.publisher().create_datawriter(participant.topic(topic), qos, outbox.get(),
                                                                dds::StatusMask::publication_matched());
    return outbox->writer_ == nullptr ? nullptr : std::move(outbox);
}

Outbox::~Outbox() {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    participant_.publisher().delete_datawriter(writer_);
}

void Outbox::on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) {
    readers_ = status.current_count;
    bell_.ring();
}

bool Outbox::send(std::span<const std::uint8_t> message, std::int64_t now_ms) {
    used_ms_ = now_ms;
    auto pieces = cut_in_pieces(++serial_, message);
    for (auto& piece : pieces) waiting_.push_back({now_ms, {std::move(piece)}});
    pump(now_ms);
    return !pieces.empty();
}

/// A burst that does not fit into the receiver's socket is lost except for its beginning, so the bytes in
/// flight are limited.
bool Outbox::has_room(std::size_t bytes) {
    if (kind_ == TopicKind::kHeartbeats || under_way_ + bytes <= under_way_max_) return true;
    if (!acknowledged(0)) return false;
    under_way_ = 0;
    return true;
}

bool Outbox::pump(std::int64_t now_ms) {
    const bool here = connected();
    if (was_connected_ && !here)
        waiting_.clear();  // the next process at this address has not got the beginning
    was_connected_ = here;
    if (!here) {
        while (!waiting_.empty() && waiting_.front().sent_ms + kUnreadFor_ms < now_ms) waiting_.pop_front();
        return true;  // nothing to do until there is a reader
    }
    while (!waiting_.empty()) {
        ByteSample& sample = waiting_.front().sample;
        if (!has_room(sample.bytes.size()) || !writer_->write(&sample)) return false;
        under_way_ += sample.bytes.size();
        waiting_.pop_front();
    }
    return true;
}

bool Outbox::acknowledged(std::int64_t ms_max) {
    return writer_->wait_for_acknowledgments(from_ms(static_cast<std::uint32_t>(ms_max))) ==
           ReturnCode_t::RETCODE_OK;
}

}  // namespace roboss
