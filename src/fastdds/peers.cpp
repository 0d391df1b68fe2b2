#include "fastdds/peers.h"

#include "core/hex.h"

namespace roboss::fastdds {
namespace {

constexpr std::size_t kMaxPeers = 100'000, kMaxName = 1000;

std::string type_text(const std::string& type, const std::string& hash) {
    return ros_type(type) + (hash.empty() ? "" : " " + hash);
}

std::string participant_text(const Guid& guid) {
    return hexadecimal({guid.data(), 12});
}

}  // namespace

void Peers::found(const Guid& guid, const Peer& peer) {
    if (peer.topic.name.size() > kMaxName || peer.topic.type.size() > kMaxName) return;
    const std::lock_guard lock(mutex_);
    if (peers_.size() >= kMaxPeers && !peers_.contains(guid)) return;
    peers_[guid] = peer;
    ++changes_;
    of_topic_[peer.topic.name].insert(guid);
    if (const auto own = own_.find(peer.topic.name); own != own_.end()) compare(guid, peer, own->second);
}

void Peers::lost(const Guid& guid) {
    const std::lock_guard lock(mutex_);
    const auto at = peers_.find(guid);
    if (at == peers_.end()) return;
    if (const auto topic = of_topic_.find(at->second.topic.name); topic != of_topic_.end()) {
        topic->second.erase(guid);
        if (topic->second.empty()) of_topic_.erase(topic);
    }
    peers_.erase(at);
    ++changes_;
}

void Peers::add_own(const DdsTopic& topic, const std::string& hash) {
    const std::lock_guard lock(mutex_);
    Own& own = own_[topic.name];
    if (own.uses++ > 0) return;
    own.topic = topic;
    own.hash = hash;
    if (const auto at = of_topic_.find(topic.name); at != of_topic_.end())
        for (const Guid& guid : at->second) compare(guid, peers_.at(guid), own);
}

void Peers::remove_own(const std::string& topic) {
    const std::lock_guard lock(mutex_);
    const auto at = own_.find(topic);
    if (at != own_.end() && --at->second.uses == 0) own_.erase(at);
}

std::string Peers::other_type(const std::string& topic) const {
    const std::lock_guard lock(mutex_);
    const auto own = own_.find(topic);
    const auto guids = of_topic_.find(topic);
    if (own == own_.end() || guids == of_topic_.end()) return {};
    std::string other;
    for (const Guid& guid : guids->second) {
        const Peer& peer = peers_.at(guid);
        if (!peer.is_writer) continue;
        if (peer.topic.type == own->second.topic.type) return {};
        if (other.empty()) other = ros_type(peer.topic.type);
    }
    return other;
}

Peer Peers::of(const Guid& guid) const {
    const std::lock_guard lock(mutex_);
    const auto at = peers_.find(guid);
    return at == peers_.end() ? Peer() : at->second;
}

void Peers::compare(const Guid& guid, const Peer& peer, const Own& own) {
    const bool is_other_name = peer.topic.type != own.topic.type;
    const bool is_other_hash = !peer.hash.empty() && !own.hash.empty() && peer.hash != own.hash;
    if (!is_other_name && !is_other_hash) return;
    const std::string who = participant_text(guid);
    notices_.tell_once(who + own.topic.name,
                       "participant " + who + (peer.is_writer ? " writes " : " reads ") +
                           ros_topic(own.topic.name) + " as " + type_text(peer.topic.type, peer.hash) +
                           ", which is " + type_text(own.topic.type, own.hash) +
                           " here: " + (is_other_name ? "they do not meet" : "messages may be misread"));
}

}  // namespace roboss::fastdds
