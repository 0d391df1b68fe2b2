// A request is handed out once, however often it comes, and answered each time.
#include "roles/controller/control_service.h"

#include <gtest/gtest.h>

#include "bus/in_process_bus.h"

namespace roboss {
namespace {

TEST(ControlService, HandsARequestOutOnceAndAnswersItAsOftenAsItComes) {
    InProcessBus bus;
    ControlService service;
    const Address requester{Role::kClient, 7};
    const ControlRequest pause{1, PauseRun{}};
    service.take(bus, requester, pause);
    service.take(bus, requester, pause);
    const std::vector<ControlCall> calls = service.take_calls();
    ASSERT_EQ(calls.size(), 1u);
    EXPECT_TRUE(service.take_calls().empty());
    service.answer(bus, calls[0], ControlDone{5, "paused"});
    service.take(bus, requester, pause);
    std::vector<Envelope> inbox;
    bus.drain(requester, inbox);
    ASSERT_EQ(inbox.size(), 2u);
    for (const Envelope& envelope : inbox)
        EXPECT_EQ(std::get<ControlReply>(envelope.message), (ControlReply{1, ControlDone{5, "paused"}}));
    service.take(bus, requester, {2, ResumeRun{}});
    service.take(bus, requester, pause);  // a late copy
    service.take(bus, Address{Role::kClient, 8}, {1, PauseRun{}});
    EXPECT_EQ(service.take_calls().size(), 2u);
}

TEST(ControlService, RemembersTheYoungestRequestersAndAllThatWait) {
    InProcessBus bus;
    ControlService service;
    service.take(bus, {Role::kClient, 1}, {1, PauseRun{}});
    const ControlCall waits = service.take_calls()[0];
    for (std::uint64_t i = 2; i < 1'000; ++i) {
        service.take(bus, {Role::kClient, i}, {1, PauseRun{}});
        service.answer(bus, service.take_calls()[0], ControlDone{0, "paused"});
    }
    service.take(bus, waits.from, waits.request);
    service.take(bus, {Role::kClient, 999}, {1, PauseRun{}});
    EXPECT_TRUE(service.take_calls().empty()) << "both are known";
    service.take(bus, {Role::kClient, 2}, {1, PauseRun{}});
    EXPECT_EQ(service.take_calls().size(), 1u) << "that one is forgotten";
}

}  // namespace
}  // namespace roboss
