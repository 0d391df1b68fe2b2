// What the scanner sees: where the box nearest to the light barrier lies, and how it is turned. Pure
// functions.
#pragma once

#include <optional>
#include <span>

namespace arm_cell {

/// The top of a box, in the frame of the cell: m, and the direction of its longer side in (-pi/2, pi/2].
struct SeenBox {
    double x = 0, y = 0, top = 0, yaw = 0;
};

/// Of the ranges of the scanner, kScannerBeams rows (along x) of kScannerBeams beams (along y), m.
/// std::nullopt: there is none that is wholly in its field.
std::optional<SeenBox> find_box(std::span<const double> ranges);

}  // namespace arm_cell
