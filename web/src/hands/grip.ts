// Where a robot is held: a point of one of its links, which stays the same point of the robot wherever it goes.
import { composed, inverse, transform } from "../kinematics/pose";
import { bodyAt, placeBodies } from "../kinematics/tree";
import type { World } from "../model/viewer_state";
import type { PoseArray, Triple } from "../wire/messages";

function bodies(world: World, robot: number): Float64Array {
    const type = world.fleet.type(robot),
        { drawn } = world.history,
        placed = new Float64Array((type.bodies.length + 1) * 7);
    placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], placed);
    return placed;
}

function linkFrame(world: World, robot: number, link: number): number[] {
    const info = world.fleet.type(robot).links[link],
        at = bodyAt(info?.body ?? -1);
    return composed(Array.from(bodies(world, robot).subarray(at, at + 7)), info?.frame ?? [0, 0, 0, 1, 0, 0, 0]);
}

/** Where the robot's own frame (its SDF model frame) is now: what a pose order moves. */
export function robotFrame(world: World, robot: number): PoseArray {
    const type = world.fleet.type(robot),
        at = bodyAt(type.links[0]?.body ?? -1);
    return composed(Array.from(bodies(world, robot).subarray(at, at + 7)), type.origin) as PoseArray;
}

/** The point of the world in the frame of the link, as it is drawn now. */
export function gripOf(world: World, robot: number, link: number, point: Triple): Triple {
    return transform(inverse(linkFrame(world, robot, link)), point);
}

/** Where that point of the link is drawn now. */
export function gripPoint(world: World, robot: number, link: number, grip: Triple): Triple {
    return transform(linkFrame(world, robot, link), grip);
}
