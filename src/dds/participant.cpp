// UDP only: segments of shared memory outlive a killed process, by gigabytes, and slow down its return.
#include "dds/participant.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <random>

#include "dds/byte_sample.h"
#include "dds/fragments.h"
#include "dds/leave_filter.h"
#include "dds/network.h"

namespace roboss {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::uint32_t kSocketBuffer = 4u << 20;
constexpr std::uint32_t kLeaseByServer_ms = 10'000;
constexpr std::uint32_t kAnnouncementsPerLease = 3;
constexpr std::uint32_t kPortsTried = 1'000;

eprosima::fastrtps::Duration_t from_ms(std::uint32_t ms) {
    return {static_cast<std::int32_t>(ms / 1000), ms % 1000 * 1'000'000};
}

/// Fast DDS would make it of address, process id and a counter, in all of which two containers can agree.
rtps::GuidPrefix_t new_prefix() {
    std::random_device device;
    rtps::GuidPrefix_t prefix;
    for (rtps::octet& part : prefix.value) part = static_cast<rtps::octet>(device());
    prefix.value[0] = 0x01;  // eProsima's
    prefix.value[1] = 0x0F;
    return prefix;
}

rtps::Locator_t locator(const HostPort& at) {
    rtps::Locator_t result;
    result.kind = LOCATOR_KIND_UDPv4;
    rtps::IPLocator::setIPv4(result, at.address);
    result.port = at.port;
    return result;
}

/// Where the participants of a domain announce themselves (RTPS 2.2, 9.6.1).
HostPort multicast_group(const DdsOptions& options) {
    return {"239.255.0.1", static_cast<std::uint16_t>(7400 + 250 * options.domain)};
}

std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport(const DdsOptions& options,
                                                                                 const std::string& address) {
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {address};
    // Fast DDS uses loopback for members of the same computer, and so does a discovery server that does not
    // know our interface.
    if (!options.discovery_server.empty() && address != kLoopback)
        udp->interfaceWhiteList.emplace_back(kLoopback);
    const std::uint32_t possible = socket_buffer_max();
    udp->receiveBufferSize = possible > 0 ? std::min(kSocketBuffer, possible) : kSocketBuffer;
    udp->sendBufferSize = udp->receiveBufferSize;
    udp->maxInitialPeersRange = options.peer_range;
    // Only a discovery server announces that a member has left; leases of members are not checked.
    if (!options.discovery_server.empty()) return udp;
    return without_leaves(udp);
}

Result<> set_discovery(const DdsOptions& options, const std::string& address,
                       rtps::BuiltinAttributes& builtin) {
    // A discovery server forwards announcements with delay: the loss of members found through it is noticed
    // by missing heartbeats only (ControllerOptions::loss_ms).
    const std::uint32_t lease_ms = options.discovery_server.empty()
                                       ? options.liveliness_ms
                                       : std::max(options.liveliness_ms, kLeaseByServer_ms);
    builtin.discovery_config.leaseDuration = from_ms(lease_ms);
    builtin.discovery_config.leaseDuration_announcementperiod =
        from_ms(std::max(lease_ms / kAnnouncementsPerLease, 1u));
    // The liveliness of single writers is of no use: in Fast DDS 2.9 any living participant keeps the
    // AUTOMATIC writers of all others alive (issue 4373 there).
    builtin.use_WriterLivelinessProtocol = false;
    // Members of one computer take the next free ports, one after the other.
    builtin.mutation_tries = kPortsTried;
    builtin.discovery_config.initial_announcements.count = 20;
    builtin.discovery_config.initial_announcements.period = {0, 50'000'000};
    if (!options.discovery_server.empty()) {
        Result<HostPort> server = host_port(options.discovery_server);
        if (!server) return server.error();
        if (server.value().port == 0)
            return Error{"the discovery server '" + options.discovery_server + "' has no port",
                         "write HOST:PORT"};
        builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::SUPER_CLIENT;
        rtps::RemoteServerAttributes remote;
        remote.ReadguidPrefix("44.53.00.5f.45.50.52.4f.53.49.4d.41");  // that of `fastdds discovery -i 0`
        remote.metatrafficUnicastLocatorList.push_back(locator(server.value()));
        builtin.discovery_config.m_DiscoveryServers.push_back(remote);
        builtin.discovery_config.discoveryServer_client_syncperiod = {0, 100'000'000};
        return Ok{};
    }
    // Naming where it listens switches the default off, multicast included.
    if (!options.multicast || options.port != 0)
        builtin.metatrafficUnicastLocatorList.push_back(locator({address, options.port}));
    if (options.multicast && options.port != 0)
        builtin.metatrafficMulticastLocatorList.push_back(locator(multicast_group(options)));
    for (const std::string& peer : options.peers) {
        Result<HostPort> at = host_port(peer);
        if (!at) return at.error();
        builtin.initialPeersList.push_back(locator(at.value()));
    }
    if (!options.peers.empty() && options.multicast)
        builtin.initialPeersList.push_back(locator(multicast_group(options)));
    return Ok{};
}

Result<> check(const DdsOptions& options) {
    if (options.domain > 232)
        return Error{"the DDS domain " + std::to_string(options.domain) + " is not in 0 to 232",
                     "give another"};
    const std::string& name = options.simulation;
    const bool plain =
        !name.empty() && name.size() <= 100 && std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                   c == '_' || c == '.';
        });
    if (!plain)
        return Error{"'" + name + "' cannot be the name of a simulation",
                     "give 1 to 100 letters, digits, '-', '_' or '.'"};
    return Ok{};
}

}  // namespace

