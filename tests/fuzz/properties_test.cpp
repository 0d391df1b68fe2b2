// Each property on a few dozen seeds. A failing seed is told with the command that replays it; longer runs:
// docs/testing.md.
#include <gtest/gtest.h>

#include <string>

#include "fuzz/property.h"

namespace roboss::fuzz {
namespace {

struct Share {
    const char* property;
    std::uint64_t seeds;               // from 0
    double seconds;                    // simulated
    std::vector<std::string> kinds{};  // empty: all
};

void expect_holds(const Share& share) {
    Property property = *find_property(share.property);
    if (!share.kinds.empty()) property.kinds = share.kinds;
    std::uint64_t failed = 0;
    std::string commands;
    for (std::uint64_t seed = 0; seed < share.seeds; ++seed) {
        const Request request{property.setting(seed), share.seconds};
        const Finding finding = property.run(request);
        if (!finding.failed) continue;
        constexpr std::uint64_t kToldMost = 10;
        if (++failed <= kToldMost)
            commands += finding.text + " " + std::to_string(finding.figure) + "\n  " +
                        replay_command(property, request) + "\n";
    }
    EXPECT_EQ(failed, 0u) << "of " << share.seeds << " seeds: " << property.claim << "\n" << commands;
}

TEST(Property, HashIsTheSameInFiveConfigurations) {
    expect_holds({"hash", 48, 0.3, {"fleet", "wild", "crowd", "room", "loop", "coupled"}});
}

}  // namespace
}  // namespace roboss::fuzz
