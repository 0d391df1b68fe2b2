// Bags: what is in them is handed on; what is wrong with them is said, whatever their bytes are.
#include "bags/bag.h"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include <support/folder.h>
#include <support/fuzz_rounds.h>

#include "bags/test_bags.h"

namespace roboss::bags::test {
namespace {

using roboss::test::Folder;
using Lines = std::vector<std::string>;

std::string in_zstd(const std::string& bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
    return packed;
}

std::string in_lz4(const std::string& bytes) {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
    return packed;
}

std::string packed(const std::string& compression, const std::string& bytes) {
    return compression == "zstd" ? in_zstd(bytes) : compression == "lz4" ? in_lz4(bytes) : bytes;
}

std::string chunk_in(const std::string& compression, const std::string& records) {
    return chunk(records.size(), checksum_of(records), compression, packed(compression, records));
}

const std::string kTopics = schema(1, "std_msgs/msg/Bool") + channel(4, 1, "/a") + channel(9, 1, "/b");

class Bags : public testing::Test {
  protected:
    Lines read(const std::string& path, const std::string& prefix = "/") {
        ListingSink sink(prefix);
        diagnostics_ = {};
        earliest_ns_ = read_bag(path, sink, diagnostics_);
        types_ = sink.types;
        return sink.lines;
    }
    Lines read_bytes(const std::string& bytes) { return read(folder_.write("bag.mcap", bytes)); }
    /// The code of the only finding.
    std::string finding() const {
        if (diagnostics_.items().size() != 1)
            return std::to_string(diagnostics_.items().size()) + " findings";
        return diagnostics_.items().front().code;
    }
    std::string code_of(const std::string& bytes) {
        read_bytes(bytes);
        EXPECT_TRUE(diagnostics_.has_errors());
        return finding();
    }

