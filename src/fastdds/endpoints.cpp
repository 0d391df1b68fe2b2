#include "fastdds/endpoints.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

namespace roboss::fastdds {
namespace {

const Duration kHeartbeat{0, 100'000'000};

// The common part of readers and writers.
template <class EndpointQos>
void set_qos(EndpointQos& to, const ros2::Qos& qos, const std::string& hash) {
    to.reliability().kind =
        qos.is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    to.durability().kind =
        qos.is_latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
    const std::int32_t depth = static_cast<std::int32_t>(std::clamp(qos.depth, 1u, 1'000'000u));
    to.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    to.history().depth = depth;
    to.resource_limits().allocated_samples = 0;
    to.resource_limits().max_samples = std::max(5000, depth);
    to.resource_limits().max_samples_per_instance = std::max(400, depth);
    to.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    to.data_sharing().off();
    const std::string data = user_data(hash);
    to.user_data().data_vec({data.begin(), data.end()});
}

Error refused(const DdsTopic& topic) {
    return {"Fast DDS cannot make a reader or writer of " + ros_topic(topic.name),
            "is there memory left? fewer topics may help", "bad-topic"};
}

}  // namespace

Result<std::unique_ptr<Writer>> Writer::open(Participant& participant, const DdsTopic& topic,
                                             const std::string& hash, const ros2::Qos& qos,
                                             std::function<void()> on_match) {
    const Result<dds::Topic*> used = participant.use(topic, hash);
    if (!used) return used.error();
    std::unique_ptr<Writer> made(new Writer(participant, topic.name, std::move(on_match)));
    dds::DataWriterQos wanted = dds::DATAWRITER_QOS_DEFAULT;
    set_qos(wanted, qos, hash);
    set_heartbeat(wanted, kHeartbeat);
    // A thread of Fast DDS sends, so that a large message does not block the caller.
    wanted.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    made->writer_ = participant.publisher().create_datawriter(used.value(), wanted, made.get(),
                                                              dds::StatusMask::publication_matched());
    if (made->writer_ == nullptr) return refused(topic);
    return made;
}

Writer::~Writer() {
    if (writer_ != nullptr) {
        writer_->set_listener(nullptr);
        participant_.publisher().delete_datawriter(writer_);
    }
    participant_.release(topic_);
}

bool Writer::send(std::string_view cdr, rtps::WriteParams parameters) {
    return write(*writer_, &cdr, parameters);
}

bool Writer::await_confirmed(std::int64_t ms_max) {
    const Duration wait{static_cast<std::int32_t>(ms_max / 1000),
                        static_cast<std::uint32_t>(ms_max % 1000 * 1'000'000)};
    return is_ok(writer_->wait_for_acknowledgments(wait));
}

std::set<Guid> Writer::readers() const {
    const std::lock_guard lock(mutex_);
    return readers_;
}

std::size_t Writer::reader_count() const {
    const std::lock_guard lock(mutex_);
    return readers_.size();
}

void Writer::on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) {
    try {
        const Guid reader = to_guid(rtps::iHandle2GUID(status.last_subscription_handle));
        {
            const std::lock_guard lock(mutex_);
            if (status.current_count_change > 0)
                readers_.insert(reader);
            else
                readers_.erase(reader);
        }
        participant_.count_match();
        if (on_match_ && status.current_count_change > 0) on_match_();
    } catch (const std::exception&) {  // no memory: the reader does not count
    }
}

Result<std::unique_ptr<Reader>> Reader::open(Participant& participant, const DdsTopic& topic,
                                             const std::string& hash, const ros2::Qos& qos,
                                             std::function<void(Sample)> on_sample) {
    const Result<dds::Topic*> used = participant.use(topic, hash);
    if (!used) return used.error();
    std::unique_ptr<Reader> made(new Reader(participant, topic.name, std::move(on_sample)));
    dds::DataReaderQos wanted = dds::DATAREADER_QOS_DEFAULT;
    set_qos(wanted, qos, hash);
    made->reader_ = participant.subscriber().create_datareader(
        used.value(), wanted, made.get(),
        dds::StatusMask::data_available() << dds::StatusMask::subscription_matched());
    if (made->reader_ == nullptr) return refused(topic);
    return made;
}

Reader::~Reader() {
    if (reader_ != nullptr) {
        reader_->set_listener(nullptr);
        participant_.subscriber().delete_datareader(reader_);
    }
    participant_.release(topic_);
}

void Reader::on_data_available(dds::DataReader* reader) {
    try {
        Sample sample;
        dds::SampleInfo info;
        while (is_ok(reader->take_next_sample(&sample.bytes, &info))) {
            if (!info.valid_data) continue;
            sample.writer = to_guid(info.sample_identity.writer_guid());
            sample.number = static_cast<std::int64_t>(info.sample_identity.sequence_number().to64long());
            sample.related = to_guid(info.related_sample_identity.writer_guid());
            on_sample_(std::exchange(sample, {}));
        }
    } catch (const std::exception&) {  // no memory: the message is lost
    }
}

}  // namespace roboss::fastdds
