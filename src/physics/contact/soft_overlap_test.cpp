// Soft contacts of shapes that lie in each other by no motion of theirs: how far their springs take that
// over, and how fast they push apart.
#include <gtest/gtest.h>

#include "physics/contact/contact_rows.h"

namespace roboss {
namespace {

constexpr double kDt = 1e-3, kDepth = 0.05, kMobility = 5;  // s, m, 1/kg

SurfacePair soft_surface() {
    SurfacePair surface;
    surface.softness = {1e6, 1};
    surface.correction_speed = 2;
    return surface;
}

Contact overlapping() {
    Contact contact;
    contact.gap = -kDepth;
    return contact;
}

/// What a jammed spring has taken over after a second.
double taken_over(double bears) {
    Contact contact = overlapping();
    contact.impulse = 50;  // N s
    double sprung = 0;
    for (int tick = 0; tick < 1000; ++tick) {
        const double before = sprung;
        sprung = contact::sprung_depth<double>(contact, soft_surface(), kDepth, 0, kDt, 2, bears);
        EXPECT_LE(sprung - before, 0.1 * 2 * kDt + 1e-15);
        contact.load = contact.impulse * sprung / kDepth;
    }
    return sprung;
}

TEST(SoftOverlap, ASpringTakesItOverSlowlyIfALoadCompressesItSoFar) {
    EXPECT_NEAR(taken_over(1.1 * kDepth), kDepth, 1e-12);
    EXPECT_EQ(taken_over(2e-5), 0);
}

TEST(SoftOverlap, WhatMotionMadeIsAllSprung) {
    Contact contact = overlapping();
    contact.impulse = contact.load = 50;
    EXPECT_EQ(contact::sprung_depth<double>(contact, soft_surface(), kDepth, 0, kDt, 2, 2e-5), kDepth);
}

/// The velocity at which the contact ceases to push, m/s.
double parting(double lever) {
    ContactColumns columns;
    columns.extend(1);
    columns.n[0] = lever;
    ContactRow row;
    row.last = 1;
    EXPECT_TRUE(contact::set_softness<double>(overlapping(), soft_surface(), 0, kDt, kMobility, 9.81, 1e-12,
                                              columns, row));
    return row.normal.target;
}

TEST(SoftOverlap, ItIsPushedApartAtTheSpeedOfRecoveryButTurnsNoJointFast) {
    EXPECT_LE(parting(1), 2);
    EXPECT_GT(parting(1), 1);
    EXPECT_LE(parting(0.005), 20 * 0.005 * 1.001);
    EXPECT_GT(parting(0.005), 0.09);
    EXPECT_LE(parting(0), 1e-8);
}

}  // namespace
}  // namespace roboss
