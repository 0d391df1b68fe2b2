// Pictures by their headers: each kind with its size, each fault named.
#include "mesh/picture_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace roboss {
namespace {

using namespace std::string_literals;

class PictureFile : public testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(path_); }
    Result<PictureSpec> read(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary) << bytes;
        return read_picture(path_);
    }
    void refuses(const std::string& bytes, const std::string& why) {
        const Result<PictureSpec> picture = read(bytes);
        ASSERT_FALSE(picture.ok()) << why;
        EXPECT_NE(picture.error().message.find(why), std::string::npos) << picture.error().message;
        EXPECT_FALSE(picture.error().remedy.empty());
    }
    std::string path_ = testing::TempDir() + "roboss-picture-" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

std::string big(std::uint32_t value, int bytes) {
    std::string text;
    while (bytes-- > 0) text += static_cast<char>(value >> (8 * bytes) & 0xFF);
    return text;
}
std::string png(std::uint32_t width, std::uint32_t height) {
    return "\x89PNG\r\n\x1A\n"s + big(13, 4) + "IHDR" + big(width, 4) + big(height, 4) + "\x08\2\0\0\0"s +
           "crc!" + big(3, 4) + "IDATabccrc!" + big(0, 4) + "IENDcrc!";
}
/// A comment, tables, the frame, the scan with a stuffed byte, the end.
std::string jpeg(std::uint32_t width, std::uint32_t height) {
    return "\xFF\xD8\xFF\xFE"s + big(5, 2) + "hey" + "\xFF\xC4"s + big(4, 2) + "ab" + "\xFF\xFF\xC2"s +
           big(11, 2) + "\x08" + big(height, 2) + big(width, 2) + "\1abc" + "\xFF\xDA"s + big(4, 2) + "xy" +
           "scan\xFF\0more"s + "\xFF\xD9"s;
}
std::string webp(const std::string& chunk) {
    const auto size = static_cast<char>(4 + chunk.size());
    return "RIFF"s + size + "\0\0\0WEBP"s + chunk;
}

TEST_F(PictureFile, EachKindIsKnownByItsContentAndSaysItsSize) {
    struct Case {
        std::string bytes;
        PictureKind kind;
    };
    const Case cases[] = {{png(300, 200), PictureKind::kPng},
                          {jpeg(300, 200), PictureKind::kJpeg},
                          {webp("VP8X\x0A\0\0\0\0\0\0\0\x2B\1\0\xC7\0\0"s), PictureKind::kWebp},
                          {webp("VP8L\x0A\0\0\0\x2F\x2B\xC1\x31\0abcde"s), PictureKind::kWebp},
                          {webp("VP8 \x0A\0\0\0abc\x9D\1\x2A\x2C\1\xC8\0"s), PictureKind::kWebp}};
    for (const Case& c : cases) {
        const Result<PictureSpec> picture = read(c.bytes);
        ASSERT_TRUE(picture.ok()) << picture.error().text();
        EXPECT_EQ(picture.value().kind, c.kind);
        EXPECT_EQ(picture.value().width, 300u);
        EXPECT_EQ(picture.value().height, 200u);
        EXPECT_EQ(std::string(picture.value().bytes.begin(), picture.value().bytes.end()), c.bytes);
    }
}

TEST_F(PictureFile, WhatIsNoPictureCutOffOrTooLargeIsRefused) {
    refuses("", "no picture");
    refuses("root:x:0:0", "no picture");
    refuses("<svg xmlns='http://www.w3.org/2000/svg'/>", "no picture");
    refuses("GIF89a", "no picture");
    for (const std::string& whole : {png(300, 200), jpeg(300, 200)})
        for (const std::size_t n : {std::size_t{12}, whole.size() / 2, whole.size() - 9})
            refuses(whole.substr(0, n), "cut off");
    refuses(webp("VP8X\x0A\0\0\0\0\0\0\0\x2B\1\0\xC7\0\0"s).substr(0, 29), "cut off");
    refuses(png(0, 200), "damaged");
    refuses(png(8193, 1), "8193 x 1 pixels");
    refuses(jpeg(1, 65535), "1 x 65535 pixels");
    EXPECT_FALSE(read_picture(path_ + "-nowhere").ok());
    EXPECT_FALSE(read_picture(testing::TempDir()).ok());
}

}  // namespace
}  // namespace roboss
