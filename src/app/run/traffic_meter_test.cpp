// Rates are differences over time, both ways, by member; a Bus that begins anew begins at zero.
#include "app/run/traffic_meter.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

const Address kOne{Role::kSimulator, 1}, kTwo{Role::kSimulator, 2}, kViewer{Role::kClient, 9};

TEST(TrafficMeter, TellsWhatWentToAndFromTheControllerInASecond) {
    TrafficMeter meter;
    EXPECT_TRUE(meter.due(0));
    meter.take(std::vector<Flow>{{kOne, kControllerAddress, 100, 5000}}, 1'000);
    EXPECT_FALSE(meter.due(1'999));
    EXPECT_TRUE(meter.due(2'000));
    meter.take(std::vector<Flow>{{kOne, kControllerAddress, 300, 9000},
                                 {kControllerAddress, kOne, 40, 800},
                                 {kTwo, kControllerAddress, 10, 20},
                                 {kOne, kViewer, 7777, 7777}},
               3'000);
    EXPECT_EQ(meter.of(kOne).messages_in, 100);
    EXPECT_EQ(meter.of(kOne).bytes_in, 2000);
    EXPECT_EQ(meter.of(kOne).messages_out, 20);
    EXPECT_EQ(meter.of(kTwo).bytes_in, 10);
    EXPECT_EQ(meter.of(kViewer).messages_in, 0) << "not the Controller's";
    EXPECT_EQ(meter.total().messages_in, 105);
    EXPECT_EQ(meter.total().bytes_out, 400);
    meter.take(std::vector<Flow>{{kOne, kControllerAddress, 5, 50}}, 4'000);
    EXPECT_EQ(meter.of(kOne).messages_in, 5) << "counted from zero again";
    EXPECT_EQ(meter.of(kTwo).messages_in, 0);
}

}  // namespace
}  // namespace roboss
