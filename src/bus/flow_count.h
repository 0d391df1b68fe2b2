// FlowCount: how many messages and bytes went each way between two addresses. For status reports only.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "bus/bus.h"

namespace roboss {

class FlowCount {
  public:
    void add(const Address& from, const Address& to, std::size_t bytes) {
        auto found = flows_.find({from, to});
        if (found == flows_.end()) {
            if (flows_.size() >= kMost) return;  // peers choose addresses as they like
            found = flows_.try_emplace({from, to}).first;
        }
        ++found->second.messages;
        found->second.bytes += bytes;
    }
    std::vector<Flow> all() const {
        std::vector<Flow> flows;
        for (const auto& [ends, flow] : flows_)
            flows.push_back({ends.first, ends.second, flow.messages, flow.bytes});
        return flows;
    }

  private:
    static constexpr std::size_t kMost = 50'000;

    std::map<std::pair<Address, Address>, Flow> flows_;
};

}  // namespace roboss
