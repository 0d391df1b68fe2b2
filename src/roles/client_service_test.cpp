// How far the world may go is what its Clients allow.
#include "roles/client_service.h"

#include <gtest/gtest.h>

#include <limits>

namespace roboss {
namespace {

ClientHello hello(const std::string& name, Tick period, Tick latency, bool synchronous = true) {
    return {name, 0, period, latency, synchronous};
}

TEST(ClientService, GivesExpectedClientsTheirPlacesWhoeverComesFirst) {
    ClientService desk({"a", "b"});
    bool is_new = false;
    EXPECT_EQ(desk.welcome({Role::kClient, 7}, hello("b", 10, 10), 0, is_new), ClientId(1u));
    EXPECT_TRUE(is_new);
    EXPECT_FALSE(desk.all_joined());
    EXPECT_EQ(desk.welcome({Role::kClient, 8}, hello("a", 10, 10), 0, is_new), ClientId(0u));
    EXPECT_TRUE(desk.all_joined());
    EXPECT_EQ(desk.welcome({Role::kClient, 7}, hello("b", 10, 10), 0, is_new), ClientId(1u));
    EXPECT_FALSE(is_new);
    EXPECT_EQ(desk.welcome({Role::kClient, 9}, hello("c", 10, 10), 13, is_new), ClientId(2u));
    EXPECT_EQ(desk.seats()[2].first, 20);
}

TEST(ClientService, StopsAtTheNextObservationAndWhereOrdersMayStillCome) {
    ClientService desk({});
    EXPECT_EQ(desk.limit(5), std::numeric_limits<Tick>::max());
    bool is_new = false;
    (void)desk.welcome({Role::kClient, 1}, hello("a", 10, 4), 0, is_new);
    ClientSeat& seat = desk.seats()[0];
    EXPECT_EQ(desk.limit(3), 10);
    seat.unanswered = {10};
    EXPECT_EQ(desk.limit(10), 14) << "its orders may apply from tick 14 on";
    EXPECT_EQ(desk.limit(14), 14) << "wait for its word";
    seat.unanswered.clear();
    EXPECT_EQ(desk.limit(14), 20);
    seat.gone = true;
    EXPECT_EQ(desk.limit(14), std::numeric_limits<Tick>::max());
}

TEST(ClientService, AFreeRunningClientMakesBoundariesButNobodyWaits) {
    ClientService desk({});
    bool is_new = false;
    (void)desk.welcome({Role::kClient, 1}, hello("a", 10, 0, false), 0, is_new);
    desk.seats()[0].unanswered = {10};
    EXPECT_EQ(desk.limit(10), 20);
    EXPECT_EQ(desk.limit(19), 20);
}

}  // namespace
}  // namespace roboss
