// Where a run writes for others: below one folder, and over nothing that it was not asked to replace.
#include "app/run/save_place.h"

#include <gtest/gtest.h>

#include <fstream>

#include <support/compiling.h>
#include <support/robots.h>
#include "journal/saved_run.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class SavePlace : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(root_);
        fs::create_directories(folder_ / "inner");
        fs::create_directories(root_ / "outside");
    }
    void TearDown() override { fs::remove_all(root_); }
    std::string code(const std::string& file, bool overwrite = false,
                     const std::vector<std::string>& in_use = {}) {
        const Result<fs::path> place = save_place(folder_.string(), {file, overwrite}, in_use);
        return place ? "" : place.error().code;
    }
    /// A file that is a saved run.
    void save(const fs::path& file) {
        World world = empty_world(1e-3);
        place(world, solid_box(1, {1, 1, 1}, surface(1)), "box");
        Diagnostics diagnostics;
        const auto model = compile(world, {}, diagnostics);
        SavedRun run;
        run.states.push_back(initial_state(*model, RobotId(0u)));
        ASSERT_TRUE(save_run(file.string(), *model, run));
    }

    // Of this test alone: others run at the same time.
    fs::path root_ = fs::canonical(testing::TempDir()) /
                     (std::string("roboss_save_place_") +
                      testing::UnitTest::GetInstance()->current_test_info()->name()),
             folder_ = root_ / "folder";
};

TEST_F(SavePlace, IsBelowTheFolder) {
    EXPECT_EQ(save_place(folder_.string(), {"a.roboss"}, {}).value(), folder_ / "a.roboss");
    EXPECT_EQ(save_place(folder_.string(), {"inner/a.roboss"}, {}).value(), folder_ / "inner/a.roboss");
    EXPECT_EQ(save_place(folder_.string(), {(folder_ / "a.roboss").string()}, {}).value(),
              folder_ / "a.roboss");
    EXPECT_EQ(code("inner/../a.roboss"), "");
    EXPECT_EQ(code("missing/a.roboss"), "no-folder");
}

TEST_F(SavePlace, IsNowhereElse) {
    for (const char* file : {"../a.roboss", "/tmp/a.roboss", "/etc/passwd", "inner/../../a.roboss", "..", ".",
                             "", "inner/", "missing/../../a.roboss", "../folder_2/a.roboss", "/"})
        EXPECT_EQ(code(file), "outside-folder") << file;
    EXPECT_EQ(code((root_ / "outside" / "a.roboss").string(), true), "outside-folder");
    EXPECT_EQ(code(std::string("a\0b", 3)), "outside-folder");
    fs::create_directories(root_ / "folder_2");
    EXPECT_EQ(code((root_ / "folder_2" / "a").string()), "outside-folder") << "a folder of a similar name";
}

TEST_F(SavePlace, NoLinkLeadsOut) {
    fs::create_symlink(root_ / "outside", folder_ / "link");
    EXPECT_EQ(code("link/a.roboss"), "outside-folder");
    std::ofstream(root_ / "outside" / "victim") << "text";
    fs::create_symlink(root_ / "outside" / "victim", folder_ / "b.roboss");
    EXPECT_EQ(code("b.roboss"), "file-exists");
    EXPECT_EQ(code("b.roboss", true), "not-a-saved-run");
    fs::create_symlink(root_ / "outside" / "nothing", folder_ / "c.roboss");
    EXPECT_EQ(code("c.roboss"), "file-exists") << "a link to a file that does not exist";
}

TEST_F(SavePlace, AnExistingFileIsReplacedOnlyIfAskedAndIfItIsASavedRun) {
    save(folder_ / "a.roboss");
    EXPECT_EQ(code("a.roboss"), "file-exists");
    EXPECT_EQ(code("a.roboss", true), "");
    EXPECT_EQ(code("a.roboss", true, {"other", (folder_ / "inner/../a.roboss").string()}), "file-in-use");
    fs::create_hard_link(folder_ / "a.roboss", folder_ / "b.roboss");
    EXPECT_EQ(code("b.roboss", true, {(folder_ / "a.roboss").string()}), "file-in-use") << "by another name";
    std::ofstream(folder_ / "notes.txt") << "text";
    EXPECT_EQ(code("notes.txt"), "file-exists");
    EXPECT_EQ(code("notes.txt", true), "not-a-saved-run");
    EXPECT_EQ(code("inner", true), "not-a-saved-run");
}

TEST_F(SavePlace, AFolderThatIsGoneIsNamed) {
    fs::remove_all(folder_);
    EXPECT_EQ(code("a.roboss"), "no-folder");
}

}  // namespace
}  // namespace roboss::test
