// Routes: which connection leads to which address. The first connection that uses an address owns it while it
// lasts, if its certificate permits the role.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "wire/message.h"

namespace roboss {

class Connection;

class Routes {
  public:
    using Peer = std::shared_ptr<Connection>;

    /// `peer` uses this address. Null: it may, and nothing has changed, or it owns the address now
    /// (`is_new`). Else why it may not.
    const char* claim(const Peer& peer, const Address& from, bool& is_new);
    /// A member's connection to the Controller. Every address without an owner leads there.
    void set_controller(const Peer& peer);
    /// It leads nowhere any more. The answer: the addresses that it led to.
    std::set<Address> forget(const Peer& peer);

    Peer way_to(const Address& address) const;
    bool leads_to(const Address& address) const;

  private:
    mutable std::mutex mutex_;
    std::map<Address, Peer> owners_;
    Peer controller_;
};

}  // namespace roboss
