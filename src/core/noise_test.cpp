// Moments, independence of streams, and golden values: a changed number is a changed simulation.
#include "core/noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace roboss {
namespace {

struct Moments {
    double mean = 0, variance = 0, skewness = 0, kurtosis = 0;
};

template <class Draw>
Moments moments(int count, Draw draw) {
    std::vector<double> x;
    for (int i = 0; i < count; ++i) x.push_back(draw(static_cast<std::uint64_t>(i)));
    Moments m;
    for (double v : x) m.mean += v / count;
    double third = 0, fourth = 0;
    for (double v : x) {
        const double d = v - m.mean;
        m.variance += d * d / count, third += d * d * d / count, fourth += d * d * d * d / count;
    }
    m.skewness = third / std::pow(m.variance, 1.5);
    m.kurtosis = fourth / (m.variance * m.variance);
    return m;
}

template <class A, class B>
double correlation(int count, A a, B b) {
    double ab = 0, aa = 0, bb = 0;
    for (int i = 0; i < count; ++i) {
        const double x = a(static_cast<std::uint64_t>(i)), y = b(static_cast<std::uint64_t>(i));
        ab += x * y, aa += x * x, bb += y * y;
    }
    return ab / std::sqrt(aa * bb);
}

TEST(Noise, UniformHasTheMomentsOfTheUnitInterval) {
    const NoiseStream stream{7, 3, 1, 99};
    const Moments m = moments(200000, [&](std::uint64_t i) { return random_uniform(stream, i); });
    EXPECT_NEAR(m.mean, 0.5, 3e-3);
    EXPECT_NEAR(m.variance, 1.0 / 12.0, 1e-3);
    EXPECT_NEAR(m.kurtosis, 1.8, 0.02);
}

TEST(Noise, UniformFillsEveryBinEvenly) {
    std::array<int, 64> bins{};
    for (std::uint64_t i = 0; i < 64000; ++i)
        bins[static_cast<std::size_t>(64.0 * random_uniform({1, 2, 3, 4}, i))] += 1;
    double chi_squared = 0;
    for (int n : bins) chi_squared += (n - 1000.0) * (n - 1000.0) / 1000.0;
    EXPECT_LT(chi_squared, 103.4);  // 63 degrees of freedom, one in a thousand
    EXPECT_GT(chi_squared, 32.5);
}

TEST(Noise, GaussianHasTheMomentsOfTheNormalDistribution) {
    const NoiseStream stream{7, 3, 1, 99};
    const Moments m = moments(200000, [&](std::uint64_t i) { return random_gaussian(stream, i); });
    EXPECT_NEAR(m.mean, 0.0, 0.01);
    EXPECT_NEAR(m.variance, 1.0, 0.015);
    EXPECT_NEAR(m.skewness, 0.0, 0.03);
    EXPECT_NEAR(m.kurtosis, 3.0, 0.06);
}

TEST(Noise, GaussianOverTicksIsAsGoodAsOverIndices) {
    const Moments m = moments(200000, [](std::uint64_t i) {
        return random_gaussian({7, 3, 1, static_cast<Tick>(i)}, 0);
    });
    EXPECT_NEAR(m.mean, 0.0, 0.01);
    EXPECT_NEAR(m.variance, 1.0, 0.015);
    EXPECT_NEAR(m.kurtosis, 3.0, 0.06);
}

TEST(Noise, StreamsThatDifferInOneMemberAreUncorrelated) {
    const NoiseStream base{7, 3, 1, 99};
    const auto draw = [](NoiseStream s) { return [s](std::uint64_t i) { return random_gaussian(s, i); }; };
    for (const NoiseStream& other :
         {NoiseStream{8, 3, 1, 99}, NoiseStream{7, 4, 1, 99}, NoiseStream{7, 3, 2, 99},
          NoiseStream{7, 3, 1, 100}, NoiseStream{7, 1, 3, 99}})
        EXPECT_NEAR(correlation(100000, draw(base), draw(other)), 0.0, 0.013);
}

TEST(Noise, NeighbouringIndicesAreUncorrelated) {
    const NoiseStream s{7, 3, 1, 99};
    for (std::uint64_t lag : {1u, 2u, 3u}) {
        const double c = correlation(
            100000, [&](std::uint64_t i) { return random_gaussian(s, i); },
            [&](std::uint64_t i) { return random_gaussian(s, i + lag); });
        EXPECT_NEAR(c, 0.0, 0.013) << "lag " << lag;
    }
}

TEST(Noise, GoldenValuesStay) {
    const NoiseStream s{42, 7, 2, 1000};
    EXPECT_EQ(random_bits(s, 0), 0x40621EA4E4E6FC4Aull);
    EXPECT_EQ(random_bits({0, 0, 0, 0}, 0), 0x2130748AAAC80268ull);
    EXPECT_EQ(random_bits({42, 7, 2, kOncePerRun}, 5), 0x88F175077B33888Eull);
    EXPECT_EQ(random_uniform(s, 1), 0x1.51125c2e05e64p-3);
    EXPECT_EQ(random_gaussian(s, 0), 0x1.b2f1d505e5786p-1);
    EXPECT_EQ(random_gaussian(s, 1), 0x1.6d8d0f4d7ad27p+0);
}

}  // namespace
}  // namespace roboss
