// Heads of PLY files, sound and damaged.
#include "mesh/check_ply.h"

#include <gtest/gtest.h>

#include <string>

#include <support/folder.h>

#include "mesh/mesh_file.h"

namespace roboss {
namespace {

const std::string kHead =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
    "float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string with(const std::string& old, const std::string& fresh) {
    std::string text = kHead + kBody;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), fresh);
}

std::size_t triangles_in(const std::string& text) {
    const test::Folder folder;
    const auto mesh = read_mesh({folder.write("a.ply", text), {1, 1, 1}, "", false});
    return mesh.ok() ? mesh.value().mesh.triangles.size() : 0;
}

void expect_refused(const std::string& text) {
    EXPECT_FALSE(check_ply(text).ok()) << text;
    EXPECT_EQ(triangles_in(text), 0u);
}

TEST(CheckPly, SoundFilesAreRead) {
    for (const std::string& text :
         {kHead + kBody, kHead + kBody.substr(0, kBody.size() - 1),
          with("element face", "comment x\nelement face"),
          with("end_header", "obj_info num_cols 512\nend_header"), with("float x", "double x"),
          with("element face", "element edge 0\nproperty int a\nelement face")}) {
        EXPECT_TRUE(check_ply(text).ok()) << text;
        EXPECT_EQ(triangles_in(text), 1u) << text;
    }
    std::string windows;
    for (const char c : kHead) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_TRUE(check_ply(windows + kBody).ok());
}

TEST(CheckPly, AHeadWithoutEndIsRefused) {
    expect_refused(with("end_header", "endheader"));
    expect_refused(kHead.substr(0, 60));
    expect_refused("");
}

TEST(CheckPly, MoreIsNotAnnouncedThanIsThere) {
    for (const char* count : {"30", "-1", "4000000000", "4294967296", "99999999999999999999", "x", ""}) {
        expect_refused(with("vertex 3", "vertex " + std::string(count)));
        expect_refused(with("face 1", "face " + std::string(count)));
    }
    expect_refused(kHead);
    std::string binary = with("ascii", "binary_little_endian");
    expect_refused(binary);
    EXPECT_TRUE(check_ply(binary.substr(0, binary.size() - kBody.size()) + std::string(49, '\0')).ok());
}

TEST(CheckPly, AFaceHasVerticesThatAreThere) {
    EXPECT_EQ(triangles_in(with("3 0 1 2", "3 0 1 3")), 0u);
    EXPECT_EQ(triangles_in(with("3 0 1 2", "4 0 1 2 9")), 0u);
    EXPECT_EQ(triangles_in(with("3 0 1 2", "3 0 1 -2")), 0u);
}

}  // namespace
}  // namespace roboss
