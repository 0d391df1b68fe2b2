// A Model survives its bytes in every number, and no bytes give a Model that a step could stumble over.
#include "wire/model_codec.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>
#include <type_traits>

#include <support/mechanisms.h>
#include <support/meshes.h>
#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {
namespace {

/// Another word that may stand where this one does; where any may, the name of a joint.
std::string other_than(const std::string& word) {
    static const std::map<std::string, std::string> kOthers{
        {"child", "parent"},      {"child_to_parent", "parent_to_child"},
        {"cone", "sphere"},       {"gnomonical", "custom"},
        {"tan", "sin"},           {"R8G8B8", "L8"},
        {"semantic", "panoptic"}, {"visible_2d", "3d"},
        {"CUSTOM", "ENU"},        {"distance", "khepera"}};
    const auto other = kOthers.find(word);
    return other == kOthers.end() ? "slide" : other->second;
}

/// One sensor of each kind, no parameter as it is by default.
std::vector<SensorSpec> sensors_of_all_kinds() {
    std::vector<SensorSpec> sensors;
    const auto add = [&](SensorParameters parameters) {
        double next = 1;
        visit_parameters(parameters, [&]<class Value>(const Parameter& parameter, Value& value) {
            if constexpr (std::is_same_v<Value, NoiseSpec>)
                value.mean = ++next, value.stddev = ++next, value.bias_mean = ++next,
                value.bias_stddev = ++next, value.precision = ++next, value.dynamic_bias_stddev = ++next,
                value.dynamic_bias_correlation_time = ++next;
            else if constexpr (std::is_same_v<Value, JointNames>)
                value = {"slide", "wrist"};
            else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
                value = {"slide", "wrist"};
            else if constexpr (std::is_same_v<Value, std::string>)
                value = other_than(value);
            else if constexpr (std::is_same_v<Value, Vec3>)
                value.y = ++next;
            else if constexpr (std::is_same_v<Value, Pose>)
                value.p.y = ++next;
            else if constexpr (std::is_same_v<Value, std::vector<double>>)
                value = {++next, ++next};
            else if constexpr (std::is_same_v<Value, bool>)
                value = !value;
            else if (std::string_view(parameter.name) == "latency" ||
                     std::string_view(parameter.name) == "loss")
                value = static_cast<Value>(1 / ++next);  // of a radio: below 1
            else
                value = static_cast<Value>(++next);
        });
        SensorSpec& sensor = sensors.emplace_back();
        sensor.name = sensor.sdf_type = parameters.index() == 0 ? "camera" : "eye";
        sensor.update_rate_hz = 20, sensor.X_LS.p.x = 0.5;
        sensor.parameters = std::move(parameters);
    };
    [&]<class... Kinds>(std::in_place_type_t<std::variant<Kinds...>>) {
        (add(Kinds{}), ...);
    }(std::in_place_type<SensorParameters>);
    return sensors;
}

/// Every kind of joint, loops, gears, hulls, a mesh, a height field, drag, sensors.
World rich_world() {
    World world = empty_world(2e-3);
    world.air_density = 1.2;
    world.wind = {1, 0, 0};
    world.spherical.emplace().latitude_rad = 0.7;
    std::vector<double> heights(20, -0.1);
    heights[7] = 0.1;
    place(world, scenery(heightmap_shape(5, 4, heights, 40, 30, surface(0.8))), "land");
    place(world, scenery(mesh_shape(box_mesh({1, 1, 0.4}), surface(0.5))), "block", {{3, 0, 0.2}, {}});
    ModelSpec mixed = mixed_tree();
    mixed.links[0].sensors = sensors_of_all_kinds();
    mixed.links[0].drag.acts = true;
    mixed.links[0].drag.coefficient = 1;
    place(world, car(), "car", {{0, 0, 0.3}, {}});
    place(world, car(), "other_car", {{0.5, 0, 0.6}, {}});
    place(world, mixed, "mixed", {{0, 2, 1}, {}});
    place(world, ball_chain(), "balls", {{0, 4, 2}, {}});
    place(world, four_bar(), "four_bar", {{0, 6, 1}, {}});
    place(world, stewart(), "stewart", {{0, 9, 1}, {}});
    place(world, geared_wheels(3), "gears", {{0, 12, 1}, {}});
    place(world, ring_of_all_kinds(JointSpecKind::kUniversal), "ring", {{0, 16, 2}, {}});
    place(world, ball_like(1, 0.2, mesh_shape(ball_mesh(0.2, 2), surface(0.5))), "ball", {{3, 0, 0.8}, {}});
    return world;
}

/// A Model stepped as one island, by its pointer alone.
std::uint64_t hash_after(const std::shared_ptr<const Model>& model, Tick ticks) {
    std::vector<RobotId> ids;
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < model->robots.size(); ++i) {
        ids.emplace_back(i);
        states.push_back(initial_state(*model, ids.back()));
    }
    std::vector<RobotState*> pointers;
    for (RobotState& s : states) pointers.push_back(&s);
    std::vector<Aabb> bounds(states.size());
    StepScratch scratch;
    for (Tick t = 0; t < ticks; ++t)
        if (step_island(*model, t, ids, pointers, {}, bounds, scratch).not_finite.valid()) return 0;
    std::vector<std::uint64_t> hashes;
    for (std::size_t i = 0; i < states.size(); ++i) hashes.push_back(state_hash(ids[i], ticks, states[i]));
    return world_hash(model->hash, hashes);
}

