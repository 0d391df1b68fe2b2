// See routes.h.
#include "net/routes.h"

#include <algorithm>
#include <cstddef>

#include "bus/bus.h"
#include "net/connection.h"

namespace roboss {
namespace {

constexpr std::size_t kAddressesMost = 1'000;  // of one peer

bool may_be(Seat seat, Role role) {
    switch (role) {
        case Role::kController:
            return false;
        case Role::kSimulator:
            return seat == Seat::kSimulator || seat == Seat::kMember;
        case Role::kClient:
            return seat == Seat::kClient || seat == Seat::kMember;
    }
    return false;
}

}  // namespace

const char* Routes::claim(const Peer& peer, const Address& from, bool& is_new) {
    const std::lock_guard lock(mutex_);
    const auto owner = owners_.find(from);
    is_new = owner == owners_.end();
    if (!is_new) return owner->second == peer ? nullptr : "it sent a message in the name of another one";
    const Seat seat = peer->session() == nullptr ? Seat::kMember : peer->session()->peer().seat;
    if (!may_be(seat, from.role)) return "its key does not permit the role in which it sent a message";
    const auto its = std::ranges::count_if(owners_, [&](const auto& route) { return route.second == peer; });
    if (its >= static_cast<std::ptrdiff_t>(kAddressesMost)) return "it uses too many addresses";
    owners_.emplace(from, peer);
    return nullptr;
}

void Routes::set_controller(const Peer& peer) {
    const std::lock_guard lock(mutex_);
    controller_ = peer;
}

std::set<Address> Routes::forget(const Peer& peer) {
    std::set<Address> gone;
    const std::lock_guard lock(mutex_);
    std::erase_if(owners_,
                  [&](const auto& route) { return route.second == peer && gone.insert(route.first).second; });
    if (controller_ == peer) controller_.reset(), gone.insert(kControllerAddress);
    return gone;
}

Routes::Peer Routes::way_to(const Address& address) const {
    const std::lock_guard lock(mutex_);
    const auto owner = owners_.find(address);
    return owner == owners_.end() ? controller_ : owner->second;
}

bool Routes::leads_to(const Address& address) const {
    const std::lock_guard lock(mutex_);
    return owners_.contains(address) || (address == kControllerAddress && controller_);
}

}  // namespace roboss
