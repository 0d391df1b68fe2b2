// Heaps that once broke the solver, by their seeds. What they had in common: contacts whose friction bound is
// a number like 1e-180, and cars jammed so hard that a friction disc has no room left that doubles could
// tell.
#include <gtest/gtest.h>

#include <support/scenes.h>

namespace roboss::test {
namespace {

TEST(Heap, StatesStayFiniteInHeapsThatBrokeTheInteriorPoint) {
    for (const std::uint64_t seed : {294u, 467u, 719u, 746u, 1035u, 3073u}) {
        Simulation sim(random_crowd(seed, 2 + static_cast<int>(seed % 9)));
        stir(sim, seed);
        for (int i = 0; i < 40; ++i) {
            sim.step();
            ASSERT_FALSE(sim.report.not_finite.valid()) << "seed " << seed << ", tick " << i;
        }
    }
}

}  // namespace
}  // namespace roboss::test
