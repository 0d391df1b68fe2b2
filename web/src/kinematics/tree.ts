// Where the bodies of a robot are, from its base pose and joint coordinates: X_WB = X_WP * frame * motion(q), bodies
// parents first. The same rule as the simulator's joint_motion, in the numbers of the State messages.
import type { BodyInfo, TypeInfo } from "../wire/messages";
import { compose, type Numbers, POSE_WIDTH } from "./pose";

const motion = new Float64Array(POSE_WIDTH);

/** How a body moves in its joint's frame; `q` and `at`: the robot's joint coordinates. */
function writeMotion(body: BodyInfo, q: Numbers, at: number): void {
    const value = q[at + body.q],
        axis = body.axis;
    motion[0] = motion[1] = motion[2] = motion[4] = motion[5] = motion[6] = 0;
    motion[3] = 1;
    if (body.course === "quaternion") {
        for (let k = 0; k < 4; ++k) motion[3 + k] = q[at + body.q + k];
        return;
    }
    if (body.turn !== 0) {
        const half = (body.turn * value) / 2,
            s = Math.sin(half);
        motion[3] = Math.cos(half);
        for (let k = 0; k < 3; ++k) motion[4 + k] = axis[k] * s;
    }
    const displacement = body.slide * value;
    if (displacement !== 0) for (let k = 0; k < 3; ++k) motion[k] = axis[k] * displacement;
}

/** Poses of all bodies of one robot into `out`, seven numbers each; the base frame comes first (body -1), then body 0, ... */
export function placeBodies(
    type: TypeInfo,
    base: Numbers,
    baseAt: number,
    q: Numbers,
    qAt: number,
    out: Float64Array,
): void {
    for (let k = 0; k < POSE_WIDTH; ++k) out[k] = base[baseAt + k];
    const bodies = type.bodies;
    for (let b = 0; b < bodies.length; ++b) {
        const body = bodies[b],
            at = (b + 1) * POSE_WIDTH;
        if (body.course === "none") {
            for (let k = 0; k < POSE_WIDTH; ++k) out[at + k] = base[baseAt + k];
            continue;
        }
        compose(out, at, out, (body.parent + 1) * POSE_WIDTH, body.frame, 0);
        writeMotion(body, q, qAt);
        compose(out, at, out, at, motion, 0);
    }
}

/** Where the pose of body `body` starts in what placeBodies wrote. */
export function bodyAt(body: number): number {
    return (body + 1) * POSE_WIDTH;
}
