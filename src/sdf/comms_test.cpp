// Radios: <roboss:radio>, and what Gazebo's CommsEndpoint, RFComms and PerfectComms become.
#include <gtest/gtest.h>

#include <cmath>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

std::string comms(const std::string& name, const std::string& children) {
    return "<plugin name='gz::sim::systems::" + name + "' filename='x'>" + children + "</plugin>";
}

std::string endpoint(const std::string& model, const std::string& children) {
    return "<model name='" + model + "'>" + link("a") + comms("CommsEndpoint", children) + "</model>";
}

std::vector<SensorSpec> radios_of(const Loaded& loaded) {
    std::vector<SensorSpec> radios;
    if (!loaded.world) return radios;
    for (const ModelSpec& model : loaded.world->prototypes)
        for (const LinkSpec& link : model.links)
            for (const SensorSpec& sensor : link.sensors)
                if (sensor.as<RadioSpec>() != nullptr) radios.push_back(sensor);
    return radios;
}

Loaded with_radio(const std::string& children) {
    return load_elements("<model name='m'>" +
                         link("a", "<roboss:radio name='r'>" + children + "</roboss:radio>") + "</model>");
}

TEST(Comms, AllElementsOfARadioAreRead) {
    const Loaded loaded = with_radio(
        "<pose>0 0 0.5 0 0 0</pose><channel>3</channel><address>base</address><bit_rate>9600</bit_rate>"
        "<latency>0.25</latency><range>70</range><tx_power>14</tx_power><noise_floor>-95</noise_floor>"
        "<l0>31</l0><fading_exponent>3</fading_exponent><sigma>4</sigma><obstacle_loss>6</obstacle_loss>"
        "<loss>0.1</loss><collisions>false</collisions><capture>inf</capture>");
    const auto radios = radios_of(loaded);
    ASSERT_EQ(radios.size(), 1u) << loaded.text();
    EXPECT_EQ(radios[0].name, "r");
    EXPECT_EQ(radios[0].X_LS.p.z, 0.5);
    RadioSpec expected;
    expected.channel = 3, expected.address = "base", expected.bit_rate = 9600, expected.latency = 0.25;
    expected.range = 70, expected.tx_power = 14, expected.noise_floor = -95, expected.l0 = 31;
    expected.fading_exponent = 3, expected.sigma = 4, expected.obstacle_loss = 6, expected.loss = 0.1;
    expected.collisions = false, expected.capture = INFINITY;
    EXPECT_EQ(*radios[0].as<RadioSpec>(), expected);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
}

TEST(Comms, ARadioWithoutElementsHasTheDefaults) {
    const auto radios = radios_of(with_radio(""));
    ASSERT_EQ(radios.size(), 1u);
    EXPECT_EQ(*radios[0].as<RadioSpec>(), RadioSpec{});
}

TEST(Comms, WhatMakesNoSenseIsReported) {
    EXPECT_NE(with_radio("<chanel>3</chanel>").find("unknown-element"), nullptr);
    EXPECT_NE(with_radio("<update_rate>20</update_rate>").find("ignored-element"), nullptr);
    EXPECT_NE(load_elements("<model name='m'>" + link("a") + "<roboss:radio name='r'/></model>")
                  .find("unknown-extension"),
              nullptr);
    for (const char* bad : {"<bit_rate>0</bit_rate>", "<latency>2</latency>", "<range>0</range>",
                            "<sigma>-1</sigma>", "<loss>1.5</loss>", "<capture>-3</capture>",
                            "<obstacle_loss>-1</obstacle_loss>", "<tx_power>nan</tx_power>"}) {
        const Loaded loaded = with_radio(bad);
        EXPECT_TRUE(loaded.diagnostics.has_errors()) << bad << loaded.text();
    }
}

TEST(Comms, EndpointsTakeTheParametersOfRfComms) {
    const Loaded loaded = load_elements(
        comms(
            "RFComms",
            "<range_config><max_range>500000.0</max_range><fading_exponent>1.5</fading_exponent><l0>41</l0>"
            "<sigma>9</sigma></range_config><radio_config><capacity>1000000</capacity><tx_power>20</tx_power>"
            "<noise_floor>-91</noise_floor><modulation>QPSK</modulation></radio_config>") +
        endpoint("one", "<address>addr1</address><topic>addr1/rx</topic>") +
        endpoint("two",
                 "<address>addr2</address><topic>addr2/rx</topic>"
                 "<broker><bind_service>/broker/bind</bind_service></broker>"));
    const auto radios = radios_of(loaded);
    ASSERT_EQ(radios.size(), 2u) << loaded.text();
    RadioSpec expected;
    expected.broker = "/broker/bind", expected.collisions = false, expected.obstacle_loss = 0;
    expected.range = 500'000, expected.fading_exponent = 1.5, expected.l0 = 41, expected.sigma = 9;
    expected.bit_rate = 1e6, expected.tx_power = 20, expected.noise_floor = -91;
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(radios[i].name, "radio");
        expected.address = "addr" + std::to_string(i + 1);
        EXPECT_EQ(*radios[i].as<RadioSpec>(), expected);
    }
    EXPECT_EQ(loaded.world->extensions.at(0).fate, PluginFate::kRuns);
    EXPECT_EQ(loaded.find("plugin"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("comms"), nullptr) << loaded.text();
}

TEST(Comms, BrokersAreToldApartByTheirService) {
    const std::string other = "<broker><bind_service>/other/bind</bind_service></broker>";
    const Loaded loaded = load_elements(comms("RFComms", "") + comms("PerfectComms", other) +
                                        endpoint("one", "<address>a</address>") +
                                        endpoint("two", "<address>b</address>" + other));
    const auto radios = radios_of(loaded);
    ASSERT_EQ(radios.size(), 2u) << loaded.text();
    EXPECT_FALSE(radios[0].as<RadioSpec>()->is_perfect);
    EXPECT_EQ(radios[0].as<RadioSpec>()->range, 50) << "Gazebo's default";
    EXPECT_TRUE(radios[1].as<RadioSpec>()->is_perfect);
    EXPECT_NE(radios[0].as<RadioSpec>()->broker, radios[1].as<RadioSpec>()->broker);
}

TEST(Comms, AnEndpointThatNobodyServesIsReported) {
    const Loaded loaded = load_elements(endpoint("one", "<address>a</address>"));
    EXPECT_NE(loaded.find("comms"), nullptr);
    const Loaded bad = load_elements(comms("RFComms", "<range_config><sigma>-4</sigma></range_config>") +
                                     endpoint("one", "<address>a</address>"));
    EXPECT_NE(bad.find("plugin-not-run"), nullptr);
    EXPECT_EQ(bad.world->extensions.at(0).fate, PluginFate::kNotRun);
    EXPECT_FALSE(bad.diagnostics.has_errors()) << "the models stay";
}

}  // namespace
}  // namespace roboss
