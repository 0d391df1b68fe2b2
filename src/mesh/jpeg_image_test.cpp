// JPEG pictures of known colours, whole and damaged.
#include "mesh/jpeg_image.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace roboss {
namespace {

// clang-format off
/// 20 x 12 pixels, (12 x, 20 y, 200 - 9 x) in red, green and blue, with halved colours.
constexpr const char* kRamp =
    "ffd8ffe000104a46494600010100000100010000ffdb0043000503040404030504040405050506070c08070707070f0b0b09"
    "0c110f1212110f111113161c1713141a1511111821181a1d1d1f1f1f13172224221e241c1e1f1effdb004301050505070607"
    "0e08080e1e1411141e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e"
    "1e1e1e1e1e1e1e1effc0001108000c001403012200021101031101ffc4001600010101000000000000000000000000000700"
    "06ffc4001e10000103050101000000000000000000000004052301030621a13113ffc4001601010101000000000000000000"
    "00000000070406ffc4001b11000201050000000000000000000000000006030104122231ffda000c03010002110311003f00"
    "274184f90f0d0b7e13e43c179034a2d44681bda916a22a70669b63369ce171af41cb384c7487843fd86945f3a44405cacd36"
    "751e2170b8c29d3fffd9";
/// The same, progressive.
constexpr const char* kProgressive =
    "ffd8ffe000104a46494600010100000100010000ffdb0043000503040404030504040405050506070c08070707070f0b0b09"
    "0c110f1212110f111113161c1713141a1511111821181a1d1d1f1f1f13172224221e241c1e1f1effdb004301050505070607"
    "0e08080e1e1411141e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e1e"
    "1e1e1e1e1e1e1e1effc2001108000c001403012200021101031101ffc4001600010101000000000000000000000000000600"
    "05ffc400160101010100000000000000000000000000060305ffda000c0301000210031000000127a0bf42b9a3a7f0579fff"
    "c4001a100002030101000000000000000000000002030001041121ffda00080101000105020c5178a562f014116a094a0e7f"
    "ffc400191100030003000000000000000000000000000305021121ffda0008010301013f018f619c30b0cd1fffc400181100"
    "0301010000000000000000000000000002051121ffda0008010201013f01b14dfa3537d3ffc4001510010100000000000000"
    "000000000000000031ffda0008010100063f02888888ffc40014100100000000000000000000000000000020ffda00080101"
    "00013f215dee063fffda000c0301000200030000001070cfffc40017110100030000000000000000000000000000113151ff"
    "da0008010301013f10d840dbffc4001511010100000000000000000000000000000011ffda0008010201013f100597ffc400"
    "181001000301000000000000000000000000002131c111ffda0008010100013f10ab0a308184561bca7fffd9";
// clang-format on

std::vector<std::uint8_t> bytes_of(const std::string& digits) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    return bytes;
}

TEST(JpegImage, HasTheColoursThatEveryLibjpegFinds) {
    for (const char* file : {kRamp, kProgressive}) {
        const Result<ColourImage> image = decode_jpeg(bytes_of(file));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image.value().columns, 20u);
        EXPECT_EQ(image.value().rows, 12u);
        struct Pixel {
            std::size_t number;
            int rgb[3];
        };
        for (const Pixel& pixel :
             {Pixel{0, {2, 2, 186}}, Pixel{7, {81, 2, 127}}, Pixel{19, {214, 6, 32}},
              Pixel{103, {32, 102, 174}}, Pixel{130, {119, 121, 108}}, Pixel{239, {221, 216, 52}}})
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(image.value().samples[3 * pixel.number + k], pixel.rgb[k]) << pixel.number;
    }
}

TEST(JpegImage, DamagedOnesAreErrorsOrPicturesOfTheirSize) {
    const std::vector<std::uint8_t> whole = bytes_of(kRamp);
    for (std::size_t length = 0; length < whole.size(); ++length)
        (void)decode_jpeg(std::span(whole).first(length));
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int flip : {1, 0x80, 0xFF}) {
            std::vector<std::uint8_t> damaged = whole;
            damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flip);
            const Result<ColourImage> image = decode_jpeg(damaged);
            if (image) {
                EXPECT_EQ(image.value().samples.size(), 3 * image.value().columns * image.value().rows);
            } else {
                EXPECT_EQ(image.error().code, "picture-kind");
            }
        }
    EXPECT_FALSE(decode_jpeg(std::span(whole).first(100)));
}

}  // namespace
}  // namespace roboss
