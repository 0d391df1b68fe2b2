// JPEG pictures against what libjpeg-turbo makes of them (without smoothed upsampling).
#include "mesh/jpeg_image.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace roboss {
namespace {

/// 20 x 12 pixels, halved colours, a restart marker behind each block.
constexpr const char* kRamp =
    "ffd8ffe000104a46494600010100000100010000ffdb0043000302020302020303030304030304050805050404050a070706080c"
    "0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffdb00430103040405040509050509"
    "14"
    "0d0b0d14141414141414141414141414141414141414141414141414141414141414141414141414141414141414141414141414"
    "1"
    "4141414ffc0001108000c001403012200021101031101ffc400160001010100000000000000000000000000060800ffc40027100"
    "00"
    "00306040700000000000000000000000623010203040507142452a1152225324161b2ffc40016010101010000000000000000000"
    "00"
    "00000080506ffc400211100000504020300000000000000000000000204063101030713111533b2d1ffdd00040001ffda000c030"
    "10"
    "002110311003f009d8bd653b50d82597b29d4a265f4f8f4c15717ca94ee54426972a53b8944474fcb056cb4ef51d4db9f253d4e3"
    "078"
    "f5f8af61663e0fffd01f256532eea1b0c2d4922a53b0eea2302599dea39ac846d97e2bd65981ffd9";

std::vector<std::uint8_t> bytes_of(const std::string& digits) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    return bytes;
}

TEST(JpegImage, HasTheColoursThatLibjpegFinds) {
    const Result<ColourImage> image = decode_jpeg(bytes_of(kRamp));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image.value().columns, 20u);
    EXPECT_EQ(image.value().rows, 12u);
    struct Pixel {
        std::size_t number;
        int rgb[3];
    };
    for (const Pixel& pixel :
         {Pixel{0, {0, 4, 194}}, Pixel{7, {77, 4, 195}}, Pixel{19, {218, 6, 28}}, Pixel{103, {40, 99, 203}},
          Pixel{239, {228, 215, 40}}, Pixel{130, {118, 122, 25}}})
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_LE(std::abs(image.value().samples[3 * pixel.number + k] - pixel.rgb[k]), 3)
                << pixel.number;
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
    EXPECT_FALSE(decode_jpeg(std::span(whole).first(150)));
}

}  // namespace
}  // namespace roboss
