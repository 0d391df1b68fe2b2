// Where links are now, in the picture.
import type { World } from "../model/viewer_state";
import type { TypeInfo } from "../wire/messages";
import { composed, IDENTITY } from "./pose";
import { bodyAt, placeBodies } from "./tree";

let bodies = new Float64Array(0);

/** Pose of a link of a robot in the world, as it is drawn. */
export function linkPose(world: World, robot: number, link: number): number[] {
    const type = world.fleet.type(robot),
        { drawn } = world.history,
        needed = (type.bodies.length + 1) * 7,
        info = type.links[link];
    if (bodies.length < needed) bodies = new Float64Array(needed);
    placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], bodies);
    const at = bodyAt(info?.body ?? -1);
    return composed(bodies.subarray(at, at + 7), info?.frame ?? IDENTITY);
}

/** The middle of what a link looks like, in its own frame. */
export function linkMiddle(type: TypeInfo, link: number): [number, number, number] {
    const info = type.links[link],
        shapes = info === undefined ? [] : info.collisions.length > 0 ? info.collisions : info.visuals,
        sum: [number, number, number] = [0, 0, 0];
    for (const { frame } of shapes) for (let k = 0; k < 3; ++k) sum[k] += frame[k] / shapes.length;
    return sum;
}
