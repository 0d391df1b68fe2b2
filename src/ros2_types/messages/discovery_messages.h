// rmw_dds_common: how a participant tells others which of its readers and writers belong to which node. A gid
// names a participant, reader or writer; it has 16 bytes since Iron, 24 in Humble. Names of nodes are bounded
// by 256 characters, which TypeDescription does not have: the hash is the published one, of 16 bytes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace roboss::ros2 {

/// rmw_dds_common/msg/Gid
template <std::size_t size>
struct Gid {
    static constexpr const char* kName = "rmw_dds_common/msg/Gid";
    std::array<std::uint8_t, size> data{};  ///< a GUID of DDS, then zeros

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("data", m.data);
    }
};

/// rmw_dds_common/msg/NodeEntitiesInfo
template <std::size_t size>
struct NodeEntitiesInfo {
    static constexpr const char* kName = "rmw_dds_common/msg/NodeEntitiesInfo";
    std::string node_namespace;             ///< "/" or "/car_3"
    std::string node_name;                  ///< "driver"
    std::vector<Gid<size>> reader_gid_seq,  ///< of its subscriptions, services and clients
        writer_gid_seq;                     ///< of its publishers, services and clients

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("node_namespace", m.node_namespace);
        visit("node_name", m.node_name);
        visit("reader_gid_seq", m.reader_gid_seq);
        visit("writer_gid_seq", m.writer_gid_seq);
    }
};

/// rmw_dds_common/msg/ParticipantEntitiesInfo
template <std::size_t size>
struct ParticipantEntitiesInfo {
    static constexpr const char* kName = "rmw_dds_common/msg/ParticipantEntitiesInfo";
    static constexpr const char* kHash =
        "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e";
    Gid<size> gid;                                               ///< of the participant
    std::vector<NodeEntitiesInfo<size>> node_entities_info_seq;  ///< all that it has

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("gid", m.gid);
        visit("node_entities_info_seq", m.node_entities_info_seq);
    }
};

}  // namespace roboss::ros2
