// Where joints start: within their limits, followers where their leaders put them, loops closed.
#include <gtest/gtest.h>

#include <support/compiling.h>
#include <support/mechanisms.h>
#include <support/random.h>

#include "model/robot_state.h"

namespace roboss::test {
namespace {

/// A palm on the world with a finger on a hinge about z for each of the limits, called j0, j1 ...
ModelSpec hinges(const std::vector<std::pair<double, double>>& limits) {
    ModelSpec m;
    m.name = "hand";
    m.canonical_link = "palm";
    m.links.push_back(link("palm", 1, box_inertia(1, {0.1, 0.1, 0.1})));
    m.joints.push_back(joint(JointSpecKind::kFixed, "mount", "world", "palm", {}));
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const std::string n = std::to_string(i);
        m.links.push_back(link("l" + n, 1, box_inertia(1, {0.1, 0.1, 0.1})));
        m.joints.push_back(joint(JointSpecKind::kRevolute, "j" + n, "palm", "l" + n, {}, {0, 0, 1}));
        m.joints.back().axes[0].lower = limits[i].first, m.joints.back().axes[0].upper = limits[i].second;
    }
    return m;
}

AxisSpec& axis_of(ModelSpec& m, std::size_t hinge) {
    return m.joints[1 + hinge].axes[0];
}

void follow(ModelSpec& m, std::size_t follower, const std::string& leader, double multiplier, double offset) {
    axis_of(m, follower).mimic = MimicSpec{leader, 0, multiplier, offset, 0, {}};
}

double start_of(const Compiled& c, const std::string& name) {
    const RobotType& type = c.type();
    const Joint& joint = type.joints[type.find_joint(name)->index()];
    return initial_state(*c.model, RobotId(0u)).q[static_cast<std::size_t>(joint.q_index)];
}

std::string message(const Diagnostics& diagnostics, const std::string& code) {
    std::string all;
    for (const Diagnostic& d : diagnostics.items())
        if (d.code == code) all += d.message + "\n";
    return all;
}

TEST(JointStart, ALeaderHoldsAndItsFollowerStandsAtItsOffset) {
    ModelSpec m = hinges({{0, 1}, {0, 2}});
    follow(m, 1, "j0", 1, 0.4);
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j0"), 0);
    EXPECT_EQ(start_of(c, "j1"), 0.4);
    EXPECT_TRUE(has(c.diagnostics, "start-moved"));
    EXPECT_NE(message(c.diagnostics, "start-moved").find("'j1' at 0.4 instead of 0 (it follows 'j0')"),
              std::string::npos);
    EXPECT_EQ(c.diagnostics.count(Severity::kWarning), 0u);
}

TEST(JointStart, AChainOfFollowersFollowsItsLeader) {
    ModelSpec m = hinges({{-9, 9}, {-9, 9}, {-9, 9}});
    follow(m, 0, "j1", -0.5, 0.1);
    follow(m, 1, "j2", 20, 0.3);
    axis_of(m, 2).initial_position = 0.04;
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j2"), 0.04);
    EXPECT_DOUBLE_EQ(start_of(c, "j1"), 1.1);
    EXPECT_DOUBLE_EQ(start_of(c, "j0"), -0.45);
}

TEST(JointStart, AFollowerOfACurvedCouplingStandsWhereThePolynomialPutsIt) {
    ModelSpec m = hinges({{-9, 9}, {-9, 9}, {-9, 9}});
    follow(m, 0, "j1", -2, 0.1);
    follow(m, 1, "j2", 3, 0.5);
    axis_of(m, 1).mimic.value().higher = {1, 0, 2};  // 3 d + d^2 + 2 d^4 + 0.5
    axis_of(m, 2).initial_position = 0.5;
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j2"), 0.5);
    EXPECT_DOUBLE_EQ(start_of(c, "j1"), 1.5 + 0.25 + 0.125 + 0.5);
    EXPECT_DOUBLE_EQ(start_of(c, "j0"), 0.1 - 2 * 2.375);
}

TEST(JointStart, AJointStartsWithinItsLimitsAndANoteSaysWhatMoved) {
    ModelSpec m = hinges({{-2.77, -0.61}, {-1, 1}, {0.5, 1}});
    axis_of(m, 1).initial_position = 3;
    axis_of(m, 2).initial_position = 0.7;
    m.where = {"quad.urdf", 7};
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j0"), -0.61);
    EXPECT_EQ(start_of(c, "j1"), 1);
    EXPECT_EQ(start_of(c, "j2"), 0.7) << "it was within";
    const std::string told = message(c.diagnostics, "start-moved");
    EXPECT_NE(told.find("'j0' at -0.61 instead of 0 (limits -2.77 to -0.61)"), std::string::npos) << told;
    EXPECT_NE(told.find("'j1' at 1 instead of 3"), std::string::npos) << told;
    EXPECT_EQ(told.find("j2"), std::string::npos) << told;
    EXPECT_EQ(c.diagnostics.items().at(0).where.line, 7);
}

TEST(JointStart, NothingIsSaidOfAStartThatIsRight) {
    ModelSpec m = hinges({{0, 1}, {0, 2}});
    follow(m, 1, "j0", 2, 0);
    const Compiled c = compile_one(m);
    EXPECT_TRUE(c.diagnostics.items().empty());
    axis_of(m, 0).initial_position = 0.25, axis_of(m, 1).initial_position = 0.5;
    EXPECT_TRUE(compile_one(m).diagnostics.items().empty()) << "given, and as its leader says";
}

TEST(JointStart, AFollowerBeyondItsLimitsMovesItsLeaderByTheLeast) {
    ModelSpec m = hinges({{0, 1}, {0.6, 2}, {-9, -1.5}});
    follow(m, 1, "j0", 1, 0.4);   // j0 >= 0.2
    follow(m, 2, "j1", -2, 0.1);  // j1 >= 0.8, so j0 >= 0.4
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(start_of(c, "j0"), 0.4, 1e-12);
    EXPECT_NEAR(start_of(c, "j1"), 0.8, 1e-12);
    EXPECT_NEAR(start_of(c, "j2"), -1.5, 1e-12);
    EXPECT_FALSE(has(c.diagnostics, "start-beyond-limits"));
}

TEST(JointStart, AFollowerThatNoLeaderBringsWithinItsLimitsIsAWarning) {
    ModelSpec m = hinges({{0, 1}, {0, 0.3}});
    follow(m, 1, "j0", 1, 0.4);
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j0"), 0) << "it keeps its own limits";
    EXPECT_EQ(start_of(c, "j1"), 0.4);
    const std::string told = message(c.diagnostics, "start-beyond-limits");
    EXPECT_NE(told.find("'j1'"), std::string::npos);
    EXPECT_NE(told.find("0 to 0.3"), std::string::npos);
}

TEST(JointStart, AConstantFollowerDoesNotMoveItsLeader) {
    ModelSpec m = hinges({{0, 1}, {-1, 1}, {2, 3}});
    follow(m, 1, "j0", 0, 0.4);
    follow(m, 2, "j0", 0, 0.4);
    const Compiled c = compile_one(m);
    EXPECT_EQ(start_of(c, "j0"), 0);
    EXPECT_EQ(start_of(c, "j1"), 0.4);
    EXPECT_NE(message(c.diagnostics, "start-beyond-limits").find("'j2'"), std::string::npos);
}

TEST(JointStart, ASavedStateStartsWithinLimitsToo) {
    World world = empty_world(1e-3);
    ModelSpec m = hinges({{0, 1}, {0, 2}});
    follow(m, 1, "j0", 1, 0.4);
    place(world, m, "hand");
    world.instances.back().axes = {{"j0", 0, 1.5}, {"j1", 0, 1.5}};
    Compiled c;
    c.model = compile(world, {}, c.diagnostics);
    ASSERT_TRUE(c.model);
    EXPECT_EQ(start_of(c, "j0"), 1);
    EXPECT_EQ(start_of(c, "j1"), 1.4);
    EXPECT_NE(message(c.diagnostics, "start-moved").find("'j0' at 1 instead of 1.5"), std::string::npos);
}

TEST(JointStart, RandomHandsStartWithinLimitsWithTheirLeadersMovedByTheLeast) {
    int moved = 0, beyond = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto count = static_cast<std::size_t>(random.integer(2, 6));
        std::vector<std::pair<double, double>> limits;
        for (std::size_t i = 0; i < count; ++i) {
            const double lower = random.uniform(-2, 1);
            limits.emplace_back(lower, lower + random.uniform(0, 3));
        }
        ModelSpec m = hinges(limits);
        std::vector<double> multiplier(count, 1), offset(count, 0);  // of the first joint's position
        for (std::size_t i = 0; i < count; ++i) axis_of(m, i).initial_position = random.uniform(-3, 3);
        for (std::size_t i = 1; i < count; ++i) {  // behind any of those before it
            const auto leader = static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1));
            const double k = random.uniform(-1.5, 1.5), o = random.uniform(-0.5, 0.5);
            follow(m, i, "j" + std::to_string(leader), k, o);
            multiplier[i] = k * multiplier[leader], offset[i] = k * offset[leader] + o;
        }
        const Compiled c = compile_one(m);
        ASSERT_TRUE(c.model);
        const double lead = start_of(c, "j0"), wanted = axis_of(m, 0).initial_position;
        const auto fits = [&](double x, double slack) {
            for (std::size_t i = 0; i < count; ++i) {
                const double q = multiplier[i] * x + offset[i];
                if (q < limits[i].first - slack || q > limits[i].second + slack) return false;
            }
            return true;
        };
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(start_of(c, "j" + std::to_string(i)), multiplier[i] * lead + offset[i], 1e-12);
        EXPECT_GE(lead, limits[0].first);
        EXPECT_LE(lead, limits[0].second);
        const bool fit = fits(lead, 1e-9);
        EXPECT_EQ(has(c.diagnostics, "start-beyond-limits"), !fit);
        for (double x = limits[0].first; x < limits[0].second; x += 0.01) {
            if (!fits(x, 0)) continue;
            EXPECT_TRUE(fit) << "there is a place: " << x;
            EXPECT_LE(std::fabs(lead - wanted), std::fabs(x - wanted) + 1e-9) << x << " is nearer";
        }
        moved += fit && lead != wanted ? 1 : 0, beyond += fit ? 0 : 1;
    }
    EXPECT_GT(moved, 50);
    EXPECT_GT(beyond, 50);
}

