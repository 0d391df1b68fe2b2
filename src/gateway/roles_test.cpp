// Who may do what, and who has control.
#include "gateway/roles.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

ControlDesk desk_of(std::vector<PageRole> roles) {
    ControlDesk desk;
    for (std::size_t i = 0; i < roles.size(); ++i) desk.enter({i + 1, "10.0.0.1", roles[i]});
    return desk;
}

constexpr PageRole kWatch = PageRole::kWatch, kSteer = PageRole::kSteer, kAdminister = PageRole::kAdminister;

std::uint64_t holder_of(const ControlDesk& desk) {
    return desk.holder() == nullptr ? 0 : desk.holder()->number;
}

TEST(Roles, HaveNamesAndEachRequestNeedsOne) {
    for (const PageRole role : {kWatch, kSteer, kAdminister}) EXPECT_EQ(parse_page_role(name_of(role)), role);
    EXPECT_FALSE(parse_page_role("root"));
    EXPECT_EQ(role_needed(GetStatus{}), kWatch);
    EXPECT_EQ(role_needed(PauseRun{}), kSteer);
    EXPECT_EQ(role_needed(RewindRun{}), kSteer);
    EXPECT_EQ(role_needed(PreviewRun{}), kWatch) << "who watches may look back";
    EXPECT_EQ(role_needed(AddBookmark{}), kSteer);
    for (const ControlAction& action :
         {ControlAction(SaveRun{"x"}), ControlAction(QuitRun{}), ControlAction(KillSimulator{1})})
        EXPECT_EQ(role_needed(action), kAdminister);
}

TEST(ControlDesk, ThePageThatActsFirstHasControlAndOthersAreRefused) {
    ControlDesk desk = desk_of({kAdminister, kAdminister});
    EXPECT_EQ(holder_of(desk), 0u);
    EXPECT_TRUE(desk.act(1, kWatch).ok());
    EXPECT_EQ(holder_of(desk), 0u) << "watching is not acting";
    EXPECT_TRUE(desk.act(2, kSteer).ok());
    EXPECT_EQ(holder_of(desk), 2u);
    EXPECT_EQ(desk.act(1, kSteer).error().code, "no-control");
    EXPECT_TRUE(desk.act(1, kWatch).ok());
    EXPECT_TRUE(desk.act(2, kAdminister).ok());
    desk.leave(2);
    EXPECT_TRUE(desk.act(1, kSteer).ok()) << "it is free again";
}

TEST(ControlDesk, ARoleIsNeverExceeded) {
    ControlDesk desk = desk_of({kWatch, kSteer});
    EXPECT_EQ(desk.act(1, kSteer).error().code, "not-permitted");
    EXPECT_EQ(desk.ask(1, 5, 0).error().code, "not-permitted");
    EXPECT_EQ(desk.act(2, kAdminister).error().code, "not-permitted");
    EXPECT_TRUE(desk.act(2, kSteer).ok());
    EXPECT_EQ(desk.act(77, kSteer).error().code, "not-permitted") << "a page that is not open";
}

TEST(ControlDesk, WhoAsksGetsControlWhenItIsYieldedKeptFromNobodyOrNotAnsweredInTime) {
    ControlDesk desk = desk_of({kSteer, kSteer, kSteer});
    ASSERT_TRUE(desk.act(1, kSteer).ok());
    ASSERT_TRUE(desk.ask(2, 20, 1000).ok());
    ASSERT_TRUE(desk.ask(3, 30, 1500).ok());
    EXPECT_EQ(holder_of(desk), 1u);
    EXPECT_EQ(desk.asking().size(), 2u);
    EXPECT_EQ(desk.yield(2, 3).error().code, "no-control") << "it is not its to give";
    EXPECT_EQ(desk.keep(3, 2).error().code, "no-control");
    ASSERT_TRUE(desk.keep(1, 2).ok());
    EXPECT_EQ(desk.keep(1, 2).error().code, "not-asking");
    std::vector<ControlDesk::Decision> decisions = desk.take_decisions();
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_EQ(decisions[0].page, 2u);
    EXPECT_EQ(decisions[0].id, 20);
    EXPECT_FALSE(decisions[0].granted);
    desk.advance(1500 + ControlDesk::kReplyWithin_ms - 1);
    EXPECT_EQ(holder_of(desk), 1u);
    desk.advance(1500 + ControlDesk::kReplyWithin_ms);
    EXPECT_EQ(holder_of(desk), 3u);
    decisions = desk.take_decisions();
    ASSERT_EQ(decisions.size(), 1u);
    EXPECT_TRUE(decisions[0].granted);
    ASSERT_TRUE(desk.ask(1, 10, 20'000).ok());
    ASSERT_TRUE(desk.yield(3, 1).ok());
    EXPECT_EQ(holder_of(desk), 1u);
    ASSERT_TRUE(desk.yield(1, std::nullopt).ok());
    EXPECT_EQ(holder_of(desk), 0u);
}

TEST(ControlDesk, AHigherRoleTakesControlAndOneThatLeavesAsksNoMore) {
    ControlDesk desk = desk_of({kSteer, kAdminister, kSteer});
    ASSERT_TRUE(desk.act(1, kSteer).ok());
    ASSERT_TRUE(desk.ask(3, 1, 0).ok());
    ASSERT_TRUE(desk.ask(2, 2, 0).ok());
    EXPECT_EQ(holder_of(desk), 2u);
    desk.leave(3);
    EXPECT_TRUE(desk.asking().empty());
    desk.advance(1'000'000);
    EXPECT_EQ(holder_of(desk), 2u);
}

}  // namespace
}  // namespace roboss