    Folder folder_;
    Diagnostics diagnostics_;
    std::optional<std::int64_t> earliest_ns_;
    Lines types_;
};

TEST_F(Bags, AnMcapFileIsReadWithAndWithoutChunksInEachCompression) {
    const std::string messages = message(4, 5, "one") + message(9, 3, "two") + message(4, 8, "");
    const Lines expected{"/a#1@5=one", "/b#1@3=two", "/a#2@8="};
    EXPECT_EQ(read_bytes(mcap(kTopics + messages)), expected);
    EXPECT_EQ(types_.front(), "std_msgs/msg/Bool cdr");
    EXPECT_EQ(earliest_ns_, 3);
    for (const std::string compression : {"", "zstd", "lz4"}) {
        EXPECT_EQ(read_bytes(mcap(chunk_in(compression, kTopics + messages))), expected) << compression;
        EXPECT_EQ(read_bytes(mcap(kTopics + chunk_in(compression, message(4, 5, "one")) + record(7, "index") +
                                  chunk_in(compression, kTopics + message(9, 3, "two") + message(4, 8, "")))),
                  expected)
            << compression;
        EXPECT_TRUE(diagnostics_.items().empty());
    }
}

TEST_F(Bags, RecordsOfOtherKindsArePassedOver) {
    EXPECT_EQ(read_bytes(mcap(record(9, std::string(1'000, 'x')) + kTopics + record(200, "") +
                              message(4, 5, "one") + record(12, "metadata"))),
              (Lines{"/a#1@5=one"}));
    EXPECT_TRUE(diagnostics_.items().empty());
}

TEST_F(Bags, TimesOfMessagesThatNobodyWantsCount) {
    const std::string file = folder_.write("bag.mcap", mcap(kTopics + message(4, 5, "") + message(9, 7, "")));
    EXPECT_EQ(read(file, "/b"), (Lines{"/b#1@7="}));
    EXPECT_EQ(earliest_ns_, 5);
    EXPECT_TRUE(read(folder_.write("empty.mcap", mcap(kTopics))).empty());
    EXPECT_FALSE(earliest_ns_.has_value());
}

TEST_F(Bags, AnUnfinishedFileIsReadAsFarAsItGoesWithAWarning) {
    const std::string whole = unfinished_mcap(kTopics + message(4, 5, "one"));
    for (const std::string& rest : {std::string(), message(4, 6, "two").substr(0, 20), std::string(64, '\0'),
                                    chunk_in("zstd", kTopics + message(4, 6, "two")).substr(0, 60)}) {
        EXPECT_EQ(read_bytes(whole + rest), (Lines{"/a#1@5=one"}));
        EXPECT_EQ(finding(), "truncated");
        EXPECT_FALSE(diagnostics_.has_errors());
    }
}

TEST_F(Bags, DamagedRecordsAreErrors) {
    EXPECT_EQ(code_of(mcap(message(4, 5, ""))), "bad-record") << "no channel";
    EXPECT_EQ(code_of(mcap(record(5, "short"))), "bad-record");
    EXPECT_EQ(code_of(mcap(record(4, bytes_of(std::uint32_t{0}) + bytes_of(~std::uint32_t{0})))),
              "bad-record")
        << "a name of 4 GiB";
    EXPECT_EQ(code_of(mcap("\x05" + bytes_of(~std::uint64_t{0}))), "bad-record")
        << "a record beyond the file";
    EXPECT_EQ(code_of(mcap(record(0, ""))), "bad-record");
    EXPECT_EQ(code_of(mcap(kTopics + message(4, ~std::uint64_t{0}, ""))), "bad-time");
    EXPECT_EQ(code_of(mcap(chunk_of("abc"))), "bad-record");
    EXPECT_EQ(code_of(mcap(chunk_of(chunk_of(kTopics)))), "bad-record") << "a chunk in a chunk";
    EXPECT_EQ(code_of(mcap(chunk_of("\x05" + bytes_of(~std::uint64_t{0})))), "bad-record");
    EXPECT_EQ(code_of(""), "not-a-bag");
    EXPECT_EQ(code_of("{}"), "not-a-bag") << "its name says that it is a bag";
}

TEST_F(Bags, DamagedChunksAreErrors) {
    EXPECT_EQ(code_of(mcap(chunk(kTopics.size(), 1, "", kTopics))), "bad-crc");
    EXPECT_EQ(code_of(mcap(chunk(1, 0, "", kTopics))), "bad-record");
    EXPECT_EQ(code_of(mcap(chunk(kTopics.size(), 0, "snappy", kTopics))), "unknown-compression");
    EXPECT_EQ(code_of(mcap(chunk(std::uint64_t{1} << 40, 0, "zstd", in_zstd(kTopics)))), "too-large");
    for (const std::string compression : {"zstd", "lz4"}) {
        const std::string good = packed(compression, kTopics);
        for (const std::size_t size :
             {kTopics.size() - 1, kTopics.size() + 1, std::size_t{0}, std::size_t{1} << 30})
            EXPECT_EQ(code_of(mcap(chunk(size, 0, compression, good))), "bad-compression") << size;
        EXPECT_EQ(code_of(mcap(chunk(kTopics.size(), 0, compression, good.substr(0, good.size() - 3)))),
                  "bad-compression");
        EXPECT_EQ(code_of(mcap(chunk(kTopics.size(), 0, compression, "garbage"))), "bad-compression");
    }
    EXPECT_TRUE(read_bytes(mcap(chunk(kTopics.size(), 0, "", kTopics))).empty());
    EXPECT_TRUE(diagnostics_.items().empty()) << "a CRC of 0: there is none";
}

TEST_F(Bags, AChunkThatUnpacksToMoreThanItSaysIsAnError) {
    const std::string bomb = in_zstd(std::string(std::size_t{1} << 28, 'x'));
    EXPECT_LT(bomb.size(), 100'000u);
    EXPECT_EQ(code_of(mcap(chunk(1'000, 0, "zstd", bomb))), "bad-compression");
}

TEST_F(Bags, AnSqliteFileIsRead) {
    const std::string file = folder_.path("bag.db3");
    ASSERT_TRUE(write_db3(file, {{"/a", "std_msgs/msg/Bool"}, {"/b", "std_msgs/msg/Bool", "json"}},
                          {{1, 5, "one"}, {2, 3, "two"}, {1, 8, ""}})
                    .ok());
    EXPECT_EQ(read(file), (Lines{"/a#1@5=one", "/b#1@3=two", "/a#2@8="}));
    EXPECT_EQ(types_, (Lines{"std_msgs/msg/Bool cdr", "std_msgs/msg/Bool json", "std_msgs/msg/Bool cdr"}));
    EXPECT_TRUE(diagnostics_.items().empty());
    EXPECT_EQ(read(file, "/a"), (Lines{"/a#1@5=one", "/a#2@8="}));
    EXPECT_EQ(earliest_ns_, 3);
    EXPECT_TRUE(read(file, "/c").empty());
    EXPECT_EQ(earliest_ns_, 3);
}

TEST_F(Bags, AnSqliteFileWithOtherContentIsRefused) {
    const auto code = [&](const std::vector<std::string>& statements) {
        const std::string file = folder_.path("other.db3");
        std::filesystem::remove(file);
        auto database = std::move(Database::open_write(file)).value();
        for (const std::string& sql : statements) EXPECT_TRUE(database.run(sql).ok()) << sql;
        read(file);
        return finding();
    };
    const std::string topics = "CREATE TABLE topics(id, name, type, serialization_format)",
                      messages = "CREATE TABLE messages(id, topic_id, timestamp, data)",
                      a = "INSERT INTO topics VALUES (1, '/a', 'T', 'cdr')";
    EXPECT_EQ(code({topics}), "not-a-bag");
    EXPECT_EQ(code({topics,
                    "CREATE VIEW messages AS WITH RECURSIVE n(x) AS (VALUES (1) UNION ALL SELECT x FROM n) "
                    "SELECT x AS id, 1 AS topic_id, 1 AS timestamp, x'' AS data FROM n"}),
              "not-a-bag")
        << "a view without an end";
    EXPECT_EQ(code({topics, messages, "INSERT INTO topics VALUES ('x', '/a', 'T', 'cdr')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, "INSERT INTO topics VALUES (1, x'00', 'T', 'cdr')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, 2, 3, x'')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, NULL, 3, x'')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, 1, 'soon', x'')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, 1, 3, NULL)"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, 1, 3, 'text')"}), "bad-record");
    EXPECT_EQ(code({topics, messages, a, "INSERT INTO messages VALUES (1, 1, -3, x'')"}), "bad-time");
    EXPECT_EQ(code({topics, "CREATE TABLE messages(id)"}), "bad-bag") << "columns are missing";
}

TEST_F(Bags, AFolderIsReadInTheNaturalOrderOfItsFiles) {
    for (const int n : {10, 2, 9, 0})
        folder_.write("bag/bag_" + std::to_string(n) + ".mcap",
                      mcap(kTopics + message(4, static_cast<std::uint64_t>(100 - n), std::to_string(n))));
    folder_.write("bag/metadata.yaml", "not even YAML: [");
    EXPECT_EQ(read(folder_.path("bag")), (Lines{"/a#1@100=0", "/a#1@98=2", "/a#1@91=9", "/a#1@90=10"}));
    EXPECT_EQ(earliest_ns_, 90);
    EXPECT_TRUE(diagnostics_.items().empty());
}

TEST_F(Bags, FoldersThatAreNoBagAreRefused) {
    const auto code = [&](const std::string& name) {
        read(folder_.path(name));
        return finding();
    };
    folder_.write("nothing/notes.txt", "");
    EXPECT_EQ(code("nothing"), "not-a-bag");
    folder_.write("two/bag.mcap", mcap(kTopics));
    folder_.write("two/bag.db3", "");
    EXPECT_EQ(code("two"), "not-a-bag") << "one bag in two formats would be played twice";
    folder_.write("packed/bag_0.mcap.zstd", in_zstd(mcap(kTopics)));
    EXPECT_EQ(code("packed"), "compressed-file");
    EXPECT_EQ(code("packed/bag_0.mcap.zstd"), "compressed-file");
    folder_.write("classic.bag", "#ROSBAG V2.0\n");
    EXPECT_EQ(code("classic.bag"), "not-a-bag");
}

TEST_F(Bags, AreKnownByTheirFirstBytesOrTheirName) {
    EXPECT_TRUE(is_bag(folder_.write("some", mcap(kTopics))));
    EXPECT_TRUE(is_bag(folder_.write("empty.mcap", "")));
    EXPECT_TRUE(is_bag(folder_.write("empty.db3", "")));
    EXPECT_TRUE(is_bag(folder_.path("")));
    EXPECT_FALSE(is_bag(folder_.write("orders.jsonl", "{\"t\":0}\n")));
    EXPECT_FALSE(is_bag(folder_.write("empty", "")));
    EXPECT_FALSE(is_bag(folder_.path("missing.mcap")));
    EXPECT_FALSE(is_bag("/dev/null"));
}

/// Bytes that are not those of a writer.
class BagBytes : public Bags {
  protected:
    /// Reads it, or says why not.
    void expect_total(const std::string& name, const std::string& bytes) {
        std::filesystem::remove(folder_.path(name));  // some file systems wait where it is overwritten
        const Lines lines = read(folder_.write(name, bytes), "");
        EXPECT_TRUE(!lines.empty() || !diagnostics_.items().empty() || !earliest_ns_)
            << "nothing, and no reason";
        for (const Diagnostic& found : diagnostics_.items())
            EXPECT_TRUE(!found.code.empty() && !found.message.empty() && !found.remedy.empty());
    }
    std::mt19937_64 random_{7};
};

TEST_F(BagBytes, EachCutAndEachChangedByteOfAnMcapFileIsTakenOrRefused) {
    const std::size_t rounds = roboss::test::fuzz_rounds(1);
    for (const std::string compression : {"none", "", "zstd", "lz4"}) {
        const std::string records = kTopics + message(4, 5, "one") + message(9, 3, "two");
        const std::string good =
            mcap(compression == "none" ? records : chunk_in(compression, records) + record(7, "index"));
        for (std::size_t at = 0; at < good.size(); ++at) {
            expect_total("bag.mcap", good.substr(0, at));
            for (std::size_t round = 0; round < rounds; ++round) {
                std::string changed = good;
                changed[at] = static_cast<char>(round == 0 ? ~changed[at] : static_cast<char>(random_()));
                expect_total("bag.mcap", changed);
            }
        }
    }
}

TEST_F(BagBytes, ChangedSqliteFilesAreTakenOrRefused) {
    const std::string file = folder_.path("good.db3");
    ASSERT_TRUE(
        write_db3(file, {{"/a", "std_msgs/msg/Bool"}}, {{1, 5, "one"}, {1, 8, std::string(9'000, 'x')}})
            .ok());
    std::ifstream in(file, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t round = 0; round < roboss::test::fuzz_rounds(500); ++round) {
        std::string changed = good;
        for (int n = 0; n < 4; ++n) changed[random_() % changed.size()] = static_cast<char>(random_());
        if (round % 5 == 0) changed.resize(random_() % changed.size());
        expect_total("bag.db3", changed);
    }
}

}  // namespace
}  // namespace roboss::bags::test
