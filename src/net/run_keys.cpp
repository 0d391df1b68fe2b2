// See run_keys.h.
#include "net/run_keys.h"

#include <utility>
#include <vector>

#include "net/network.h"

namespace roboss {
namespace {

constexpr int kRunKeys_days = 3'650;  // keys of a run end with it
constexpr int kPageKeys_days = 365;   // browsers refuse what lasts for long

}  // namespace

Result<RunKeys> new_run_keys(const std::string& simulation) {
    const Result<KeyPair> authority = new_authority("roboss", kRunKeys_days);
    if (!authority) return authority.error();
    RunKeys keys;
    for (auto& [credentials, seat] :
         {std::pair{&keys.controller, Seat::kController}, std::pair{&keys.member, Seat::kMember}}) {
        Result<KeyPair> own =
            new_certificate(authority.value(), {simulation.substr(0, 60), seat}, kRunKeys_days);
        if (!own) return own.error();
        *credentials = {authority.value().certificate, std::move(own).value(), {}};
    }
    return keys;
}

Result<KeyPair> new_page_keys(const std::string& address) {
    std::vector<std::string> names = own_names();
    names.push_back(address);
    return new_server_certificate(names, kPageKeys_days);
}

}  // namespace roboss