Result<std::unique_ptr<Participant>> Participant::create(const DdsOptions& options) {
    if (Result<> fine = check(options); !fine) return fine.error();
    Result<std::string> address = interface_address(options.interface);
    if (!address) return address.error();
    dds::DomainParticipantQos qos;
    qos.name("roboss/" + options.simulation);
    qos.wire_protocol().prefix = new_prefix();
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(transport(options, address.value()));
    if (Result<> fine = set_discovery(options, address.value(), qos.wire_protocol().builtin); !fine)
        return fine.error();
    // Two members within one process (a test) talk like two processes.
    eprosima::fastrtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);

    std::unique_ptr<Participant> result(new Participant);
    const Error failed{
        "DDS could not start on interface " + options.interface + " (" + address.value() + "), domain " +
            std::to_string(options.domain),
        "see whether its UDP ports from " + std::to_string(7400 + 250 * options.domain) + " are free"};
    // Nothing but discoveries: data and liveliness are for the readers' and writers' own listeners.
    result->participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        options.domain, qos, result.get(), dds::StatusMask::none());
    if (result->participant_ == nullptr) return failed;
    dds::TypeSupport(new ByteSampleType).register_type(result->participant_);
    result->publisher_ = result->participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    result->subscriber_ = result->participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
    if (result->publisher_ == nullptr || result->subscriber_ == nullptr) return failed;
    return result;
}

Result<> Participant::possible(const DdsOptions& options) {
    const Result<std::string> address = interface_address(options.interface);
    if (!address) return address.error();
    rtps::BuiltinAttributes unused;
    return set_discovery(options, address.value(), unused);
}

Participant::~Participant() {
    if (participant_ == nullptr) return;
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Participant::topic(const std::string& name) {
    dds::Topic*& topic = topics_[name];
    if (topic == nullptr)
        topic = participant_->create_topic(name, "roboss::ByteSample", dds::TOPIC_QOS_DEFAULT);
    return topic;
}

bool Participant::read_elsewhere(const std::string& topic) const {
    const std::lock_guard lock(mutex_);
    const auto found = readers_.find(topic);
    return found != readers_.end() && !found->second.empty();
}

void Participant::on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
    const std::string topic = info.info.topicName().to_string();
    const rtps::GUID_t& reader = info.info.guid();
    if (participant_ != nullptr && reader.guidPrefix == participant_->guid().guidPrefix) return;
    const std::lock_guard lock(mutex_);
    if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER)
        readers_[topic].erase(reader);
    else if (info.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER)
        readers_[topic].insert(reader);
}

}  // namespace roboss
