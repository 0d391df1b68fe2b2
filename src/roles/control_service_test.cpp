// A request is handed out once, however often it comes, and answered each time.
#include "roles/control_service.h"

#include <gtest/gtest.h>

#include "bus/in_process_bus.h"

namespace roboss {
namespace {

TEST(ControlService, HandsARequestOutOnceAndAnswersItAsOftenAsItComes) {
    InProcessBus bus;
    ControlService desk;
    const Address asker{Role::kClient, 7};
    const ControlRequest pause{1, {"pause"}};
    desk.take(bus, asker, pause);
    desk.take(bus, asker, pause);
    const std::vector<ControlCall> calls = desk.take_calls();
    ASSERT_EQ(calls.size(), 1u);
    EXPECT_TRUE(desk.take_calls().empty());
    desk.answer(bus, calls[0], true, "paused");
    desk.take(bus, asker, pause);
    std::vector<Envelope> inbox;
    bus.drain(asker, inbox);
    ASSERT_EQ(inbox.size(), 2u);
    for (const Envelope& envelope : inbox) EXPECT_EQ(std::get<ControlReply>(envelope.message).text, "paused");
    desk.take(bus, asker, {2, {"resume"}});
    desk.take(bus, asker, pause);  // a late copy
    desk.take(bus, Address{Role::kClient, 8}, {1, {"pause"}});
    EXPECT_EQ(desk.take_calls().size(), 2u);
}

}  // namespace
}  // namespace roboss
