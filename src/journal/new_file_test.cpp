// A new file is whole or not there, and no link that somebody laid leads it elsewhere.
#include "journal/new_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace roboss {
namespace {

namespace fs = std::filesystem;

class NewFiles : public testing::Test {
  protected:
    NewFiles() {
        folder =
            fs::path(testing::TempDir()) /
            ("roboss_new_file_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    ~NewFiles() override { fs::remove_all(folder); }
    std::string at(const char* name) const { return (folder / name).string(); }
    static void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
    static std::string read(const std::string& path) {
        std::ifstream in(path);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder), {}); }
    fs::path folder;
};

TEST_F(NewFiles, AppearWhenTheyAreCompleteAndReplaceTheOldOne) {
    write(at("run"), "old");
    {
        Result<NewFile> file = NewFile::beside(at("run"));
        ASSERT_TRUE(file.ok()) << file.error().text();
        write(file.value().own_path(), "new");
        EXPECT_EQ(read(at("run")), "old");
        ASSERT_TRUE(file.value().publish().ok());
        EXPECT_EQ(read(at("run")), "new");
    }
    EXPECT_EQ(files(), 1);
}

TEST_F(NewFiles, LeaveNothingWhereTheyAreNotPublished) {
    {
        Result<NewFile> file = NewFile::beside(at("run"));
        ASSERT_TRUE(file.ok());
        EXPECT_EQ(files(), 1);
    }
    EXPECT_EQ(files(), 0);
    fs::create_directories(folder / "taken" / "inside");
    {
        Result<NewFile> file = NewFile::beside(at("taken"));
        ASSERT_TRUE(file.ok());
        const Result<> published = file.value().publish();
        ASSERT_FALSE(published.ok()) << "a folder is in the way";
        EXPECT_NE(published.error().message.find("taken"), std::string::npos);
    }
    EXPECT_EQ(files(), 1) << "the folder";
}

TEST_F(NewFiles, HaveANameThatNobodyCanForesee) {
    write(at("victim"), "precious");
    fs::create_symlink(at("victim"), at("run.part"));
    Result<NewFile> one = NewFile::beside(at("run")), other = NewFile::beside(at("run"));
    ASSERT_TRUE(one.ok() && other.ok());
    EXPECT_NE(one.value().own_path(), other.value().own_path());
    EXPECT_NE(one.value().own_path(), at("run.part"));
    write(one.value().own_path(), "state");
    ASSERT_TRUE(one.value().publish().ok());
    EXPECT_EQ(read(at("victim")), "precious");
}

TEST_F(NewFiles, ReplaceALinkAndNotWhatItPointsTo) {
    write(at("victim"), "precious");
    fs::create_symlink(at("victim"), at("run"));
    Result<NewFile> file = NewFile::beside(at("run"));
    ASSERT_TRUE(file.ok());
    write(file.value().own_path(), "state");
    ASSERT_TRUE(file.value().publish().ok());
    EXPECT_EQ(read(at("run")), "state");
    EXPECT_EQ(read(at("victim")), "precious");
}

TEST_F(NewFiles, AreRefusedByNameInAFolderThatIsNotThere) {
    const Result<NewFile> file = NewFile::beside(at("no/such/run"));
    ASSERT_FALSE(file.ok());
    EXPECT_NE(file.error().message.find("no/such/run"), std::string::npos);
}

}  // namespace
}  // namespace roboss
