#include "mesh/msh_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

namespace roboss {
namespace {

/// A file of these counts and words that goes away with the object.
class MshFile : public testing::Test {
  protected:
    std::string write(const std::vector<std::int32_t>& counts, const std::vector<float>& floats,
                      const std::vector<std::int32_t>& faces) {
        std::ofstream file(path_, std::ios::binary);
        const auto put = [&](const auto& numbers) {
            file.write(reinterpret_cast<const char*>(numbers.data()),
                       static_cast<std::streamsize>(4 * numbers.size()));
        };
        put(counts), put(floats), put(faces);
        return path_;
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    std::string path_ = (std::filesystem::temp_directory_path() /
                         ("roboss-msh-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
                          testing::UnitTest::GetInstance()->current_test_info()->name()))
                            .string();
};

TEST_F(MshFile, HasVerticesAndTriangles) {
    const auto mesh = read_msh(write({3, 1, 1, 1}, {0, 0, 0, 1, 0, 0, 0, 2, .5f, 9, 9, 9, 8, 8}, {0, 1, 2}));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh.value().vertices[2], (Vec3{0, 2, .5}));
    EXPECT_EQ(mesh.value().triangles.at(0), (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST_F(MshFile, IsRefusedWhereItIsBroken) {
    EXPECT_FALSE(read_msh("/nonexistent/file.msh"));
    EXPECT_FALSE(read_msh(write({3, 0}, {}, {})));
    EXPECT_FALSE(read_msh(write({-1, 0, 0, 0}, {}, {})));
    EXPECT_FALSE(read_msh(write({2, 0, 0, 0}, {0, 0, 0}, {})));
    EXPECT_FALSE(read_msh(write({1, 0, 0, 1}, {0, 0, 0}, {0, 0, 1})));
    EXPECT_FALSE(read_msh(write({1, 0, 0, 0}, {0, 0, std::numeric_limits<float>::infinity()}, {})));
}

}  // namespace
}  // namespace roboss