TEST(JointStart, LoopsCloseWithinLimits) {
    ModelSpec m = four_bar();
    const auto limits = [&](const std::string& name, double lower, double upper) {
        for (JointSpec& j : m.joints)
            if (j.name == name) j.axes[0].lower = lower, j.axes[0].upper = upper;
    };
    limits("crank", 0.3, 2);
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(start_of(c, "crank"), 0.3, 1e-9);
    const double rocker = start_of(c, "rocker");
    EXPECT_GT(std::fabs(rocker), 0.01) << "it went with the crank";
    limits("rocker", rocker > 0 ? -2 : 0.5 * rocker, rocker > 0 ? 0.5 * rocker : 2);
    const Compiled narrow = compile_one(m);
    ASSERT_TRUE(narrow.model);
    EXPECT_TRUE(has(narrow.diagnostics, "start-beyond-limits")) << "the crank cannot be at 0.3 then";
    EXPECT_FALSE(has(c.diagnostics, "start-beyond-limits"));
}

TEST(JointStart, AJointOfALoopThatWouldLeaveItsLimitsStaysAtThemAndTheOthersFollow) {
    ModelSpec m = four_bar();
    m.joints[0].axes[0].initial_position = 0.4;
    const double rocker = start_of(compile_one(m), "rocker");
    ASSERT_GT(std::fabs(rocker), 0.01);
    for (JointSpec& j : m.joints)
        if (j.name == "rocker") (rocker > 0 ? j.axes[0].upper : j.axes[0].lower) = 0.5 * rocker;
    const Compiled c = compile_one(m);
    ASSERT_TRUE(c.model);
    EXPECT_NEAR(start_of(c, "rocker"), 0.5 * rocker, 1e-9);
    EXPECT_FALSE(has(c.diagnostics, "start-beyond-limits"));
    EXPECT_TRUE(has(c.diagnostics, "start-moved"));
    EXPECT_GT(start_of(c, "crank"), 0.05);
    EXPECT_LT(start_of(c, "crank"), 0.35) << "the given start had to yield";
}

}  // namespace
}  // namespace roboss::test
