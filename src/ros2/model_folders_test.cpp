// Only descriptions in the folders that a user named are read.
#include "ros2/model_folders.h"

#include <gtest/gtest.h>

#include <support/folder.h>

#include <filesystem>

#include "ros2/model_text.h"

namespace roboss::ros2 {
namespace {

TEST(ModelText, SaysFormatNameAndPlace) {
    const auto sdf =
        read_model_text(R"(<sdf version="1.9"><model name="a"><pose>1 2 3 0 0 1.5</pose></model></sdf>)");
    ASSERT_TRUE(sdf);
    EXPECT_EQ(sdf.value().format, "sdf");
    EXPECT_EQ(sdf.value().name, "a");
    EXPECT_EQ(sdf.value().X_FM.p, (Vec3{1, 2, 3}));
    EXPECT_EQ(read_model_text(R"(<robot name="b"/>)").value().format, "urdf");
    EXPECT_EQ(read_model_text(R"(<mujoco model="c"/>)").value().name, "c");
    EXPECT_EQ(read_model_text("<usd/>").value().format, "");
    EXPECT_FALSE(read_model_text("#usda 1.0"));
    const auto two = read_model_text(R"(<sdf version="1.9"><model name="a"/><model name="b"/></sdf>)");
    EXPECT_EQ(two.value().name, "") << "of several models none has the name";
}

TEST(ModelFolders, OnlyDescriptionsInTheFoldersAreRead) {
    const test::Folder folder;
    folder.write("models/box/model.config", "<model/>");
    folder.write("models/arm.urdf", "<robot/>");
    folder.write("models/notes.txt", "private");
    folder.write("secret.sdf", "<sdf/>");
    std::filesystem::create_symlink(folder.path("secret.sdf"), folder.path("models/link.sdf"));
    const ModelFolders folders({folder.path("models"), folder.path("absent")});
    std::vector<std::string> uris;
    for (const ModelFile& file : folders.list()) uris.push_back(file.uri);
    ASSERT_EQ(uris.size(), 3u);
    EXPECT_TRUE(uris.front().ends_with("/arm.urdf"));
    EXPECT_EQ(uris.back(), "model://box");
    EXPECT_EQ(folders.read("arm.urdf").value().text, "<robot/>");
    EXPECT_EQ(folders.read("file://" + folder.path("models/arm.urdf")).value().file, "arm.urdf");
    EXPECT_NE(folders.read("model://a&b").value().text.find("<uri>model://a&amp;b</uri>"), std::string::npos);
    for (const std::string& wanted : {folder.path("secret.sdf"), std::string("../secret.sdf"),
                                      std::string("link.sdf"), std::string("none.sdf")})
        EXPECT_EQ(folders.read(wanted).error().code, "no-file") << wanted;
    EXPECT_EQ(folders.read("notes.txt").error().code, "bad-format");
}

}  // namespace
}  // namespace roboss::ros2
