// What the mock says of its traffic: State messages, and the JSON of status, groups, robots and overlays.
import { actingReport, encodeActing } from "./acting";
import type { MemberStatus, PoseArray, SceneInfo, Triple } from "../src/wire/messages";
import type { Car, Traffic } from "./traffic";

const SCALE = 32767;
const TURN = 2 * Math.PI;

function wrapped(angle: number): number {
    return angle - TURN * Math.floor((angle + Math.PI) / TURN);
}

export function carPose(car: Car): PoseArray {
    return [car.x, car.y, car.z - 0.08, Math.cos(car.yaw / 2), 0, 0, Math.sin(car.yaw / 2)];
}

/** All robots' entries of a State, as numbers rounded to what travels. */
export function encodeRobots(traffic: Traffic): Map<number, Uint8Array> {
    const entries = new Map<number, Uint8Array>();
    traffic.cars.forEach((car, r) =>
        entries.set(
            r,
            entry(
                r,
                [car.x, car.y, car.z],
                car.yaw,
                car.wheels.map((angle) => wrapped(angle) / Math.PI),
            ),
        ),
    );
    const q = traffic.crane.q;
    entries.set(
        traffic.cars.length,
        entry(traffic.cars.length, [3, 3, 0], 0, [wrapped(q[0]) / Math.PI, q[1] / Math.PI, q[2] / 2.5]),
    );
    encodeActing(traffic.acting, entries);
    return entries;
}

export function entry(robot: number, place: number[], yaw: number, joints: number[]): Uint8Array {
    const data = new DataView(new ArrayBuffer(24 + 2 * joints.length));
    data.setUint32(0, robot, true);
    place.forEach((value, k) => data.setFloat32(4 + 4 * k, value, true));
    [Math.cos(yaw / 2), 0, 0, Math.sin(yaw / 2)].forEach((value, k) =>
        data.setInt16(16 + 2 * k, Math.round(value * SCALE), true),
    );
    joints.forEach((value, k) =>
        data.setInt16(24 + 2 * k, Math.max(-SCALE, Math.min(SCALE, Math.round(value * SCALE))), true),
    );
    return new Uint8Array(data.buffer);
}

export function encodeState(
    scene: number,
    time: number,
    dt: number,
    whole: boolean,
    entries: Iterable<Uint8Array>,
    resting: boolean,
): Uint8Array {
    const list = [...entries],
        bytes = 28 + list.reduce((sum, one) => sum + one.length, 0),
        out = new Uint8Array(bytes),
        data = new DataView(out.buffer);
    data.setUint8(0, 1);
    data.setUint8(1, (whole ? 1 : 0) | (resting ? 2 : 0));
    data.setUint32(4, scene, true);
    data.setFloat64(8, Math.round(time / dt), true);
    data.setFloat64(16, time, true);
    data.setUint32(24, list.length, true);
    let at = 28;
    for (const one of list) {
        out.set(one, at);
        at += one.length;
    }
    return out;
}

/** Cars within 1.5 m of each other are one island; islands go to Simulators round and round. */
export function groupsOf(
    traffic: Traffic,
    scene: SceneInfo,
    members: MemberStatus[],
): { simulator: number[]; island: number[] } {
    const count = scene.robots.length,
        root = Array.from({ length: count }, (_, k) => k);
    const find = (k: number): number => (root[k] === k ? k : (root[k] = find(root[k])));
    const cells = new Map<string, number[]>();
    traffic.cars.forEach((car, r) => {
        for (let i = -1; i <= 1; ++i)
            for (let j = -1; j <= 1; ++j)
                for (const other of cells.get(`${Math.floor(car.x / 1.5) + i} ${Math.floor(car.y / 1.5) + j}`) ?? [])
                    if (Math.hypot(traffic.cars[other].x - car.x, traffic.cars[other].y - car.y) < 1.5)
                        root[Math.max(find(r), find(other))] = Math.min(find(r), find(other));
        const key = `${Math.floor(car.x / 1.5)} ${Math.floor(car.y / 1.5)}`;
        cells.set(key, [...(cells.get(key) ?? []), r]);
    });
    const island = root.map((_, k) => find(k));
    return { island, simulator: island.map((of) => members[(of * 7) % Math.max(1, members.length)]?.id ?? 1) };
}

