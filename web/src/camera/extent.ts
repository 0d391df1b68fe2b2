// What "the whole world" is: robots and finite scenery as balls and corners. Three rules keep a picture useful:
// planes are endless and do not count; a flat thing that is five times as wide as all the rest is a ground, and counts as
// little; and what lies farther out than twenty times the radius that holds three quarters of all things is left out.
import type { World } from "../model/viewer_state";
import { transform } from "../kinematics/pose";
import type { PoseArray, Triple, Visual } from "../wire/messages";
import type { MeshData } from "../wire/scene_source";
import type { Ball } from "./fit";

/** One thing of the world, as the balls and corners that enclose it. */
export interface Thing {
    balls: Ball[];
    centre: Triple;
    /** Half of its greatest extent, m. */
    radius: number;
    isFlat: boolean;
}

const OUTLIER_FACTOR = 20;
const OUTLIER_SHARE = 0.75;
const GROUND_FACTOR = 5;
const FLAT = 0.02;
/** A longer reach hardly ever shows. */
const REACH_SEEN_M = 3;

function distance(a: Triple, b: Triple): number {
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function boxOfMesh({ positions }: MeshData): { low: Triple; high: Triple } {
    const low: Triple = [Infinity, Infinity, Infinity],
        high: Triple = [-Infinity, -Infinity, -Infinity];
    for (let k = 0; k < positions.length; ++k) {
        low[k % 3] = Math.min(low[k % 3], positions[k]);
        high[k % 3] = Math.max(high[k % 3], positions[k]);
    }
    return { low, high };
}

/** The box about a shape in its own frame; null: endless, or nothing. */
function boxOf(visual: Visual, meshes: ReadonlyMap<number, MeshData>): { low: Triple; high: Triple } | null {
    const radius = visual.radius ?? 1,
        half = (visual.length ?? 1) / 2,
        about = (x: number, y: number, z: number) => ({ low: [-x, -y, -z] as Triple, high: [x, y, z] as Triple });
    switch (visual.shape) {
        case "plane":
            return null;
        case "box": {
            const size = visual.size ?? [1, 1, 1];
            return about(size[0] / 2, size[1] / 2, size[2] / 2);
        }
        case "sphere":
            return about(radius, radius, radius);
        case "cylinder":
        case "cone":
            return about(radius, radius, half);
        case "capsule":
            return about(radius, radius, half + radius);
        case "ellipsoid": {
            const radii = visual.radii ?? [1, 1, 1];
            return about(radii[0], radii[1], radii[2]);
        }
        case "mesh": {
            const mesh = meshes.get(visual.mesh ?? -1);
            return mesh === undefined || mesh.positions.length === 0 ? null : boxOfMesh(mesh);
        }
    }
}

function thingOfBox(low: Triple, high: Triple, frame: PoseArray): Thing {
    const balls: Ball[] = [];
    for (const x of [low[0], high[0]])
        for (const y of [low[1], high[1]])
            for (const z of [low[2], high[2]]) balls.push({ at: transform(frame, [x, y, z]) as Triple, radius: 0 });
    const size = high.map((value, k) => value - low[k]).sort((a, b) => a - b);
    const centre = [0, 1, 2].map((k) => balls.reduce((sum, ball) => sum + ball.at[k], 0) / 8) as Triple;
    return { balls, centre, radius: Math.hypot(...size) / 2, isFlat: size[0] < FLAT * size[1] };
}

function middleOf(values: number[]): number {
    const sorted = [...values].sort((a, b) => a - b);
    return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
}

/** Without grounds and outliers; all of them where that would leave nothing. */
export function worthSeeing(things: readonly Thing[]): Thing[] {
    const rest = things.filter((thing) => !thing.isFlat),
        reach = Math.max(0, ...rest.map((a) => distance(a.centre, rest[0].centre) + a.radius)),
        solid = things.filter((thing) => !thing.isFlat || rest.length === 0 || thing.radius < GROUND_FACTOR * reach);
    if (solid.length < 3) return solid;
    const middle = [0, 1, 2].map((k) => middleOf(solid.map((thing) => thing.centre[k]))) as Triple,
        away = (thing: Thing) => Math.max(0, distance(thing.centre, middle) - thing.radius),
        sorted = solid.map(away).sort((a, b) => a - b),
        usual = sorted[Math.floor(OUTLIER_SHARE * (sorted.length - 1))],
        size = middleOf(solid.map((thing) => thing.radius));
    return solid.filter((thing) => away(thing) <= OUTLIER_FACTOR * Math.max(usual, size));
}

export function thingsOf(world: World): Thing[] {
    const { scene, meshes } = world.loaded,
        base = world.history.drawn.base,
        things: Thing[] = [];
    for (let r = 0; r < world.fleet.count; ++r) {
        const radius = Math.min(REACH_SEEN_M, world.fleet.type(r).reach),
            centre: Triple = [base[r * 7], base[r * 7 + 1], base[r * 7 + 2]];
        things.push({ balls: [{ at: centre, radius }], centre, radius, isFlat: false });
    }
    for (const visual of scene.statics) {
        const box = boxOf(visual, meshes);
        if (box !== null) things.push(thingOfBox(box.low, box.high, visual.frame));
    }
    return things;
}

/** What the whole world comes to; a few metres about the origin where it is empty. */
export function ballsOf(world: World): Ball[] {
    const balls = worthSeeing(thingsOf(world)).flatMap((thing) => thing.balls);
    return balls.length > 0 ? balls : [{ at: [0, 0, 0], radius: 2 }];
}
