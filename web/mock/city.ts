// The mock's scene: a city of 100 buildings on a grid of streets, cars of four wheels in eight colours, one arm and one
// ball. Made from a seed, like the real one.
import type { PoseArray, SceneInfo, TypeInfo, Visual, BodyInfo } from "../src/wire/messages";

export const BLOCK_M = 12;
export const WHEEL_RADIUS = 0.05;
export const TRACK_HALF = 0.13;
const PAINT: [number, number, number][] = [
    [0.9, 0.38, 0.12],
    [0.15, 0.45, 0.75],
    [0.75, 0.15, 0.18],
    [0.2, 0.55, 0.35],
    [0.92, 0.75, 0.2],
    [0.85, 0.86, 0.88],
    [0.35, 0.3, 0.55],
    [0.1, 0.55, 0.6],
];
const FACADE: [number, number, number][] = [
    [0.84, 0.8, 0.74],
    [0.72, 0.62, 0.55],
    [0.6, 0.56, 0.58],
    [0.66, 0.7, 0.74],
    [0.8, 0.74, 0.66],
    [0.76, 0.68, 0.6],
];

/** Numbers in 0..1 from a seed (mulberry32). */
export function seeded(seed: number): () => number {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

const at = (x: number, y: number, z: number): PoseArray => [x, y, z, 1, 0, 0, 0];
const HINGE = { turn: 1, slide: 0, course: "circle" } as const;
const SLIDE = { turn: 0, slide: 1, course: "line" } as const;
const LYING: PoseArray = [0, 0, 0, Math.SQRT1_2, Math.SQRT1_2, 0, 0];

function carType(name: string, rgb: [number, number, number]): TypeInfo {
    const bodies: BodyInfo[] = [
        { parent: -1, frame: at(0, 0, 0), axis: [0, 0, 1], turn: 1, slide: 0, course: "none", q: 0, width: 0 },
    ];
    const chassis: Visual = { name: "body", shape: "box", size: [0.4, 0.2, 0.1], frame: at(0, 0, 0), rgb, alpha: 1 };
    const links = [{ name: "chassis", body: 0, frame: at(0, 0, 0), visuals: [chassis], collisions: [chassis] }];
    const joints: TypeInfo["joints"] = [];
    ["front_left", "front_right", "rear_left", "rear_right"].forEach((wheel, k) => {
        const x = k < 2 ? 0.15 : -0.15,
            y = k % 2 === 0 ? TRACK_HALF : -TRACK_HALF;
        bodies.push({
            parent: 0,
            frame: at(x, y, -0.03),
            axis: [0, 1, 0],
            ...HINGE,
            q: k,
            width: 1,
        });
        const tyre: Visual = {
            name: "tyre",
            shape: "cylinder",
            radius: WHEEL_RADIUS,
            length: 0.04,
            frame: LYING,
            rgb: [0.12, 0.12, 0.13],
            alpha: 1,
        };
        links.push({ name: `${wheel}_wheel`, body: k + 1, frame: at(0, 0, 0), visuals: [tyre], collisions: [tyre] });
        joints.push({
            name: wheel,
            kind: "continuous",
            body: k + 1,
            axes: 1,
            units: ["rad"],
            q: k,
            lower: [null],
            upper: [null],
            max_effort: [0.8],
            max_velocity: [40],
        });
    });
    return {
        name,
        like: 0,
        free_base: true,
        mass: 6.2,
        reach: 0.26,
        origin: at(0, 0, -0.08),
        bodies,
        links,
        joints,
        ranges: [Math.PI, Math.PI, Math.PI, Math.PI],
        sensors: [
            {
                name: "laser",
                kind: "laser",
                link: 0,
                frame: at(0.205, 0, 0.02),
                samples: 21,
                min_angle: -Math.PI / 2,
                max_angle: Math.PI / 2,
                vertical_samples: 1,
                vertical_min_angle: 0,
                vertical_max_angle: 0,
                range_min: 0.02,
                range_max: 6,
            },
            { name: "gps", kind: "gps", link: 0, frame: at(0, 0, 0) },
            { name: "compass", kind: "compass", link: 0, frame: at(0, 0, 0) },
            { name: "odometer", kind: "odometer", link: 0, frame: at(0, 0, 0) },
        ],
    };
}

/** A crane that stands still and turns: revolute, revolute with limits, prismatic. */
function craneType(): TypeInfo {
    const steel: [number, number, number] = [0.95, 0.72, 0.15];
    const box = (name: string, size: number[], frame: PoseArray): Visual => ({
        name,
        shape: "box",
        size,
        frame,
        rgb: steel,
        alpha: 1,
    });
    const foot: Visual = {
        name: "foot",
        shape: "cylinder",
        radius: 0.5,
        length: 0.4,
        frame: at(0, 0, 0.2),
        rgb: [0.3, 0.32, 0.36],
        alpha: 1,
    };
    const mast = box("mast", [0.25, 0.25, 3.6], at(0, 0, 1.8)),
        boom = box("boom", [3, 0.18, 0.18], at(1.5, 0, 0));
    const hook: Visual = {
        name: "hook",
        shape: "capsule",
        radius: 0.07,
        length: 0.5,
        frame: at(0, 0, -0.3),
        rgb: [0.2, 0.2, 0.22],
        alpha: 1,
    };
    return {
        name: "crane",
        like: PAINT.length,
        free_base: false,
        mass: 120,
        reach: 5,
        origin: at(0, 0, 0),
        bodies: [
            { parent: -1, frame: at(0, 0, 0.4), axis: [0, 0, 1], ...HINGE, q: 0, width: 1 },
            { parent: 0, frame: at(0, 0, 3.5), axis: [0, 1, 0], ...HINGE, q: 1, width: 1 },
            { parent: 1, frame: at(2.9, 0, 0), axis: [0, 0, -1], ...SLIDE, q: 2, width: 1 },
        ],
        links: [
            { name: "foot", body: -1, frame: at(0, 0, 0), visuals: [foot], collisions: [foot] },
            { name: "mast", body: 0, frame: at(0, 0, 0), visuals: [mast], collisions: [mast] },
            { name: "boom", body: 1, frame: at(0, 0, 0), visuals: [boom], collisions: [boom] },
            { name: "hook", body: 2, frame: at(0, 0, 0), visuals: [hook], collisions: [hook] },
        ],
        joints: [
            {
                name: "slew",
                kind: "continuous",
                body: 0,
                axes: 1,
                units: ["rad"],
                q: 0,
                lower: [null],
                upper: [null],
                max_effort: [400],
                max_velocity: [2],
            },
            {
                name: "luff",
                kind: "revolute",
                body: 1,
                axes: 1,
                units: ["rad"],
                q: 1,
                lower: [-0.9],
                upper: [0.3],
                max_effort: [900],
                max_velocity: [1],
            },
            {
                name: "hoist",
                kind: "prismatic",
                body: 2,
                axes: 1,
                units: ["m"],
                q: 2,
                lower: [0],
                upper: [2.4],
                max_effort: [300],
                max_velocity: [1],
            },
        ],
        sensors: [],
        ranges: [Math.PI, Math.PI, 2.5],
    };
}

function block(random: () => number, x: number, y: number, statics: Visual[]): void {
    const kind = Math.floor(random() * 5);
    const add = (dx: number, dy: number, size: [number, number], height: number) =>
        statics.push({
            name: "part",
            shape: "box",
            size: [size[0], size[1], height],
            frame: at(x + dx, y + dy, height / 2),
            rgb: FACADE[Math.floor(random() * FACADE.length)],
            alpha: 1,
        });
    if (kind === 0) {
        const height = 1.5 + random() * 4,
            radius = 2.6 + random() * 0.8;
        statics.push({
            name: "tower",
            shape: "cylinder",
            radius,
            length: height,
            frame: at(x, y, height / 2),
            rgb: FACADE[Math.floor(random() * 6)],
            alpha: 1,
        });
    } else if (kind === 1) {
        for (const dx of [-2.4, 2.4]) for (const dy of [-2.4, 2.4]) add(dx, dy, [3.2, 3.2], 1.5 + random() * 5);
    } else if (kind === 2) {
        for (const dx of [-2.4, 2.4]) add(dx, 0, [3.2, 8], 1.5 + random() * 4.5);
    } else if (kind === 3) {
        for (const dy of [-2.4, 2.4]) add(0, dy, [8, 3.2], 1.5 + random() * 4.5);
    } else {
        add(0, 0, [8, 8], 1 + random() * 2.5);
    }
}

/** Streets run between blocks; `half` blocks each way from the middle. */
export function makeCity(cars: number, seed: number): { scene: SceneInfo; half: number } {
    const random = seeded(seed),
        half = cars > 200 ? 8 : 5,
        statics: Visual[] = [],
        side = 2 * half * BLOCK_M + 24;
    statics.push({
        name: "plane",
        shape: "plane",
        size: [side, side],
        frame: at(0, 0, 0),
        rgb: [0.42, 0.43, 0.44],
        alpha: 1,
    });
    for (let i = -half; i < half; ++i)
        for (let j = -half; j < half; ++j) block(random, (i + 0.5) * BLOCK_M, (j + 0.5) * BLOCK_M, statics);
    const types = [...PAINT.map((rgb, k) => carType(`car_${k}`, rgb)), craneType()];
    const robots = Array.from({ length: cars }, (_, k) => ({ name: `car_${k}`, type: k % PAINT.length }));
    robots.push({ name: "crane", type: PAINT.length });
    return {
        half,
        scene: {
            scene: 1,
            world: "mock city",
            dt: 0.002,
            gravity: [0, 0, -9.8],
            seed,
            types,
            robots,
            statics,
            groups_max: 12,
        },
    };
}
