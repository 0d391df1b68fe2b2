// What a page has is brought up to date by what moved, whatever came late, twice or not at all.
#include "gateway/view_state_cache.h"

#include <gtest/gtest.h>
#include <support/robots.h>
#include <support/simulation.h>

#include <cstring>

#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

class ViewStateCacheTest : public testing::Test {
  protected:
    ViewStateCacheTest() {
        World world;
        world.prototypes.push_back(test::car());
        for (int i = 0; i < 3; ++i)
            world.instances.push_back({"car_" + std::to_string(i), 0, {{2.0 * i, 0, 0}, {}}, {}});
        model = test::compiled(world);
        const SceneFile file;
        scene = std::make_shared<const ShownScene>(ShownScene{4, model, file, ViewLayout(*model)});
        book.begin(scene);
    }
    /// Views of these cars, `x` to the side.
    ViewStates views(std::uint64_t serial, Tick tick, std::vector<std::uint32_t> cars, double x) const {
        ViewStates views{model->hash, 1, serial, tick, {}, {}};
        for (const std::uint32_t car : cars) {
            RobotState state = initial_state(*model, RobotId(car));
            state.q[0] += x;
            scene->layout.append(*model, RobotId(car), state, views.entries);
        }
        return views;
    }
    static std::uint32_t robots_in(const std::vector<std::uint8_t>& message) {
        std::uint32_t robots = 0;
        std::memcpy(&robots, message.data() + viewer_protocol::kStateRobotsAt, sizeof(robots));
        return robots;
    }
    std::shared_ptr<const Model> model;
    std::shared_ptr<const ShownScene> scene;
    ViewStateCache book;
    ViewStateCache::Shelf shelf;
};

TEST_F(ViewStateCacheTest, SendsWholeFirstAndThenWhatMoved) {
    EXPECT_FALSE(book.known());
    ASSERT_TRUE(book.take(views(1, 10, {0, 1, 2}, 0), 0));
    EXPECT_TRUE(book.complete());
    const auto first = book.message(shelf);
    EXPECT_EQ(robots_in(first), 3u);
    EXPECT_EQ(first[1], viewer_protocol::kFlagWhole);
    EXPECT_EQ(first.size(), viewer_protocol::kStateBytes + 3 * 32);
    EXPECT_EQ(robots_in(book.message(shelf)), 0u);
    book.take(views(2, 20, {1}, 0.5), 30);
    EXPECT_FALSE(book.complete()) << "the others are not shown at this tick yet";
    const auto second = book.message(shelf);
    EXPECT_EQ(robots_in(second), 1u);
    EXPECT_EQ(second[1], 0);
    shelf.whole = true;
    EXPECT_EQ(robots_in(book.message(shelf)), 3u);
}

TEST_F(ViewStateCacheTest, ViewsThatComeLateDoNotTurnTheWorldBack) {
    book.take(views(2, 20, {0, 1, 2}, 1), 0);
    (void)book.message(shelf);
    book.take(views(1, 10, {0, 1, 2}, 0), 5);
    EXPECT_EQ(book.tick(), 20);
    EXPECT_EQ(robots_in(book.message(shelf)), 0u);
}

TEST_F(ViewStateCacheTest, ARewindShowsEarlierTicks) {
    book.take(views(2, 20, {0, 1, 2}, 1), 0);
    (void)book.message(shelf);
    ViewStates rewound = views(1, 5, {0, 1, 2}, 0);
    rewound.epoch = 2;
    book.take(rewound, 5);
    EXPECT_EQ(book.tick(), 5);
    EXPECT_EQ(robots_in(book.message(shelf)), 3u);
}

TEST_F(ViewStateCacheTest, AControllerThatStartsAnewIsBelievedAfterASilence) {
    book.take(views(1000, 20, {0, 1, 2}, 1), 0);
    (void)book.message(shelf);
    book.take(views(1, 5, {0, 1, 2}, 0), 5'000);
    EXPECT_EQ(book.tick(), 5);
    EXPECT_EQ(robots_in(book.message(shelf)), 3u);
}

TEST_F(ViewStateCacheTest, AWorldThatRestsSaysSo) {
    book.take(views(1, 20, {0, 1, 2}, 0), 0);
    EXPECT_EQ(book.message(shelf)[1] & viewer_protocol::kFlagRest, 0);
    book.take(views(2, 20, {0, 1, 2}, 0), 1000);
    EXPECT_NE(book.message(shelf)[1] & viewer_protocol::kFlagRest, 0);
}

TEST_F(ViewStateCacheTest, ExtrasAreThoseThatEachRobotHadLast) {
    const auto surface = [](std::uint32_t robot, float speed) {
        return ViewSurface{RobotId(robot), LinkId(0u), {speed, 0, 0}, {}, {}};
    };
    book.take(views(1, 10, {0, 1, 2}, 0), 0);
    EXPECT_EQ(book.extras_serial(), 0u) << "nobody has any";
    ViewStates first = views(2, 20, {0, 1}, 0), second = views(2, 20, {2}, 0);
    first.extras.surfaces = {surface(1, 0.5F)};
    second.extras.surfaces = {surface(2, 1)};
    second.extras.bonds = {{RobotId(2u), LinkId(0u), RobotId(0u), LinkId(0u), {}}};
    book.take(second, 0), book.take(first, 0);
    EXPECT_EQ(book.extras().surfaces, (std::vector{surface(1, 0.5F), surface(2, 1)})) << "by robot";
    EXPECT_EQ(book.extras().bonds, second.extras.bonds);
    const std::uint64_t serial = book.extras_serial();
    first.serial = second.serial = 3;
    book.take(first, 30), book.take(second, 30);
    EXPECT_EQ(book.extras_serial(), serial) << "as before";
    ViewStates late = views(1, 10, {2}, 0);
    book.take(late, 40);
    EXPECT_EQ(book.extras_serial(), serial) << "what comes late changes nothing";
    book.take(views(4, 40, {2}, 0), 50);
    EXPECT_EQ(book.extras().surfaces, std::vector{surface(1, 0.5F)}) << "robot 2 stopped";
    EXPECT_TRUE(book.extras().bonds.empty()) << "and let go";
    EXPECT_NE(book.extras_serial(), serial);
}

TEST_F(ViewStateCacheTest, DamagedViewsAndThoseOfAnotherModelAreLeftOut) {
    ViewStates other = views(1, 10, {0}, 0), cut = views(2, 20, {0, 1}, 0);
    other.model_hash ^= 1;
    EXPECT_FALSE(book.take(other, 0));
    cut.entries.resize(cut.entries.size() - 1);
    EXPECT_TRUE(book.take(cut, 0));
    EXPECT_EQ(robots_in(book.message(shelf)), 1u);
    ViewStates wild = views(3, 30, {0}, 0);
    std::fill(wild.entries.begin(), wild.entries.end(), std::uint8_t{0xEE});
    book.take(wild, 0);
    EXPECT_EQ(robots_in(book.message(shelf)), 1u) << "what is known still, for the page has not all yet";
}

}  // namespace
}  // namespace roboss
