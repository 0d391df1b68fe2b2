// The generated soccer field: at a kick-off of either team no robot stands in another one, in a wall, or in
// the other half.
#include "app/worlds/soccer_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "app/worlds/soccer_field.h"
#include "app/worlds/ssl_field.h"
#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

TEST(SoccerWorld, LeaguesDifferAndAnUnknownOneIsEmpty) {
    EXPECT_NE(soccer_sdf({"small"}), soccer_sdf({"middle"}));
    EXPECT_NE(soccer_sdf({"large"}).find("yellow_10"), std::string::npos);
    EXPECT_EQ(soccer_sdf({"tiny"}), "");
}

TEST(SoccerWorld, AtAKickOffEveryoneStandsFreeInTheOwnHalf) {
    for (const soccer::Field& field : soccer::kFields) {
        std::vector<soccer::Stand> taken{{0, 0, 0}};  // the ball
        for (const bool has_kick_off : {true, false})
            for (int i = 0; i < field.robots; ++i) {
                soccer::Stand stand = soccer::kick_off_stand(field, i, has_kick_off);
                EXPECT_LT(stand.x, -soccer::kRobotSize / 2);
                EXPECT_GT(stand.x, -field.half_length + soccer::kRobotSize / 2);
                EXPECT_LT(std::fabs(stand.y), field.half_width - soccer::kRobotSize);
                if (!has_kick_off) {
                    EXPECT_GT(std::hypot(stand.x, stand.y), field.circle) << "law: outside of the circle";
                    stand.x = -stand.x, stand.y = -stand.y;
                }
                for (const soccer::Stand& other : taken)
                    EXPECT_GT(std::hypot(stand.x - other.x, stand.y - other.y), 0.08)
                        << field.league << " robot " << i;
                taken.push_back(stand);
            }
    }
}

TEST(SoccerWorld, TheSmallSizeLeagueHasFourWheelsADribblerAndNoFindings) {
    for (const soccer::SslField& field : soccer::kSslFields) {
        Diagnostics diagnostics;
        const auto world =
            load_world_text(soccer_sdf({std::string(field.league)}), "ssl.sdf", {}, diagnostics);
        ASSERT_TRUE(world);
        EXPECT_TRUE(diagnostics.items().empty());
        const auto model = compile(*world, {}, diagnostics);
        EXPECT_EQ(model->robots.size(), 2u * static_cast<std::size_t>(field.robots) + 1);
        const auto robot = model->find_robot("yellow_" + std::to_string(field.robots - 1));
        ASSERT_TRUE(robot);
        EXPECT_EQ(model->type_of(*robot).joints.size(), 5u);
    }
}

TEST(SoccerWorld, InTheSmallSizeLeagueEveryoneStandsFreeInTheOwnHalf) {
    for (const soccer::SslField& field : soccer::kSslFields) {
        std::vector<soccer::Stand> taken;
        for (const bool has_kick_off : {true, false})
            for (int i = 0; i < field.robots; ++i) {
                soccer::Stand stand = soccer::ssl_stand(field, i, has_kick_off);
                EXPECT_LT(stand.x, -soccer::SslRobot::kRadius);
                EXPECT_LT(std::fabs(stand.y), field.half_width - soccer::SslRobot::kRadius);
                if (!has_kick_off) {
                    EXPECT_GT(std::hypot(stand.x, stand.y), field.circle + soccer::SslRobot::kRadius);
                    stand.x = -stand.x, stand.y = -stand.y;
                }
                for (const soccer::Stand& other : taken)
                    EXPECT_GT(std::hypot(stand.x - other.x, stand.y - other.y),
                              2.2 * soccer::SslRobot::kRadius)
                        << field.league << " robot " << i;
                taken.push_back(stand);
            }
    }
}

}  // namespace
}  // namespace roboss
