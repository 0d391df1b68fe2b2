// Lanes, in one register and in several, do what one number does, bit by bit: for the operators of the
// language on any processor, and for the instruction sets that every processor of a kind has.
#include "core/lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/lanes_neon.h"
#include "core/wide.h"

namespace roboss {
namespace {

/// Registers of 16 bytes by the language alone.
struct PlainSet {
    using Doubles [[gnu::vector_size(16)]] = double;
    using Floats [[gnu::vector_size(16)]] = float;
    template <class Vector>
    static constexpr std::size_t kCount = sizeof(Vector) / sizeof(Vector{}[0]);

    template <class Vector, class Function>
    static Vector each(Vector x, const Function& f) {
        for (std::size_t i = 0; i < kCount<Vector>; ++i) x[i] = f(x[i]);
        return x;
    }
    template <class Vector>
    static Vector sqrt(Vector x) {
        return each(x, [](auto number) { return std::sqrt(number); });
    }
    template <class Vector>
    static Vector floor(Vector x) {
        return each(x, [](auto number) { return std::floor(number); });
    }
    template <class Vector>
    static Vector magnitude(Vector x) {
        return each(x, [](auto number) { return std::fabs(number); });
    }
    template <class Vector>
    static unsigned bits(Vector m) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < kCount<Vector>; ++i) bits |= (m[i] != 0 ? 1u : 0u) << i;
        return bits;
    }
    static Floats join(Doubles a, Doubles b) {
        return Floats{static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(b[0]),
                      static_cast<float>(b[1])};
    }
    static Doubles low(Floats x) { return Doubles{double{x[0]}, double{x[1]}}; }
    static Doubles high(Floats x) { return Doubles{double{x[2]}, double{x[3]}}; }
};

template <class T>
class LanesTest : public ::testing::Test {};
using PlainDoubles = Lanes<double, 2, PlainSet>;
using PlainFloats = Lanes<float, 4, PlainSet>;
using Types =
    ::testing::Types<PlainDoubles, Twice<PlainDoubles>, Twice<Twice<PlainDoubles>>, PlainFloats,
                     Twice<PlainFloats>
#if defined(__aarch64__)
                     ,
                     DoublesNeon2, DoublesNeon4, DoublesNeon8, FloatsNeon4, FloatsNeon8, FloatsNeon16
#endif
                     >;
TYPED_TEST_SUITE(LanesTest, Types);

/// Numbers at which arithmetic, comparisons and roundings differ most easily.
const std::vector<double>& numbers() {
    constexpr double kTiny = std::numeric_limits<double>::denorm_min(),
                     kSmall = std::numeric_limits<float>::denorm_min();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    static const std::vector<double> list{0.0,        -0.0,      1.0,        -1.0,        1.0 / 3, -2.5,
                                          2.5,        0.5,       -0.5,       1e-310,      kTiny,   kSmall,
                                          -1e30,      3e38,      16777217.0, 0.1,         7.75,    -7.75,
                                          1e15 + 0.5, kInfinite, -kInfinite, std::nan("")};
    return list;
}

/// One number by itself, as exact as T.
template <class T>
using Alone = std::conditional_t<kIsFloat<T>, Single, double>;

/// Expects equal bits; any NaN equals any other.
template <class T>
void expect_lane(const T& x, std::size_t i, Alone<T> expected, const char* what) {
    const double ours = lane(x, i), right = lane(expected, 0);
    if (std::isnan(right))
        EXPECT_TRUE(std::isnan(ours)) << what << ", lane " << i;
    else
        EXPECT_EQ(std::bit_cast<std::uint64_t>(ours), std::bit_cast<std::uint64_t>(right))
            << what << ", lane " << i << ": " << ours << ", not " << right;
}

/// Numbers from `first` on, another one in each lane, and check(lanes, numbers by themselves).
template <class T, class Check>
void fill(std::size_t first, const Check& check) {
    T x;
    std::vector<Alone<T>> alone;
    for (std::size_t i = 0; i < kLanesOf<T>; ++i) {
        alone.push_back(Alone<T>(numbers()[(first + i) % numbers().size()]));
        set_lane(x, i, lane(alone.back(), 0));
    }
    check(x, alone);
}

