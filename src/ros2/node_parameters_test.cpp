// Parameters of a node, read and set by others.
#include "ros2/node_parameters.h"

#include <gtest/gtest.h>

#include <support/ros2_transport.h>

namespace roboss::ros2 {
namespace {

namespace rcl = rcl_interfaces;

struct Node {
    test::TestTransport transport;
    NodeParameters parameters{transport, transport.add_node("/", "roboss"), "/roboss"};

    Node() {
        parameters.put("use_sim_time", parameter_value(true), "times are simulated");
        parameters.put_settable("scan.rate", parameter_value(10.0), "Hz", [](const rcl::ParameterValue& v) {
            return v.double_value > 0 ? "" : "a rate is positive";
        });
    }
    template <Service S>
    typename S::Response call(const std::string& service, const typename S::Request& request) {
        const std::int64_t number = transport.call("/roboss/" + service, to_cdr(request));
        for (const Incoming& call : transport.take(0)) EXPECT_TRUE(parameters.take(call));
        const auto response = from_cdr<typename S::Response>(transport.replies.at(number).front());
        EXPECT_TRUE(response);
        return response.value();
    }
};

TEST(NodeParameters, AreReadListedAndDescribed) {
    Node node;
    const auto values = node.call<rcl::GetParameters>("get_parameters", {{"use_sim_time", "nothing"}}).values;
    ASSERT_EQ(values.size(), 2u);
    EXPECT_EQ(values[0].type, rcl::kBool);
    EXPECT_TRUE(values[0].bool_value);
    EXPECT_EQ(values[1].type, rcl::kNotSet);
    EXPECT_EQ(node.call<rcl::GetParameterTypes>("get_parameter_types", {{"scan.rate"}}).types,
              (std::vector<std::uint8_t>{rcl::kDouble}));
    const auto all = node.call<rcl::ListParameters>("list_parameters", {}).result;
    EXPECT_EQ(all.names, (std::vector<std::string>{"scan.rate", "use_sim_time"}));
    EXPECT_EQ(all.prefixes, (std::vector<std::string>{"scan"}));
    EXPECT_EQ(node.call<rcl::ListParameters>("list_parameters", {{}, 1}).result.names,
              (std::vector<std::string>{"use_sim_time"}));
    EXPECT_EQ(node.call<rcl::ListParameters>("list_parameters", {{"scan"}, 0}).result.names,
              (std::vector<std::string>{"scan.rate"}));
    const auto described = node.call<rcl::DescribeParameters>("describe_parameters", {{"use_sim_time"}});
    EXPECT_TRUE(described.descriptors.at(0).read_only);
}

TEST(NodeParameters, AreSetAsFarAsTheyMayBe) {
    Node node;
    const auto results =
        node.call<rcl::SetParameters>("set_parameters", {{{"scan.rate", parameter_value(20.0)},
                                                          {"scan.rate", parameter_value(-1.0)},
                                                          {"scan.rate", parameter_value(std::int64_t{5})},
                                                          {"use_sim_time", parameter_value(false)},
                                                          {"nothing", parameter_value(true)}}})
            .results;
    ASSERT_EQ(results.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(results[i].successful, i == 0) << results[i].reason;
    EXPECT_EQ(node.parameters.value("scan.rate").double_value, 20);
    const auto both = node.call<rcl::SetParametersAtomically>(
        "set_parameters_atomically",
        {{{"scan.rate", parameter_value(30.0)}, {"use_sim_time", parameter_value(false)}}});
    EXPECT_FALSE(both.result.successful);
    EXPECT_EQ(node.parameters.value("scan.rate").double_value, 20) << "all or none";
    EXPECT_EQ(node.transport.published["/parameter_events"].size(), 3u);
}

}  // namespace
}  // namespace roboss::ros2
