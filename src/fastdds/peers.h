// Peers: readers and writers of others, and what types they have. Warns of those that have another type than
// this process: they match by name alone, so messages would be misread or never arrive.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>

#include "fastdds/names.h"
#include "fastdds/notices.h"

namespace roboss::fastdds {

/// A reader or writer of others.
struct Peer {
    DdsTopic topic;           ///< as it says
    std::string hash;         ///< of its type; empty: it says none
    bool is_cyclone = false;  ///< a client or service of Cyclone DDS
    bool is_writer = false;   ///< it publishes
};

/// Safe to use from many threads.
class Peers {
  public:
    explicit Peers(Notices& notices) : notices_(notices) {}

    /// A peer was found, or has changed.
    void found(const Guid& guid, const Peer& peer);
    /// It is gone.
    void lost(const Guid& guid);
    /// This process reads or writes a topic, too.
    void add_own(const DdsTopic& topic, const std::string& hash);
    /// It does so no more.
    void remove_own(const std::string& topic);
    /// The type of writers elsewhere on a topic that this process reads, if none has its type: as ROS 2 has
    /// it. Empty: there are none.
    std::string other_type(const std::string& topic) const;
    /// The peer with this name; an empty one: it is not known.
    Peer of(const Guid& guid) const;
    /// How often a peer was found or lost.
    std::uint64_t changes() const { return changes_; }

  private:
    struct Own {
        DdsTopic topic;
        std::string hash;
        int uses = 0;
    };

    void compare(const Guid& guid, const Peer& peer, const Own& own);

    Notices& notices_;
    std::atomic<std::uint64_t> changes_{0};
    mutable std::mutex mutex_;
    std::map<Guid, Peer> peers_;
    std::unordered_map<std::string, std::set<Guid>> of_topic_;
    std::unordered_map<std::string, Own> own_;
};

}  // namespace roboss::fastdds