TYPED_TEST(LanesTest, ComputeWhatOneNumberDoes) {
    using T = TypeParam;
    using std::floor, std::sqrt;
    for (std::size_t first = 0; first < numbers().size(); ++first)
        for (std::size_t second = 0; second < numbers().size(); ++second)
            fill<T>(first, [&](const T& a, const std::vector<Alone<T>>& x) {
                fill<T>(second, [&](const T& b, const std::vector<Alone<T>>& y) {
                    for (std::size_t i = 0; i < x.size(); ++i) {
                        expect_lane(a + b, i, x[i] + y[i], "sum"),
                            expect_lane(a - b, i, x[i] - y[i], "difference");
                        expect_lane(a * b, i, x[i] * y[i], "product"),
                            expect_lane(a / b, i, x[i] / y[i], "quotient");
                        expect_lane(a * b + a, i, x[i] * y[i] + x[i], "product and sum, each rounded");
                        expect_lane(-a, i, -x[i], "sign"), expect_lane(sqrt(a), i, sqrt(x[i]), "root");
                        expect_lane(floor(a), i, floor(x[i]), "floor");
                        expect_lane(magnitude(a), i, magnitude(x[i]), "magnitude");
                        expect_lane(larger(a, b), i, larger(x[i], y[i]), "larger");
                        expect_lane(smaller(a, b), i, smaller(x[i], y[i]), "smaller");
                        expect_lane(clamped(a, -b, b), i, clamped(x[i], -y[i], y[i]), "clamped");
                    }
                });
            });
}

TYPED_TEST(LanesTest, CompareAsOneNumberDoes) {
    using T = TypeParam;
    for (std::size_t first = 0; first < numbers().size(); ++first)
        for (std::size_t second = 0; second < numbers().size(); ++second)
            fill<T>(first, [&](const T& a, const std::vector<Alone<T>>& x) {
                fill<T>(second, [&](const T& b, const std::vector<Alone<T>>& y) {
                    unsigned less = 0, most = 0, same = 0, either = 0;
                    for (std::size_t i = 0; i < x.size(); ++i) {
                        less |= (x[i] < y[i] ? 1u : 0u) << i, most |= (x[i] <= y[i] ? 1u : 0u) << i;
                        same |= (equal(x[i], y[i]) ? 1u : 0u) << i;
                        either |= (x[i] < y[i] || x[i] > y[i] ? 1u : 0u) << i;
                    }
                    EXPECT_EQ((a < b).bits(), less);
                    EXPECT_EQ((a <= b).bits(), most);
                    EXPECT_EQ((b > a).bits(), less);
                    EXPECT_EQ((b >= a).bits(), most);
                    EXPECT_EQ(equal(a, b).bits(), same);
                    EXPECT_EQ(((a < b) | (a > b)).bits(), either);
                    EXPECT_EQ(((a <= b) & !(a < b)).bits(), same);
                });
            });
    EXPECT_EQ(MaskOf<T>(true).bits(), kAllLanes<T>);
    EXPECT_EQ(MaskOf<T>(false).bits(), 0u);
}

TYPED_TEST(LanesTest, FloatsMeetTheirDoublesLaneByLane) {
    using T = TypeParam;
    if constexpr (kIsFloat<T>) {
        static_assert(kLanesOf<WideOf<T>> == kLanesOf<T>);
        for (std::size_t first = 0; first < numbers().size(); ++first) {
            WideOf<T> wide;
            for (std::size_t i = 0; i < kLanesOf<T>; ++i)
                set_lane(wide, i, numbers()[(first + i) % numbers().size()]);
            const T narrowed = narrow<T>(wide);
            const WideOf<T> again = widen(narrowed);
            for (std::size_t i = 0; i < kLanesOf<T>; ++i) {
                expect_lane(narrowed, i, Single(lane(wide, i)), "narrowed");
                expect_lane(again, i, lane(narrowed, i), "widened");
            }
        }
    } else {
        static_assert(std::is_same_v<WideOf<T>, T>);
    }
}

}  // namespace
}  // namespace roboss
