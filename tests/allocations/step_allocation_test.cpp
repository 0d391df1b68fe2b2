// Once its buffers have grown, a step allocates nothing: no lock of the allocator, no time that depends on
// its history.
#include <gtest/gtest.h>

#include <memory>

#include "support/allocation_counter.h"
#include "support/car_field.h"

namespace roboss::test {
namespace {

TEST(AllocationCounter, CountsAnAllocation) {
    const std::uint64_t before = allocations();
    const auto number = std::make_unique<volatile int>(3);
    EXPECT_EQ(allocations(), before + 1);
    EXPECT_EQ(*number, 3);
}

TEST(Step, AllocatesNothingOnceItsBuffersHaveGrown) {
    CarField field(20, 0.002);
    field.drive(8, 8);
    for (int tick = 0; tick < 200; ++tick) field.step();
    const std::uint64_t before = allocations();
    field.drive(8, -8);  // from driving to turning on the spot: other contacts slide
    for (int tick = 0; tick < 500; ++tick) field.step();
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(field.contacts(), 20 * 700 * 4);  // the cars stood on their wheels meanwhile
}

}  // namespace
}  // namespace roboss::test
