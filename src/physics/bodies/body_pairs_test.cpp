// Pairs in batches: no body twice in a batch, and a place for every point.
#include "physics/bodies/body_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include <support/random.h>

#include "physics/bodies/body_island.h"

namespace roboss {
namespace {

using test::Random;

void add_pair(int a, int b, int count, std::vector<BodyPoint>& points) {
    for (int i = 0; i < count; ++i) {
        BodyPoint& p = points.emplace_back();
        p.a = a, p.b = b;
    }
}

/// No two batches of a colour share a body, and the order for teams has each batch of a colour once.
void expect_colours_apart(int bodies, PairBatches& pairs) {
    pairs.sort_by_bodies();
    ASSERT_EQ(pairs.colours().back(), pairs.batches().size());
    for (std::size_t c = 0; c + 1 < pairs.colours().size(); ++c) {
        std::set<int> there;
        std::set<std::uint32_t> listed;
        for (std::size_t k = pairs.colours()[c]; k < pairs.colours()[c + 1]; ++k) {
            listed.insert(pairs.by_bodies()[k]);
            const PairBatch& batch = pairs.batches()[k];
            for (std::size_t lane = 0; lane < 8; ++lane)
                for (const int body : {batch.a[lane], batch.b[lane]})
                    EXPECT_TRUE(body >= bodies || there.insert(body).second) << body << " in colour " << c;
        }
        EXPECT_EQ(listed.size(), pairs.colours()[c + 1] - pairs.colours()[c]);
        EXPECT_EQ(*listed.begin(), pairs.colours()[c]);
        EXPECT_EQ(*listed.rbegin() + 1, pairs.colours()[c + 1]);
    }
}

void expect_sound(int bodies, const std::vector<BodyPoint>& points) {
    PairBatches pairs;
    pairs.arrange(static_cast<std::size_t>(bodies), points);
    std::set<std::size_t> places;
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_TRUE(places.insert(pairs.place_of(k)).second) << k;
    std::size_t slots = 0;
    for (const PairBatch& batch : pairs.batches()) {
        EXPECT_EQ(batch.first, slots);
        slots = batch.last;
        std::set<int> there;
        for (std::size_t lane = 0; lane < 8; ++lane)
            for (const int body : {batch.a[lane], batch.b[lane]}) {
                if (body == bodies + (batch.scenery ? 1 : 0)) continue;
                EXPECT_TRUE(there.insert(body).second) << body << " twice";
            }
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::size_t slot = pairs.place_of(k) / 8, lane = pairs.place_of(k) % 8;
            if (slot < batch.first || slot >= batch.last) continue;
            EXPECT_EQ(batch.a[lane], points[k].a);
            EXPECT_EQ(batch.b[lane], points[k].b < 0 ? bodies + 1 : points[k].b);
            EXPECT_EQ(batch.scenery, points[k].b < 0);
        }
    }
    EXPECT_EQ(pairs.slots(), slots);
    expect_colours_apart(bodies, pairs);
}

TEST(PairBatches, NoBodyIsTwiceInABatch) {
    Random random(7);
    for (int round = 0; round < 20; ++round) {
        std::vector<BodyPoint> points;
        const int bodies = random.integer(1, 60);
        for (int k = 0; k < 3 * bodies; ++k) {
            const int a = random.integer(0, bodies - 1), b = random.integer(-1, bodies - 1);
            add_pair(a, a == b ? -1 : b, random.integer(1, 4), points);
        }
        expect_sound(bodies, points);
    }
}

TEST(PairBatches, ABodyMayTouchMoreThanSixtyFourOthers) {
    std::vector<BodyPoint> points;
    for (int b = 1; b <= 150; ++b) add_pair(0, b, 3, points);
    for (int b = 1; b < 150; ++b) add_pair(b, b + 1, 1, points);
    add_pair(0, -1, 4, points);
    expect_sound(151, points);
}

TEST(PairBatches, PairsOfOneColourFillABatch) {
    std::vector<BodyPoint> points;
    for (int k = 0; k < 9; ++k) add_pair(2 * k, 2 * k + 1, 1 + k % 4, points);
    PairBatches pairs;
    pairs.arrange(18, points);
    ASSERT_EQ(pairs.batches().size(), 2u);
    EXPECT_EQ(pairs.batches()[0].pairs, 8);
    EXPECT_EQ(pairs.batches()[1].pairs, 1);
    EXPECT_EQ(pairs.slots(), 5u);  // the most points of the first batch, and one
    expect_sound(18, points);
}

TEST(PairBatches, NothingGivesNothing) {
    expect_sound(0, {});
    expect_sound(3, {});
}

}  // namespace
}  // namespace roboss
