// Sweep, islands, assignment, window length.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "schedule/assign.h"
#include "schedule/box_grid.h"
#include "schedule/forecast.h"
#include "schedule/sweep.h"
#include "schedule/touch_watch.h"
#include "schedule/window_length.h"

namespace roboss {
namespace {

std::vector<OwnedBox> random_boxes(std::mt19937_64& random, std::uint32_t owners, double extent,
                                   double size) {
    std::uniform_real_distribution<double> position(-extent, extent), edge(0, size);
    std::vector<OwnedBox> boxes;
    for (std::uint32_t i = 0; i < owners; ++i) {
        const Vec3 p{position(random), position(random), position(random) * 0.05};
        boxes.push_back({outward(Aabb{p, p + Vec3{edge(random), edge(random), edge(random)}}), i});
    }
    return boxes;
}

TEST(Sweep, FindsExactlyTheSetsOfOverlappingBoxes) {
    std::mt19937_64 random(4);
    for (const std::uint32_t n : {0u, 1u, 10u, 63u, 64u, 400u, 1500u})
        for (const double size : {0.1, 1.0, 8.0}) {
            std::vector<OwnedBox> boxes = random_boxes(random, n, 40, size);
            for (std::uint32_t i = 0; i + 1 < n / 10; ++i)
                boxes.push_back(random_boxes(random, 1, 40, size)[0]);  // owner 0 has more
            if (n > 70) {  // a pillar over everything, an endless box, an empty one
                boxes.push_back({Box32{{1, -1e30f, 0}, {1.5f, 1e30f, 1}}, 5});
                boxes.push_back({Box32{}, 6});
                const float inf = std::numeric_limits<float>::infinity();
                if (size > 5) boxes.push_back({Box32{{-inf, -inf, 30}, {inf, inf, 31}}, 7});
            }
            UnionFind expected, found;
            expected.reset(n), found.reset(n);
            for (std::size_t i = 0; i < boxes.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (overlaps(boxes[i].box, boxes[j].box)) expected.unite(boxes[i].owner, boxes[j].owner);
            Sweep().unite_overlapping(boxes, found);
            for (std::uint32_t i = 0; i < n; ++i)
                ASSERT_EQ(found.find(i), expected.find(i)) << n << " boxes, robot " << i;

            BoxGrid grid;
            grid.reset(boxes);
            found.reset(n);
            for (const OwnedBox& box : boxes) grid.add(box, found);
            EXPECT_EQ(grid.overwhelmed(), n == 0) << n << " boxes of size " << size;
            for (std::uint32_t i = 0; i < n && !grid.overwhelmed(); ++i)
                ASSERT_EQ(found.find(i), expected.find(i)) << n << " boxes in a grid, robot " << i;
        }
}

TEST(BoxGrid, SaysSoWhenAllLieOnEachOther) {
    std::mt19937_64 random(5);
    const std::vector<OwnedBox> boxes = random_boxes(random, 1000, 1, 8);
    BoxGrid grid;
    UnionFind sets;
    sets.reset(1000);
    grid.reset(boxes);
    for (const OwnedBox& box : boxes) grid.add(box, sets);
    EXPECT_TRUE(grid.overwhelmed());
}

TEST(TouchWatch, KnowsThatAllKeptApartOnceAllHaveCome) {
    const auto box = [](float x) { return Box32{{x, 0, 0}, {x + 1, 1, 1}}; };
    const Islands islands{{0, 2, 3}, {RobotId(0u), RobotId(2u), RobotId(1u)}};
    TouchWatch watch;
    const auto all_apart = [&](float second) {
        watch.begin(islands);
        watch.add({box(0), 0}, true);
        watch.add({box(0.5f), 2}, true);
        watch.add({box(90), 1}, false);  // before it was teleported
        EXPECT_FALSE(watch.all_apart()) << "one is missing";
        watch.add({box(second), 1}, true);
        return watch.all_apart();
    };
    EXPECT_FALSE(all_apart(5)) << "how large boxes are is not known yet";
    EXPECT_TRUE(all_apart(5));
    EXPECT_FALSE(all_apart(0.5f));
    EXPECT_TRUE(all_apart(5));
    watch.stop();
    EXPECT_FALSE(watch.all_apart());
}

TEST(Forecast, FindsTheSameIslandsAheadAndAfterwards) {
    std::mt19937_64 random(6);
    const auto model = std::make_shared<const Model>();
    Forecast ahead(model), afterwards(model);
    std::uniform_real_distribution<float> velocity(-3, 3);
    for (int window = 0; window < 20; ++window) {
        std::vector<RobotMotion> motions;
        for (const OwnedBox& b : random_boxes(random, 500, 30, 1)) {
            motions.push_back({b.box, b.box.min, {velocity(random), velocity(random), 0}, 0.064f});
        }
        Islands found, expected;
        ahead.expect(motions.size(), 64, {});
        for (std::size_t i = motions.size(); i-- > 0;)
            if (window != 3 || i != 7) ahead.add(RobotId(i), motions[i]);  // one was lost
        const Tick ticks = window == 5 ? 32 : 64;                          // another window than expected
        ahead.islands(motions, {}, ticks, {}, found);
        afterwards.islands(motions, {}, ticks, {}, expected);
        EXPECT_EQ(found.offsets, expected.offsets) << "window " << window;
        EXPECT_EQ(found.robots, expected.robots) << "window " << window;
        EXPECT_GT(found.count(), 10u);
        EXPECT_LT(found.count(), 500u);
    }
}

TEST(Sweep, CountsTouchingAsOverlapping) {
    UnionFind sets;
    sets.reset(2);
    const std::vector<OwnedBox> boxes{{Box32{{0, 0, 0}, {1, 1, 1}}, 0}, {Box32{{1, 1, 1}, {2, 2, 2}}, 1}};
    EXPECT_EQ(Sweep().unite_overlapping(boxes, sets), 1u);
}

TEST(Islands, AreCanonicalHoweverTheyWereFound) {
    UnionFind a, b;
    a.reset(6), b.reset(6);
    a.unite(5, 1), a.unite(3, 5), a.unite(4, 2);
    b.unite(2, 4), b.unite(1, 3), b.unite(5, 3);
    Islands ia, ib;
    collect_islands(a, ia), collect_islands(b, ib);
    EXPECT_EQ(ia.robots, ib.robots);
    EXPECT_EQ(ia.offsets, (std::vector<std::uint32_t>{0, 1, 4, 6}));
    EXPECT_EQ(ia.robots, (std::vector<RobotId>{RobotId(0u), RobotId(1u), RobotId(3u), RobotId(5u),
                                               RobotId(2u), RobotId(4u)}));
    Islands some;
    const std::vector<RobotId> only{RobotId(2u), RobotId(3u), RobotId(5u)};
    collect_islands(a, only, some);
    EXPECT_EQ(some.offsets, (std::vector<std::uint32_t>{0, 1, 3}));
    EXPECT_EQ(some.robots, only);
}

Islands single_islands(std::size_t n) {
    Islands islands;
    for (std::size_t i = 0; i < n; ++i) {
        islands.robots.emplace_back(i);
        islands.offsets.push_back(static_cast<std::uint32_t>(i + 1));
    }
    return islands;
}

TEST(Assign, BalancesByCostAndSpeed) {
    const Islands islands = single_islands(60);
    std::vector<float> cost(60);
    for (std::size_t i = 0; i < 60; ++i) cost[i] = 1.0f + static_cast<float>(i % 5);
    const std::vector<std::uint32_t> nowhere(60, kNowhere);
    const std::vector<double> speed{1, 2, 1};
    std::vector<double> load(3, 0.0);
    const auto assigned = assign({islands, cost, nowhere, speed, 0});
    for (std::size_t i = 0; i < 60; ++i) load[assigned[i]] += static_cast<double>(cost[i]);
    EXPECT_NEAR(load[0], 45, 5);
    EXPECT_NEAR(load[1], 90, 5);
    EXPECT_NEAR(load[2], 45, 5);
}

TEST(Assign, GivesMostToWhoIsToldFirst) {
    Islands islands{{0}, {}};
    for (std::uint32_t i = 0; i < 30; ++i) {
        islands.robots.emplace_back(i);
        islands.offsets.push_back(i + 1);
    }
    const std::vector<float> cost(30, 1.0f);
    const std::vector<std::uint32_t> nowhere(30, kNowhere);
    const auto assigned = assign({islands, cost, nowhere, std::vector<double>{1, 1, 1}, 0, 5});
    for (const std::uint32_t s : {0u, 1u, 2u})
        EXPECT_EQ(std::count(assigned.begin(), assigned.end(), s), 15 - 5 * s);
}

TEST(Assign, MovesNobodyWhileStayingIsNearlyAsGood) {
    const Islands islands = single_islands(40);
    std::vector<std::uint32_t> here(40);
    std::vector<float> cost(40);
    for (std::uint32_t i = 0; i < 40; ++i)
        here[i] = i % 2, cost[i] = 1.0f + 0.001f * static_cast<float>(i % 3);
    EXPECT_EQ(assign({islands, cost, here, std::vector<double>{1, 1}, 1}), here);
}

TEST(Assign, MovesOnlyWhatIsTooMuch) {
    const Islands islands = single_islands(40);
    const std::vector<std::uint32_t> here(40, 0);
    const std::vector<float> cost(40, 1.0f);
    const auto assigned = assign({islands, cost, here, std::vector<double>{1, 1}, 0.1});
    const auto moved = std::count(assigned.begin(), assigned.end(), 1u);
    EXPECT_GE(moved, 18);
    EXPECT_LE(moved, 20);
}

TEST(Assign, MovesWhatIsWorthIt) {
    const Islands islands = single_islands(4);
    const std::vector<std::uint32_t> here{0, 0, 0, 1};
    const std::vector<float> cost{3.0f, 2.0f, 1.0f, 3.0f};
    const auto with_price = [&](double move) {
        return assign({islands, cost, here, std::vector<double>{1, 1}, move});
    };
    EXPECT_EQ(with_price(0.5), (std::vector<std::uint32_t>{0, 0, 1, 1})) << "5 is sooner than 6";
    EXPECT_EQ(with_price(3), here) << "7 is later";
}

TEST(WindowLength, IsLongForAPileThatShortWindowsDoNotPartAndLooksNowAndThen) {
    WindowLength length(0);
    int shortest = 0;
    for (int i = 0; i < 400; ++i) {
        if (i >= 100) shortest += length.ticks() == 4 ? 1 : 0;
        length.committed(length.ticks(), false, 12, 64);
    }
    EXPECT_EQ(length.ticks(), 128) << "nothing parts it";
    EXPECT_GE(shortest, 5);
    EXPECT_LE(shortest, 12);
    for (int i = 0; i < 64; ++i)  // from now on short windows show it separated, long ones do not
        length.committed(length.ticks(), false, length.ticks() > 8 ? 12 : 0.5, 64);
    EXPECT_LE(length.ticks(), 16);
}

TEST(WindowLength, IsLongerForFewRobotsAWorker) {
    EXPECT_EQ(longest_window(50, 1), 256);
    EXPECT_EQ(longest_window(50, 2), 128) << "forecasts over more make islands too large for a half";
    EXPECT_EQ(longest_window(2000, 1), 64);
    EXPECT_EQ(longest_window(2000, 6), 96);
    EXPECT_EQ(longest_window(2000, 12), 128);
    EXPECT_EQ(longest_window(0, 0), 256);
}

TEST(WindowLength, GrowsWhenCalmAndShrinksWhenRepeated) {
    WindowLength length(0);
    for (int i = 0; i < 3; ++i) length.committed(length.ticks(), false, 0.1, 64);
    EXPECT_EQ(length.ticks(), 64) << "in haste at the beginning";
    length.committed(64, true, 0.1, 64);
    EXPECT_EQ(length.ticks(), 32);
    for (int i = 0; i < 4; ++i) length.committed(length.ticks(), false, 0.1, 64);
    EXPECT_EQ(length.ticks(), 40) << "with care after a repeat";
    for (int i = 0; i < 20; ++i) length.committed(length.ticks(), true, 0.1, 64);
    EXPECT_EQ(length.ticks(), 1);
    WindowLength fixed(16);
    fixed.committed(16, true, 5, 64);
    EXPECT_EQ(fixed.ticks(), 16);
}

}  // namespace
}  // namespace roboss