export function robotReport(traffic: Traffic, scene: SceneInfo, robot: number): object {
    const car = traffic.cars[robot],
        common = {
            type: "robot",
            scene: scene.scene,
            robot,
            tick: Math.round(traffic.time / scene.dt),
            time: traffic.time,
        };
    if (robot >= traffic.acting.first) return { ...common, ...actingReport(traffic.acting, robot) };
    if (car === undefined) {
        const { q, v, targets } = traffic.crane;
        return {
            ...common,
            pose: [3, 3, 0, 1, 0, 0, 0],
            linear: [0, 0, 0],
            angular: [0, 0, 0],
            sensors: [],
            contacts: [],
            joints: q.map((position, k) => ({
                position: [position],
                velocity: [v[k]],
                motors: [{ mode: targets[k].mode, target: targets[k].value, effort: v[k] * 20, max_effort: 400 }],
            })),
        };
    }
    const ranges = Array.from({ length: 21 }, (_, k) =>
        Math.max(0.3, Math.min(6, 3 + 2 * Math.sin(k * 0.7 + traffic.time) + Math.sin(car.x))),
    );
    return {
        ...common,
        pose: carPose(car),
        linear: [car.vx, car.vy, 0],
        angular: [0, 0, car.turn],
        joints: car.wheels.map((angle, k) => ({
            position: [angle],
            velocity: [wheelSpeed(car, k)],
            motors: [
                {
                    mode: "velocity",
                    target: wheelSpeed(car, k),
                    effort: 0.1 + 0.05 * Math.sin(traffic.time * 3 + k),
                    max_effort: 0.8,
                },
            ],
        })),
        sensors: [
            { ranges },
            {
                position: [52.2197 + car.y / 111320, 21.0121 + car.x / 68200, 113],
                world: [car.x, car.y, 0.2],
                velocity: [car.vx, car.vy, 0],
                taken: traffic.time,
            },
            { yaw: wrapped(car.yaw), orientation: carPose(car).slice(3), taken: traffic.time },
            { distance: Math.abs(car.loop.at), speed: Math.hypot(car.vx, car.vy), taken: traffic.time },
        ],
        contacts: [0, 1, 2, 3].map(() => ({ other: -1, normal_force: 15.2 })),
    };
}

function wheelSpeed(car: Car, k: number): number {
    return car.manual ? car.targets[k] : car.loop.speed / 0.05;
}

function wheelContacts(car: Car, robot: number): object[] {
    const c = Math.cos(car.yaw),
        s = Math.sin(car.yaw);
    return [
        [0.15, 0.13],
        [0.15, -0.13],
        [-0.15, 0.13],
        [-0.15, -0.13],
    ].map(([x, y]) => ({
        a: robot,
        b: -1,
        point: [car.x + c * x - s * y, car.y + s * x + c * y, 0],
        normal: [0, 0, 1],
        force: [0.6 * c, 0.6 * s, 15.2],
    }));
}

export function overlayReport(traffic: Traffic, scene: SceneInfo, wanted: string[]): object {
    const report: Record<string, unknown> = {
        type: "overlay",
        scene: scene.scene,
        tick: Math.round(traffic.time / scene.dt),
    };
    if (wanted.includes("contacts"))
        report.contacts = traffic.cars.slice(0, 200).flatMap((car, r) => wheelContacts(car, r));
    const reach = (car: Car): [Triple, Triple] => {
        const dx = Math.abs(car.vx) * 0.1,
            dy = Math.abs(car.vy) * 0.1;
        return [
            [car.x - 0.26 - dx, car.y - 0.26 - dy, 0],
            [car.x + 0.26 + dx, car.y + 0.26 + dy, 0.3],
        ];
    };
    if (wanted.includes("bounds")) report.bounds = traffic.cars.map((car, robot) => ({ robot, box: reach(car) }));
    return report;
}

/** Shares that change a little, as those of a run do. */
export function profileReport(traffic: Traffic): object {
    const wobble = 1 + 0.2 * Math.sin(traffic.time);
    const stages: [string, number][] = [
        ["forward kinematics", 0.03],
        ["narrow phase", 0.05 * wobble],
        ["constraint rows", 0.04],
        ["solve velocities", 0.1 * wobble],
        ["integrate", 0.02],
    ];
    return {
        type: "profile",
        ticks: 500,
        stages: stages.map(([name, seconds]) => ({ name, seconds })),
        islands: 20_000,
        largest_island_robots: 3,
        most_contacts: 14,
        largest_part_robots: 3,
        iterations_per_tick_mean: 120,
        iterations_per_island_mean: 2.9,
        iterations_per_island_most: 11,
        residual_worst: 3e-10,
        friction_solves: 20_000,
        friction_missed_share: 0.01,
        friction_error_worst: 0.012,
        friction_tolerance: 1e-3,
    };
}
