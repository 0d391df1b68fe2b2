#include "fastdds/versions.h"

#include <cstring>

namespace roboss::fastdds {
namespace {

constexpr std::uint32_t kFirstSize = 64;  // bytes that a payload has at first; it grows

bool write_payload(std::string_view bytes, rtps::SerializedPayload_t& payload) {
    if (bytes.size() > payload.max_size) return false;
    std::memcpy(payload.data, bytes.data(), bytes.size());
    payload.encapsulation = CDR_LE;
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return true;
}

std::string_view bytes_of_payload(const rtps::SerializedPayload_t& payload) {
    return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class UserData>
std::string text_of(const UserData& data) {
    return {data.data_vec().begin(), data.data_vec().end()};
}

}  // namespace

#if ROBOSS_FASTDDS_3

NamedType::NamedType(const std::string& name) {
    set_name(name);
    max_serialized_type_size = kFirstSize;
}

bool NamedType::serialize(const void* const data, rtps::SerializedPayload_t& payload,
                          dds::DataRepresentationId_t) {
    return write_payload(bytes_of(data), payload);
}

bool NamedType::deserialize(rtps::SerializedPayload_t& payload, void* data) {
    return keep(bytes_of_payload(payload), data);
}

std::uint32_t NamedType::calculate_serialized_size(const void* const data, dds::DataRepresentationId_t) {
    return static_cast<std::uint32_t>(bytes_of(data).size());
}

void* NamedType::create_data() {
    return make();
}

void NamedType::delete_data(void* data) {
    free(data);
}

void EndpointListener::on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus reason,
                                                const rtps::PublicationBuiltinTopicData& info, bool&) {
    if (reason == rtps::WriterDiscoveryStatus::REMOVED_WRITER)
        lost(info.guid);
    else
        found(info.guid, info.topic_name.to_string(), info.type_name.to_string(), text_of(info.user_data),
              true);
}

void EndpointListener::on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason,
                                                const rtps::SubscriptionBuiltinTopicData& info, bool&) {
    if (reason == rtps::ReaderDiscoveryStatus::REMOVED_READER)
        lost(info.guid);
    else
        found(info.guid, info.topic_name.to_string(), info.type_name.to_string(), text_of(info.user_data),
              false);
}

#else

NamedType::NamedType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kFirstSize;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
}

bool NamedType::serialize(void* data, rtps::SerializedPayload_t* payload) {
    return write_payload(bytes_of(data), *payload);
}

bool NamedType::deserialize(rtps::SerializedPayload_t* payload, void* data) {
    return keep(bytes_of_payload(*payload), data);
}

std::function<std::uint32_t()> NamedType::getSerializedSizeProvider(void* data) {
    return [this, data] { return static_cast<std::uint32_t>(bytes_of(data).size()); };
}

void* NamedType::createData() {
    return make();
}

void NamedType::deleteData(void* data) {
    free(data);
}

void EndpointListener::on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) {
    if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER)
        lost(info.info.guid());
    else
        found(info.info.guid(), info.info.topicName().to_string(), info.info.typeName().to_string(),
              text_of(info.info.m_qos.m_userData), true);
}

void EndpointListener::on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
    if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER)
        lost(info.info.guid());
    else
        found(info.info.guid(), info.info.topicName().to_string(), info.info.typeName().to_string(),
              text_of(info.info.m_qos.m_userData), false);
}

#endif

}  // namespace roboss::fastdds
