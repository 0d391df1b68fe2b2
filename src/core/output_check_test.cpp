// Outputs that would replace something else.
#include "core/output_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class Outputs : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) /
                  ("roboss_outputs_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    static std::string code(const OutputCheck& check) {
        const Result<> done = check.check();
        return done ? "" : done.error().code;
    }
    /// The check of one output beside an input.
    std::string code_of(const std::string& output, std::string_view kind = "trace") const {
        OutputCheck check;
        check.reads(path("world.sdf"));
        check.writes("--trace", output, kind);
        return code(check);
    }
    fs::path folder_;
};

constexpr const char* kWorld = "<?xml version=\"1.0\"?><sdf version=\"1.9\"/>";
constexpr const char* kTrace = "time_s,robot,link,x,y,z\n0,arm,base,0,0,0\n";

TEST_F(Outputs, NeverReplaceAnInputByWhateverName) {
    file("world.sdf", kWorld);
    fs::create_symlink(path("world.sdf"), path("link.csv"));
    fs::create_hard_link(path("world.sdf"), path("other.csv"));
    fs::create_directory(path("sub"));
    for (const char* name : {"world.sdf", "link.csv", "other.csv", "sub/../world.sdf", "./world.sdf"})
        EXPECT_EQ(code_of(path(name)), "output-is-input") << name;
    EXPECT_EQ(code_of(path("world.sdf"), "world"), "output-is-input") << "of the same kind, too";
}

TEST_F(Outputs, NeverReplaceAFileOfAnotherKind) {
    EXPECT_EQ(code_of(file("notes.txt", "remember the milk")), "other-kind");
    EXPECT_EQ(code_of(file("table.csv", "a,b,c\n1,2,3\n")), "other-kind");
    file("kept.csv", "a,b\n");
    fs::create_symlink(path("kept.csv"), path("link.csv"));
    EXPECT_EQ(code_of(path("link.csv")), "other-kind");
    EXPECT_EQ(code_of(file("robot.urdf", kWorld), "log"), "other-kind");
    EXPECT_EQ(code_of(file("orders.jsonl", "{\"t\":1}"), "log"), "other-kind");
    EXPECT_EQ(code_of(file("bytes", std::string("a\0b", 3)), "log"), "other-kind");
    for (const std::string_view kind : file_kinds()) {
        EXPECT_FALSE(may_become(path("notes.txt"), kind)) << kind;
        EXPECT_EQ(may_become(file("trace.csv", kTrace), kind), kind == "trace") << kind;
    }
}

TEST_F(Outputs, AreAddedOnlyToALogThatIsOne) {
    file("kept.log", "2026-11-30T18:32:25.123Z level=info tick=7 event=end code=done\n");
    EXPECT_EQ(code_of(path("kept.log"), "log"), "");
    for (const char* text : {"v 0 0 0\nf 1 2 3\n", "hi", "a,b\n1,2\n", "2026-11-30 a diary\n", kTrace})
        EXPECT_EQ(code_of(file("other", text), "log"), "other-kind") << text;
}

TEST_F(Outputs, AreXmlOfTheSameRootOnly) {
    const std::string svg =
                          file("a.svg",
                               "<?xml version=\"1.0\"?>\n<!-- <sdf> -->\n<!DOCTYPE svg>\n<svg width=\"1\"/>"),
                      page = file("a.html", "<!doctype html><html lang=\"en\"><svg/></html>"),
                      robot = file("a.urdf", "\xEF\xBB\xBF<!-- the arm <svg> --><robot name=\"arm\"/>"),
                      other = file("a.xml", "<settings><sdf/></settings>");
    EXPECT_EQ(code_of(svg, "svg"), "");
    EXPECT_EQ(code_of(page, "html"), "");
    EXPECT_EQ(code_of(robot, "world"), "");
    for (const std::string& path : {page, robot, other})
        EXPECT_EQ(code_of(path, "svg"), "other-kind") << path;
    for (const std::string& path : {svg, page, other})
        EXPECT_EQ(code_of(path, "world"), "other-kind") << path;
    for (const std::string& path : {svg, robot, other})
        EXPECT_EQ(code_of(path, "html"), "other-kind") << path;
}

TEST_F(Outputs, ReplaceNoTableOrBagOfAnotherProgram) {
    EXPECT_EQ(code_of(file("run.csv", "# roboss {\"facts\": {}}\r\ntime,a.x\r\n"), "table"), "");
    for (const char* text : {"hi", "time,a.x\n0,1\n", "# roboss was here\n", kTrace})
        EXPECT_EQ(code_of(file("mine.csv", text), "table"), "other-kind") << text;
    EXPECT_EQ(code_of(file("run.mcap", "\x89MCAP0\r\n ros2 roboss"), "mcap"), "");
    EXPECT_EQ(code_of(file("bag.mcap", "\x89MCAP0\r\n ros2 libmcap"), "mcap"), "other-kind");
}

TEST_F(Outputs, ReplaceAnOlderOneOfTheirKindAndWhatIsEmptyOrNew) {
    EXPECT_EQ(code_of(file("trace.csv", kTrace)), "");
    EXPECT_EQ(code_of(file("empty.csv", "")), "");
    EXPECT_EQ(code_of(path("new.csv")), "");
    EXPECT_EQ(code_of("/dev/null"), "");
    EXPECT_EQ(code_of("-"), "");
    EXPECT_EQ(code_of(file("picture.png", "\x89PNG\r\n"), "png"), "");
    EXPECT_EQ(code_of(file("summary.json", "{\n  \"world\": \"pile\"\n}\n"), "summary"), "");
}

TEST_F(Outputs, AreNotWrittenIntoOneFile) {
    OutputCheck check;
    check.writes("--trace", path("out.csv"), "trace");
    check.writes("--contacts", path("./out.csv"), "contacts");
    EXPECT_EQ(code(check), "output-twice");
    OutputCheck apart;
    apart.writes("--trace", "-", "trace");
    apart.writes("--contacts", "-", "contacts");
    apart.writes("--json", "/dev/null", "summary");
    apart.writes("--save", "/dev/null", "saved state");
    EXPECT_EQ(code(apart), "");
}

}  // namespace
}  // namespace roboss::test
