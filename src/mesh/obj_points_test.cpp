// Points of OBJ files without faces, and what is refused.
#include "mesh/obj_points.h"

#include <gtest/gtest.h>

#include <support/folder.h>

namespace roboss {
namespace {

class ObjPoints : public ::testing::Test {
  protected:
    Result<MeshSpec> read(const std::string& text) const {
        return read_obj_points(folder_.write("points.obj", text));
    }

  private:
    test::Folder folder_;
};

TEST_F(ObjPoints, AreReadWithNamesNormalsAndBlankLinesBetween) {
    const auto mesh =
        read("# made by hand\no thing\nv 0 0 0\nv 1 0 0.5\n\nvn 0 0 1\nv 0 1 0 1 1 1\r\nv 0 0 1e-1\n");
    ASSERT_TRUE(mesh);
    ASSERT_EQ(mesh.value().vertices.size(), 4u);
    EXPECT_EQ(mesh.value().vertices[1].z, 0.5);
    EXPECT_EQ(mesh.value().vertices[3].z, static_cast<double>(0.1f));
    EXPECT_TRUE(mesh.value().triangles.empty());
}

TEST_F(ObjPoints, OfFilesWithFacesWithTooFewPointsOrBadNumbersAreRefused) {
    EXPECT_FALSE(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"));
    EXPECT_FALSE(read("v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    EXPECT_FALSE(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0\n"));
    EXPECT_FALSE(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 inf\n"));
    EXPECT_FALSE(read_obj_points("/no/such/file.obj"));
}

}  // namespace
}  // namespace roboss
