// What the next tick starts from: the solved impulses, as the loads of motors and contacts; and how far the
// correction of penetrations may go. Over T: see rows.h.
#pragma once

#include <span>

#include "physics/contact/contact_rows.h"

namespace roboss {

/// A blow is not a load: the smaller of the last two impulses, if they push the same way.
template <class T>
void store_warm_start(const T& impulse, MotorSetpointT<T>& motor) {
    const T size = smaller(magnitude(impulse), magnitude(motor.impulse));
    const MaskOf<T> lasts = impulse * motor.impulse > T(0);
    motor.load = select(lasts, select(impulse < T(0), -size, size), T(0));
    motor.impulse = impulse;
}

/// A soft contact's load is the share of its impulse that its spring gave by overlap that motion made
/// (contact::sprung_depth).
template <class T>
T spring_load(const ContactRowT<T>& row) {
    const T overlap = row.overlap + row.normal.impulse * row.normal.compliance,
            sprung = overlap - row.unsprung;
    return select(sprung > T(0), row.normal.impulse * (sprung / overlap), T(0));
}

template <class T>
void take_impulse(const ContactRowT<T>& row, const FrictionEllipse& friction, ContactT<T>& contact) {
    const ContactFrameT<T> frame = frame_of(contact.normal, friction);
    contact.load = row.soft ? spring_load(row)
                            : smaller(smaller(contact.impulse, row.normal.impulse), row.warm_start_max);
    contact.impulse = row.normal.impulse;
    contact.friction = frame.t1 * row.slip.impulse_1 + frame.t2 * row.slip.impulse_2;
}

/// Mending may move no joint or base faster than this beyond what the robot does anyhow; more than that comes
/// of shapes that start deep in each other, where a contact has hardly a lever on a light link. Returns the
/// share of the correction that a robot may do, at most 1, from its velocities before and after the tick and
/// the displacement solved for.
template <class T>
T share_of_correction(std::span<const T> before, std::span<const T> after, std::span<const T> displacement) {
    constexpr double kCorrectionMax = 20;  // rad/s or m/s
    T fastest = 0, correction = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        fastest = larger(larger(fastest, magnitude(before[i])), magnitude(after[i]));
        correction = larger(correction, magnitude(displacement[i] - after[i]));
    }
    const T most = kCorrectionMax + 2.0 * fastest;
    return select(correction > most, most / correction, T(1));
}

}  // namespace roboss
