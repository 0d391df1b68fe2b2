// Orders for own gravity and wind: what is refused, and what becomes of a state, its bytes and its hash.
#include "model/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <support/mechanisms.h>
#include <support/robots.h>

#include "model/order.h"

namespace roboss::test {
namespace {

const Vec3 kMoon{0, 0, -1.62}, kBreeze{3, -1, 0.5};

class SurroundingsTest : public testing::Test {
  protected:
    SurroundingsTest() {
        World world = empty_world(1e-3);
        world.wind = {1, 2, 0};
        place(world, car(), "car");
        Diagnostics diagnostics;
        model = compile(world, {}, diagnostics);
        state = initial_state(*model, RobotId(0u));
    }
    Result<> check(const SetSurroundings& order) const {
        return check_order(*model, {0, ClientId(0u), 0, RobotId(0u), order});
    }
    void give(const SetSurroundings& order) {
        ASSERT_TRUE(check(order).ok());
        apply_order(*model, {0, ClientId(0u), 0, RobotId(0u), order}, state);
    }
    std::uint64_t hash() const { return state_hash(RobotId(0u), 5, state); }
    Result<RobotState> travelled() const {
        std::vector<std::uint8_t> bytes;
        encode(state, bytes);
        return decode_state(bytes, type(), model->robots.size());
    }
    const RobotType& type() const { return model->type_of(RobotId(0u)); }
    const RobotType& own() const { return type_of(type(), state); }

    std::shared_ptr<const Model> model;
    RobotState state;
};

TEST_F(SurroundingsTest, ThatNoRobotCanHaveAreRefusedByName) {
    const auto refusal = [&](const SetSurroundings& order) {
        const Result<> checked = check(order);
        EXPECT_FALSE(checked.ok());
        return checked ? Error{} : checked.error();
    };
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal({}).code, "no-parameter");
    EXPECT_EQ(refusal({false, {Vec3{0, 0, std::nan("")}, std::nullopt}}).code, "not-finite");
    EXPECT_EQ(refusal({false, {std::nullopt, Vec3{infinity, 0, 0}}}).code, "not-finite");
    EXPECT_EQ(refusal({true, {Vec3{0, 0, -1001}, std::nullopt}}).code, "beyond-limit");
    const Error fast = refusal({false, {kMoon, Vec3{0, 2000, 0}}});
    EXPECT_EQ(fast.code, "beyond-limit");
    EXPECT_FALSE(fast.remedy.empty());
    EXPECT_NE(fast.message.find("'wind'"), std::string::npos) << fast.message;
    EXPECT_NE(fast.message.find("'car'"), std::string::npos) << fast.message;
    EXPECT_TRUE(check({true, {}}).ok());
    EXPECT_TRUE(check({false, {Vec3{1000, -1000, 0}, Vec3{}}}).ok());
}

TEST_F(SurroundingsTest, AreTheRobotsFromTheOrderOn) {
    EXPECT_EQ(gravity_of(*model, own()), model->gravity);
    give({false, {kMoon, std::nullopt}});
    EXPECT_EQ(gravity_of(*model, own()), kMoon);
    EXPECT_EQ(wind_of(*model, own()), (Vec3{1, 2, 0}));
    give({false, {std::nullopt, kBreeze}});
    EXPECT_EQ(gravity_of(*model, own()), kMoon) << "what is not named stays";
    EXPECT_EQ(wind_of(*model, own()), kBreeze);
    EXPECT_EQ(surrounding_of(*model, state, Surrounding::kGravity), kMoon);
    EXPECT_EQ(surrounding_of(*model, state, Surrounding::kWind), kBreeze);
    give({true, {std::nullopt, Vec3{}}});
    EXPECT_EQ(gravity_of(*model, own()), model->gravity) << "reset comes first";
    EXPECT_EQ(wind_of(*model, own()), Vec3{}) << "no wind is a wind, too";
}

TEST_F(SurroundingsTest, HaveNoMinusZero) {
    give({false, {Vec3{-0.0, 0, -1.62}, std::nullopt}});
    const std::uint64_t given = hash();
    give({false, {kMoon, std::nullopt}});
    EXPECT_EQ(hash(), given);
    EXPECT_FALSE(std::signbit(state.own.around.gravity->x));
    state.own.around.gravity->x = -0.0;
    EXPECT_FALSE(travelled().ok()) << "no order gives it";
}

TEST_F(SurroundingsTest, ThatAreTheModelsAgainLeaveNoTrace) {
    const std::uint64_t before = hash();
    give({false, {model->gravity, model->wind}});
    EXPECT_EQ(hash(), before);
    give({false, {kMoon, kBreeze}});
    const std::uint64_t changed = hash();
    EXPECT_NE(changed, before);
    give({false, {model->gravity, std::nullopt}});
    EXPECT_NE(hash(), before);
    EXPECT_NE(hash(), changed);
    give({false, {std::nullopt, model->wind}});
    EXPECT_EQ(hash(), before);
    EXPECT_EQ(state.own_type.get(), nullptr);
    give({false, {kMoon, kBreeze}}), give({true, {}});
    EXPECT_EQ(hash(), before);
}

TEST_F(SurroundingsTest, TravelAsBytesBesideOtherNumbers) {
    for (const bool heavy : {false, true}) {
        if (heavy)
            apply_order(*model,
                        {0, ClientId(0u), 0, RobotId(0u),
                         SetLinkParameters{LinkId(1u), false, {{LinkParameter::kMass, 3}}}},
                        state);
        for (const OwnSurroundings& some :
             {OwnSurroundings{kMoon, std::nullopt}, OwnSurroundings{kMoon, kBreeze},
              OwnSurroundings{std::nullopt, kBreeze}}) {
            give({true, some});
            const Result<RobotState> back = travelled();
            ASSERT_TRUE(back.ok()) << back.error().text();
            EXPECT_EQ(back.value(), state);
            EXPECT_EQ(type_of(type(), back.value()).around, some);
            EXPECT_EQ(type_of(type(), back.value()).links[1].mass, heavy ? 3 : type().links[1].mass);
        }
    }
}

TEST_F(SurroundingsTest, ThatNoOrderGivesAreRefusedAsBytes) {
    state.own.around = {kMoon, std::nullopt};
    EXPECT_TRUE(travelled().ok());
    state.own.around = {Vec3{0, 0, 1e6}, std::nullopt};
    EXPECT_FALSE(travelled().ok());
    state.own.around = {std::nullopt, Vec3{0, std::nan(""), 0}};
    EXPECT_FALSE(travelled().ok());
}

TEST_F(SurroundingsTest, WakeTheRobot) {
    state.rest.asleep = true, state.rest.still_ticks = 99;
    give({false, {kMoon, std::nullopt}});
    EXPECT_FALSE(state.rest.asleep);
}

}  // namespace
}  // namespace roboss::test
