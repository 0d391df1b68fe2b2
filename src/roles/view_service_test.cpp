// Who watches is shown the world at its rate, each tick once, and is forgotten when it falls silent.
#include "roles/view_service.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

const Address kViewer{Role::kClient, 7};

TEST(ViewService, ShowsAtMostOnceInAnIntervalAndEachTickOnce) {
    ViewService desk;
    EXPECT_TRUE(desk.empty());
    desk.take(kViewer, {1, 30, 0, false, {}}, 1000);
    int shown = 0;
    for (std::int64_t ms = 1000; ms < 2000; ++ms) shown += static_cast<int>(desk.take_due(ms, ms).size());
    EXPECT_NEAR(shown, 33, 2);
    EXPECT_EQ(desk.take_due(2000, 2200).size(), 1u);
    EXPECT_TRUE(desk.take_due(2000, 2300).empty()) << "the tick of the last view";
}

TEST(ViewService, ShowsATickAgainWhenAskedAgain) {
    ViewService desk;
    desk.take(kViewer, {1, 30, 0, false, {}}, 1000);
    EXPECT_EQ(desk.take_due(5, 1000).size(), 1u);
    EXPECT_TRUE(desk.take_due(5, 1500).empty());
    desk.take(kViewer, {1, 30, 0, false, {}}, 1600);
    EXPECT_EQ(desk.take_due(5, 1600).size(), 1u);
}

TEST(ViewService, ExactStatesHaveAPaceOfTheirOwn) {
    ViewService desk;
    desk.take(kViewer, {1, 10, 100, false, {RobotId(3u)}}, 0);
    int views = 0, exact = 0;
    for (std::int64_t ms = 0; ms < 1000; ++ms)
        for (const ViewService::Due& due : desk.take_due(ms, ms)) {
            views += due.view ? 1 : 0;
            exact += due.exact.size() == 1 ? 1 : 0;
        }
    EXPECT_NEAR(views, 100, 3);
    EXPECT_NEAR(exact, 10, 1);
}

TEST(ViewService, AsksForWindowsThatEndWhenAViewIsDue) {
    ViewService desk;
    EXPECT_FALSE(desk.window_max()) << "nobody watches";
    desk.take(kViewer, {1, 30, 0, false, {}}, 0);
    for (Tick tick = 0; tick < 400; tick += 4) desk.note(tick, 2 * tick);
    EXPECT_EQ(desk.window_max(), 15) << "at 2 ms a tick";
    for (std::int64_t ms = 800; ms < 9'000; ++ms) desk.note(396, ms);  // it rests
    EXPECT_EQ(desk.window_max(), 15) << "a rest tells nothing";
    desk.take(kViewer, {1, 0, 100, false, {RobotId(1u)}}, 0);
    EXPECT_FALSE(desk.window_max()) << "exact states come when they come";
}

TEST(ViewService, ForgetsWhoFallsSilent) {
    ViewService desk;
    desk.take(kViewer, {1, 30, 0, false, {}}, 0);
    EXPECT_EQ(desk.take_due(1, 2900).size(), 1u);
    EXPECT_TRUE(desk.take_due(2, 3100).empty());
    EXPECT_TRUE(desk.empty());
}

TEST(ViewService, HasAnEndToItsPatienceWithCrowds) {
    ViewService desk;
    for (std::uint64_t i = 0; i < 1000; ++i) desk.take({Role::kClient, i}, {1, 30, 0, false, {}}, 0);
    EXPECT_LE(desk.take_due(1, 0).size(), 16u);
}

}  // namespace
}  // namespace roboss
