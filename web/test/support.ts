// Scenes and State messages for the unit tests, written byte by byte from the protocol's text, not by the page's own code.
import { Fleet } from "../src/model/fleet";
import type { BodyInfo, PoseArray, SceneInfo, TypeInfo } from "../src/wire/messages";

export const IDENTITY: PoseArray = [0, 0, 0, 1, 0, 0, 0];

const MOTIONS = {
    free: { turn: 1, slide: 0, course: "none", width: 0 },
    revolute: { turn: 1, slide: 0, course: "circle", width: 1 },
    prismatic: { turn: 0, slide: 1, course: "line", width: 1 },
    screw: { turn: 1, slide: 0.02, course: "line", width: 1 },
    ball: { turn: 1, slide: 0, course: "quaternion", width: 4 },
} as const;

export function body(joint: keyof typeof MOTIONS, parent: number, q: number, more: Partial<BodyInfo> = {}): BodyInfo {
    return { parent, frame: IDENTITY, axis: [0, 0, 1], q, ...MOTIONS[joint], ...more };
}

export function typeOf(bodies: BodyInfo[], ranges: number[], more: Partial<TypeInfo> = {}): TypeInfo {
    return {
        name: "type",
        like: 0,
        free_base: true,
        mass: 1,
        reach: 1,
        origin: IDENTITY,
        bodies,
        links: [],
        joints: [],
        sensors: [],
        ranges,
        ...more,
    };
}

export function sceneOf(types: TypeInfo[], robots: number[]): SceneInfo {
    return {
        scene: 1,
        world: "test",
        dt: 0.002,
        gravity: [0, 0, -9.8],
        types,
        robots: robots.map((type, r) => ({ name: `robot_${r}`, type })),
        statics: [],
        groups_max: 12,
    };
}

export function fleetOf(types: TypeInfo[], robots: number[]): Fleet {
    return new Fleet(sceneOf(types, robots));
}

export interface Entry {
    robot: number;
    place: [number, number, number];
    turn: [number, number, number, number];
    coordinates: number[];
}

export function stateBytes(time: number, entries: Entry[], flags = 0, scene = 1): DataView {
    const bytes = 28 + entries.reduce((sum, entry) => sum + 24 + 2 * entry.coordinates.length, 0),
        data = new DataView(new ArrayBuffer(bytes));
    data.setUint8(0, 1);
    data.setUint8(1, flags);
    data.setUint32(4, scene, true);
    data.setFloat64(8, time / 0.002, true);
    data.setFloat64(16, time, true);
    data.setUint32(24, entries.length, true);
    let at = 28;
    for (const { robot, place, turn, coordinates } of entries) {
        data.setUint32(at, robot, true);
        place.forEach((value, k) => data.setFloat32(at + 4 + 4 * k, value, true));
        turn.forEach((value, k) => data.setInt16(at + 16 + 2 * k, Math.round(value * 32767), true));
        coordinates.forEach((value, k) => data.setInt16(at + 24 + 2 * k, value, true));
        at += 24 + 2 * coordinates.length;
    }
    return data;
}

export function close(actual: ArrayLike<number>, expected: readonly number[], tolerance: number): string {
    for (let k = 0; k < expected.length; ++k)
        if (!(Math.abs(actual[k] - expected[k]) <= tolerance))
            return `component ${k}: ${actual[k]} is not ${expected[k]}`;
    return "";
}