TEST(ModelCodec, AModelFromItsBytesHasTheSameHashAndStepsTheSameBits) {
    const auto model = compiled(rich_world());
    ASSERT_GE(model->hulls.size(), 1u);
    ASSERT_EQ(model->surfaces.size(), 2u);
    const std::vector<std::uint8_t> bytes = encode_model(*model);
    const auto back = decode_model(bytes);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value()->hash, model->hash);
    EXPECT_EQ(encode_model(*back.value()), bytes);
    const std::uint64_t after = hash_after(model, 300);
    EXPECT_NE(after, 0u);
    EXPECT_EQ(hash_after(back.value(), 300), after);
}

TEST(ModelCodec, WhatIsSharedAndWhatIsMeasuredAreThere) {
    const auto model = compiled(rich_world());
    const auto back = decode_model(encode_model(*model));
    ASSERT_TRUE(back.ok()) << back.error().text();
    const Model& copy = *back.value();
    EXPECT_EQ(copy.name, model->name);
    EXPECT_EQ(copy.spherical->latitude_rad, 0.7);
    EXPECT_EQ(copy.types.size(), model->types.size()) << "two cars are of one type";
    EXPECT_EQ(copy.find_robot("other_car"), model->find_robot("other_car"));
    const RobotType& mixed = copy.type_of(*copy.find_robot("mixed"));
    std::vector<SensorSpec> sensors = sensors_of_all_kinds();
    for (SensorSpec& sensor : sensors)  // it names a collision that its link does not have: all count
        if (auto* contact = std::get_if<ContactSpec>(&sensor.parameters)) *contact = {};
    ASSERT_EQ(mixed.sensors.size(), sensors.size());
    for (std::size_t i = 0; i < sensors.size(); ++i)
        EXPECT_EQ(mixed.sensors[i].spec.parameters, sensors[i].parameters) << i;
    EXPECT_EQ(mixed.sensors[1].spec.X_LS.p.x, 0.5);
    EXPECT_EQ(mixed.sensors[1].spec.update_rate_hz, 20);
    for (std::size_t i = 0; i < model->hulls.size(); ++i) {
        EXPECT_EQ(copy.hulls[i]->hash, model->hulls[i]->hash);
        EXPECT_EQ(copy.hulls[i]->radius, model->hulls[i]->radius);
        EXPECT_EQ(copy.hulls[i]->edges.size(), model->hulls[i]->edges.size());
    }
    EXPECT_EQ(copy.surfaces[1]->hash(), model->surfaces[1]->hash());
    EXPECT_EQ(copy.surfaces[1]->sides(), model->surfaces[1]->sides());
}

TEST(ModelCodec, RefusesEveryTruncation) {
    const std::vector<std::uint8_t> bytes = encode_model(*compiled(rich_world()));
    for (std::size_t n = 0; n < bytes.size(); n += n < 200 || n + 200 > bytes.size() ? 1 : 37) {
        const auto back = decode_model(std::span(bytes).first(n));
        ASSERT_FALSE(back.ok()) << "cut to " << n << " of " << bytes.size();
    }
}

TEST(ModelCodec, RefusesAnotherVersionAndLeftOvers) {
    std::vector<std::uint8_t> bytes = encode_model(*compiled(rich_world()));
    bytes.push_back(0);
    EXPECT_NE(decode_model(bytes).error().message.find("left over"), std::string::npos);
    bytes[0] = 77;
    EXPECT_NE(decode_model(bytes).error().message.find("version 77"), std::string::npos);
}

/// Writes the hash that the damaged bytes really have over the one they claim, as a forger would.
bool forge(std::vector<std::uint8_t>& bytes, const std::string& refusal) {
    const std::string words = "its hash is ";
    const auto at = refusal.find(words);
    if (at == std::string::npos) return false;
    const std::uint64_t hash = std::stoull(refusal.substr(at + words.size(), 16), nullptr, 16);
    std::memcpy(bytes.data() + 4, &hash, sizeof(hash));
    return true;
}

TEST(ModelCodec, DamageIsRefusedAndWhatAForgerSlipsThroughCanBeStepped) {
    World small = empty_world(2e-3);
    place(small, ground(surface(0.8)), "ground");
    place(small, car(), "car", {{0, 0, 0.06}, {}});
    place(small, four_bar(), "four_bar", {{0, 3, 1}, {}});
    place(small, ball_like(1, 0.2, mesh_shape(box_mesh({0.2, 0.3, 0.4}), surface(0.5))), "hull",
          {{0, 1, 0.3}, {}});
    const std::uint64_t seed = 20261121;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const std::vector<std::uint8_t> good = encode_model(*compiled(small));
    int refused = 0, forged = 0;
    for (int i = 0; i < 1500; ++i) {
        std::vector<std::uint8_t> bytes = good;
        for (std::uint64_t k = 0; k < 1 + random() % 2; ++k) {
            const std::size_t at = random() % bytes.size();
            bytes[at] =
                random() % 3 == 0 ? 0xFF : static_cast<std::uint8_t>(bytes[at] ^ (1u << random() % 8));
        }
        auto back = decode_model(bytes);
        if (!back.ok() && forge(bytes, back.error().message)) {
            ++forged;
            back = decode_model(bytes);
        }
        if (!back.ok()) {
            ++refused;
            EXPECT_FALSE(back.error().message.empty());
            continue;
        }
        EXPECT_EQ(encode_model(*back.value()), bytes);
        (void)hash_after(back.value(), 2);  // must end, whatever the numbers say
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(forged, 300);
}

}  // namespace
}  // namespace roboss::test
