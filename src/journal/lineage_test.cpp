// Lineages of branches that left their parents in every way.
#include "journal/lineage.h"

#include <gtest/gtest.h>

namespace roboss::test {
namespace {

using Parts = std::vector<Lineage::Part>;

/// Branches 1, 2, 3 ...: {parent, begin, end}; nothing was pruned.
std::vector<BranchSpan> tree(const std::vector<std::array<Tick, 3>>& branches) {
    std::vector<BranchSpan> spans;
    for (const auto& [parent, begin, end] : branches)
        spans.push_back({std::ssize(spans) + 1, parent, begin, begin, end, 0, {}});
    return spans;
}

TEST(Lineages, HaveAPartOfEachAncestor) {
    const auto spans = tree({{0, 0, 500}, {1, 500, 750}, {2, 750, 1000}});
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{1, 0, 500}, {2, 500, 750}, {3, 750, 1000}}));
    EXPECT_EQ(Lineage::of(spans, 2).parts(), (Parts{{1, 0, 500}, {2, 500, 750}}));
    EXPECT_EQ(Lineage::of(spans, 3).text(0.002), "branch 1 to 1 s, branch 2 to 1.5 s, branch 3 to 2 s");
}

TEST(Lineages, LeaveOutTheFutureThatARewindLeft) {
    const auto spans = tree({{0, 0, 500}, {1, 250, 400}, {1, 100, 900}});
    EXPECT_EQ(Lineage::of(spans, 1).parts(), (Parts{{1, 0, 500}}));
    EXPECT_EQ(Lineage::of(spans, 2).parts(), (Parts{{1, 0, 250}, {2, 250, 400}}));
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{1, 0, 100}, {3, 100, 900}}));
}

TEST(Lineages, BeginAnewWithAResetToTheBeginning) {
    const auto spans = tree({{0, 0, 500}, {1, 500, 750}, {2, 0, 30}});
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{3, 0, 30}}));
}

TEST(Lineages, HaveNoPartOfABranchThatWasLeftAtOnce) {
    const auto spans = tree({{0, 0, 500}, {1, 500, 500}, {2, 500, 600}, {3, 400, 450}});
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{1, 0, 500}, {3, 500, 600}}));
    EXPECT_EQ(Lineage::of(spans, 4).parts(), (Parts{{1, 0, 400}, {4, 400, 450}})) << "3 and 2 begin later";
}

TEST(Lineages, BeginWhereNothingIsMissing) {
    auto spans = tree({{0, 0, 500}, {1, 500, 750}, {2, 750, 1000}});
    spans[1].first = 600;  // pruned
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{2, 600, 750}, {3, 750, 1000}}));
    spans.erase(spans.begin());
    EXPECT_EQ(Lineage::of(spans, 3).first(), 600);
    spans[0].first = 750;
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{3, 750, 1000}}));
    spans.erase(spans.begin());
    EXPECT_EQ(Lineage::of(spans, 3).parts(), (Parts{{3, 750, 1000}}));
}

TEST(Lineages, HoldEachTickOnce) {
    const Lineage lineage = Lineage::of(tree({{0, 10, 500}, {1, 500, 750}}), 2);
    EXPECT_EQ(lineage.at(9), nullptr);
    EXPECT_EQ(lineage.at(10)->branch, 1);
    EXPECT_EQ(lineage.at(499)->branch, 1);
    EXPECT_EQ(lineage.at(500)->branch, 2) << "the state at the turn is that of the later branch";
    EXPECT_EQ(lineage.at(750)->branch, 2);
    EXPECT_EQ(lineage.at(751), nullptr);
    EXPECT_EQ(lineage.after(*lineage.at(10)), lineage.at(500));
    EXPECT_EQ(lineage.after(*lineage.at(500)), nullptr);
}

}  // namespace
}  // namespace roboss::test
