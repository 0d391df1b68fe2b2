#include "fastdds/participant.h"

#include <algorithm>
#include <utility>

#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include "fastdds/bytes_type.h"

namespace roboss::fastdds {

Guid to_guid(const rtps::GUID_t& guid) {
    Guid bytes;
    std::copy_n(guid.guidPrefix.value, 12, bytes.begin());
    std::copy_n(guid.entityId.value, 4, bytes.begin() + 12);
    return bytes;
}

rtps::GUID_t to_fastdds(const Guid& guid) {
    rtps::GUID_t bytes;
    std::copy_n(guid.begin(), 12, bytes.guidPrefix.value);
    std::copy_n(guid.begin() + 12, 4, bytes.entityId.value);
    return bytes;
}

Result<std::unique_ptr<Participant>> Participant::join(const ros2::TransportOptions& options, Peers& peers) {
    const Result<dds::DomainParticipantQos> qos = participant_qos(options);
    if (!qos) return qos.error();
    std::unique_ptr<Participant> joined(new Participant(peers));
    auto* const factory = dds::DomainParticipantFactory::get_instance();
    joined->participant_ =
        factory->create_participant(options.domain, qos.value(), joined.get(), dds::StatusMask::none());
    if (joined->participant_ != nullptr) {
        joined->publisher_ = joined->participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
        joined->subscriber_ = joined->participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
    }
    if (joined->publisher_ == nullptr || joined->subscriber_ == nullptr)
        return Error{
            "Fast DDS cannot join domain " + std::to_string(options.domain),
            "domains are 0 to 232; are there more than 100 participants on this host, or no network?",
            "no-domain"};
    return joined;
}

Participant::~Participant() {
    if (participant_ == nullptr) return;
    participant_->delete_contained_entities();
    participant_->set_listener(nullptr);
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

Result<dds::Topic*> Participant::use(const DdsTopic& topic, const std::string& hash) {
    Use& use = topics_[topic.name];
    if (use.topic == nullptr && register_type(topic.type))
        use.topic = participant_->create_topic(topic.name, topic.type, dds::TOPIC_QOS_DEFAULT);
    if (use.topic == nullptr) {
        topics_.erase(topic.name);
        return Error{"Fast DDS refuses the topic " + topic.name + " of type " + topic.type,
                     "choose another name", "bad-topic"};
    }
    if (use.topic->get_type_name() != topic.type)
        return Error{"the topic " + ros_topic(topic.name) + " has the type " +
                         ros_type(use.topic->get_type_name()) + " here already, not " + ros_type(topic.type),
                     "give one of the two another name", "other-type"};
    ++use.count;
    peers_.add_own(topic, hash);
    return use.topic;
}

void Participant::release(const std::string& topic) {
    const auto at = topics_.find(topic);
    if (at == topics_.end()) return;
    peers_.remove_own(topic);
    if (--at->second.count > 0) return;
    participant_->delete_topic(at->second.topic);
    topics_.erase(at);
}

bool Participant::register_type(const std::string& name) {
    if (!participant_->find_type(name).empty()) return true;
    const dds::TypeSupport type(new BytesType(name));
    return is_ok(type.register_type(participant_));
}

void Participant::found(const rtps::GUID_t& guid, std::string topic, std::string type, std::string user_data,
                        bool is_writer) {
    try {
        peers_.found(to_guid(guid), {{std::move(topic), std::move(type)},
                                     hash_in(user_data),
                                     is_cyclone_service(user_data),
                                     is_writer});
    } catch (const std::exception&) {  // no memory: then its type is not known
    }
}

void Participant::lost(const rtps::GUID_t& guid) {
    peers_.lost(to_guid(guid));
}

}  // namespace roboss::fastdds
