// The cell of an arm between two conveyors: numbers that the generator of the world and the programs of
// examples/arm_cell share.
//
// Frame of a cell: the arm's axis is the origin, on the floor; both belts run along +x, the feed belt at +y
// and the out belt at -y. Lengths in m, angles in rad, unless a name says otherwise.
#pragma once

#include <array>
#include <string>

namespace arm_cell {

// The arm: shoulder and elbow turn about z, the lift slides along z (0: up), the wrist turns about z.
inline constexpr double kUpperArm = 0.40, kForearm = 0.35;
inline constexpr double kArmHeight = 0.98;  // of the elbow's plane
inline constexpr double kTipHeight = 0.74;  // of the fingers' ends, or of the cup, with the lift up
inline constexpr double kLiftStroke = 0.30;
inline constexpr double kFingerStroke = 0.05;  // of each finger; 0: closed
inline constexpr double kShoulderLimit = 2.9, kElbowLimit = 2.5, kWristLimit = 6.2;

/// Largest velocity and acceleration that a program plans with, of shoulder, elbow, lift and wrist.
struct JointLimit {
    double velocity = 0, acceleration = 0;
};
inline constexpr std::array<const char*, 4> kJoints{"shoulder", "elbow", "lift", "wrist"};
inline constexpr std::array<JointLimit, 4> kJointLimits{{{4, 12}, {5, 16}, {1, 6}, {8, 40}}};

// The belts.
inline constexpr double kBeltTop = 0.50, kBeltWidth = 0.30,
                        kBeltAside = 0.45;  // height, width, |y| of the middle
inline constexpr double kFeedBegin = -1.50, kFeedEnd = 0.30, kFeedSpeed = 0.30;
inline constexpr double kOutBegin = -0.30, kOutEnd = 1.30, kOutSpeed = 0.30;
inline constexpr double kHeadX = -1.38;          // where boxes come onto the feed belt
inline constexpr double kSinkX = 1.20;           // beyond it a box has left on the out belt
inline constexpr double kBarrierX = 0.05;        // of the light barrier across the feed belt
inline constexpr double kBarrierHeight = 0.025;  // above the belt
inline constexpr double kPlaceX = 0.0;           // on the out belt

// The scanner looks down on the feed belt before the light barrier.
inline constexpr double kScannerX = -0.03, kScannerHeight = 1.50,
                        kScannerField = 0.16;  // half of its field on the belt
inline constexpr int kScannerBeams = 97;       // in each direction

// Boxes: two kinds by turns. They wait on a rack below the head of the feed belt.
struct BoxKind {
    double length = 0, width = 0, height = 0, mass_kg = 0;
};
inline constexpr std::array<BoxKind, 2> kBoxKinds{{{0.080, 0.060, 0.060, 0.30}, {0.090, 0.050, 0.050, 0.22}}};
inline constexpr int kBoxes = 10;  // of a cell
inline constexpr BoxKind kind_of_box(int number) {
    return kBoxKinds[static_cast<std::size_t>(number % 2)];
}

struct Place {
    double x = 0, y = 0, z = 0;
};
/// Where a box stands on the rack, of its middle.
inline constexpr Place rack_place(int number) {
    return {kHeadX - 0.05 + 0.14 * (number / 2), kBeltAside + (number % 2 == 0 ? -0.07 : 0.07),
            kind_of_box(number).height / 2};
}

// A hall: cells in rows of four.
inline constexpr int kCellsInARow = 4;
inline constexpr double kCellPitchX = 3.2, kCellPitchY = 1.8;
/// Origin of a cell in the world.
inline constexpr Place cell_origin(int cell) {
    return {kCellPitchX * (cell % kCellsInARow), kCellPitchY * (cell / kCellsInARow), 0};
}

inline std::string arm_name(int cell) {
    return "arm_" + std::to_string(cell);
}
inline std::string feed_name(int cell) {
    return "feed_" + std::to_string(cell);
}
inline std::string box_name(int cell, int number) {
    return "box_" + std::to_string(cell) + "_" + std::to_string(number);
}

}  // namespace arm_cell
