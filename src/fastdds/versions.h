// The versions of Fast DDS that RoBOSS is built with: 2.9 (Debian 12) and 3 (Debian 13). All that differs
// between them in names and signatures is here, so that the other files have one text for both.
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#if __has_include(<fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>)
#define ROBOSS_FASTDDS_3 1
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#define ROBOSS_FASTDDS_3 0
#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#endif

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace roboss::fastdds {

namespace dds = eprosima::fastdds::dds;
#if ROBOSS_FASTDDS_3
namespace rtps = eprosima::fastdds::rtps;
using Duration = dds::Duration_t;
#else
namespace rtps = eprosima::fastrtps::rtps;
using Duration = eprosima::fastrtps::Duration_t;
#endif
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;

/// True if a call of Fast DDS did what it should.
template <class Code>
bool is_ok(const Code& code) {
#if ROBOSS_FASTDDS_3
    return code == dds::RETCODE_OK;
#else
    return code == Code::RETCODE_OK;
#endif
}

/// Sends data; false: it was not sent.
inline bool write(dds::DataWriter& writer, void* data, rtps::WriteParams& parameters) {
#if ROBOSS_FASTDDS_3
    return is_ok(writer.write(data, parameters));
#else
    return writer.write(data, parameters);
#endif
}

/// Sets how often a writer asks readers what they lack, while they lack something.
inline void set_heartbeat(dds::DataWriterQos& qos, const Duration& period) {
#if ROBOSS_FASTDDS_3
    qos.reliable_writer_qos().times.heartbeat_period = period;
#else
    qos.reliable_writer_qos().times.heartbeatPeriod = {period.seconds, period.nanosec};
#endif
}

/// Makes a participant the client of a discovery server, the one of this number in the list of servers.
inline void add_discovery_server(dds::DomainParticipantQos& qos, [[maybe_unused]] int number,
                                 const rtps::Locator_t& place) {
    auto& discovery = qos.wire_protocol().builtin.discovery_config;
#if ROBOSS_FASTDDS_3
    discovery.discoveryProtocol = rtps::DiscoveryProtocol::CLIENT;
    discovery.m_DiscoveryServers.push_back(place);
#else
    discovery.discoveryProtocol = rtps::DiscoveryProtocol::CLIENT;
    eprosima::fastdds::rtps::RemoteServerAttributes server;
    eprosima::fastdds::rtps::get_server_client_default_guidPrefix(number, server.guidPrefix);
    server.metatrafficUnicastLocatorList.push_back(place);
    discovery.m_DiscoveryServers.push_back(server);
#endif
}

/// A type of which Fast DDS knows nothing but its name: its data are bytes. `write_bytes` and `read_bytes`
/// turn data into bytes and back.
class NamedType : public dds::TopicDataType {
  public:
    /// `name`: as DDS has it.
    explicit NamedType(const std::string& name);

    /// The bytes of data that are to be sent.
    virtual std::string_view bytes_of(const void* data) const = 0;
    /// Keeps the bytes of data that have arrived. False: it does not.
    virtual bool keep(std::string_view bytes, void* data) const = 0;
    /// New data to keep bytes in.
    virtual void* make() const = 0;
    /// Frees what make() made.
    virtual void free(void* data) const = 0;

#if ROBOSS_FASTDDS_3
    bool serialize(const void* const data, rtps::SerializedPayload_t& payload,
                   dds::DataRepresentationId_t representation) final;
    bool deserialize(rtps::SerializedPayload_t& payload, void* data) final;
    std::uint32_t calculate_serialized_size(const void* const data,
                                            dds::DataRepresentationId_t representation) final;
    void* create_data() final;
    void delete_data(void* data) final;
    bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) final {
        return false;
    }
    bool compute_key(const void* const, rtps::InstanceHandle_t&, bool) final {
        return false;
    }
#else
    bool serialize(void* data, rtps::SerializedPayload_t* payload) final;
    bool deserialize(rtps::SerializedPayload_t* payload, void* data) final;
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) final;
    void* createData() final;
    void deleteData(void* data) final;
    bool getKey(void*, rtps::InstanceHandle_t*, bool) final {
        return false;
    }
#endif
};

/// Hears of the readers and writers of others.
class EndpointListener : public dds::DomainParticipantListener {
  public:
    /// A reader or writer was found, or has changed.
    virtual void found(const rtps::GUID_t& guid, std::string topic, std::string type, std::string user_data,
                       bool is_writer) = 0;
    /// It is gone.
    virtual void lost(const rtps::GUID_t& guid) = 0;

#if ROBOSS_FASTDDS_3
    void on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus reason,
                                  const rtps::PublicationBuiltinTopicData& info, bool& ignored) final;
    void on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason,
                                  const rtps::SubscriptionBuiltinTopicData& info, bool& ignored) final;
#else
    void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) final;
    void on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) final;
#endif
};

}  // namespace roboss::fastdds
