// Copies on a grid: names, places and what is refused.
#include "app/commands/add_copies.h"

#include <gtest/gtest.h>

#include "client/control_text.h"

namespace roboss {
namespace {

std::vector<CopyPlace> copies_of(const CopyOptions& options) {
    const Result<std::string> text = copies_text(options);
    if (!text.ok()) return {};
    const auto action = parse_control({"add", "f", "", "0 0 0 0 0 0", "", text.value()});
    EXPECT_TRUE(action.ok());
    return action.ok() ? std::get<AddModels>(action.value()).copies : std::vector<CopyPlace>{};
}

TEST(AddCopies, StandOnASquareGridAndAreCountedByName) {
    const std::vector<CopyPlace> copies = copies_of({5, "", "", "1 2 3 0 0 1.5", "", "robots/cart.sdf"});
    ASSERT_EQ(copies.size(), 5u);
    EXPECT_EQ(copies[0], (CopyPlace{"cart_0", {{1, 2, 3}, from_rpy(0, 0, 1.5)}}));
    EXPECT_EQ(copies[4].name, "cart_4");
    EXPECT_EQ(copies[4].X_WA.p, (Vec3{2, 3, 3})) << "three columns";
}

TEST(AddCopies, TakeTheGridThatIsGiven) {
    const std::vector<CopyPlace> copies = copies_of({4, "0.5 -2 2", "", "0 0 0 0 0 0", "a", "x.sdf"});
    ASSERT_EQ(copies.size(), 4u);
    EXPECT_EQ(copies[3].name, "a_3");
    EXPECT_EQ(copies[3].X_WA.p, (Vec3{0.5, -2, 0}));
}

TEST(AddCopies, RefuseWhatIsNoGrid) {
    for (const char* grid : {"1", "a b", "1 2 0", "1 2 3 4", "1 2 x"})
        EXPECT_EQ(copies_text({4, grid, "", "0 0 0 0 0 0", "a", "x.sdf"}).error().code, "bad-grid") << grid;
    EXPECT_EQ(copies_text({4, "", "", "0 0", "a", "x.sdf"}).error().code, "bad-pose");
    EXPECT_EQ(copies_text({4, "", "/no/such/file", "0 0 0 0 0 0", "a", "x.sdf"}).error().code, "no-file");
}

}  // namespace
}  // namespace roboss
