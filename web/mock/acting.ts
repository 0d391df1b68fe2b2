// The mock's robots that act: a rover that is driven by its command, a conveyor and a turntable, a gripper, and boxes that
// are held and carried. No physics, but what a page needs to be tried against.
import type { OrderAction, PoseArray, SceneInfo, TypeInfo, Visual } from "../src/wire/messages";
import type { BondInfo, ChannelInfo, SurfaceReport } from "../src/wire/onboard";
import { entry } from "./reports";

type Place = { x: number; y: number; z: number; yaw: number };

interface Body extends Place {
    name: string;
    type: TypeInfo;
    size: [number, number, number];
    fixed: boolean;
    command: { tick: number; values: number[] }[];
}

interface Held extends BondInfo {
    max_force: number | null;
    from: Place;
}

export interface Acting {
    first: number;
    bodies: Body[];
    bonds: Held[];
}

const PLACE_X = 66;

const TWIST: ChannelInfo = {
    name: "cmd_vel",
    list: false,
    values: [
        { name: "linear_x", unit: "m/s" },
        { name: "linear_y", unit: "m/s" },
        { name: "angular_z", unit: "rad/s" },
    ],
};
const BELT: ChannelInfo = { name: "track_cmd_vel", list: false, values: [{ name: "velocity", unit: "m/s" }] };
const TURN: ChannelInfo = { name: "turn_vel", list: false, values: [{ name: "velocity", unit: "rad/s" }] };
const PATH: ChannelInfo = {
    name: "path",
    list: true,
    values: [
        { name: "x", unit: "m" },
        { name: "y", unit: "m" },
    ],
};

function typeOf(like: number, name: string, shape: Visual, fixed: boolean, channels: ChannelInfo[]): TypeInfo {
    const frame: PoseArray = [0, 0, 0, 1, 0, 0, 0];
    return {
        name,
        like,
        free_base: !fixed,
        mass: 4,
        reach: Math.hypot(...(shape.size ?? [shape.radius ?? 1, shape.length ?? 1])),
        origin: frame,
        bodies: fixed
            ? []
            : [{ parent: -1, frame, axis: [0, 0, 1], turn: 1, slide: 0, course: "none", q: 0, width: 0 }],
        links: [{ name: "body", body: fixed ? -1 : 0, frame, visuals: [shape], collisions: [shape] }],
        joints: [],
        sensors: [],
        ranges: [],
        ...(channels.length > 0 ? { channels } : {}),
    };
}

/** name, size (a turntable: radius, height), colour, place, fixed, commands */
const ROBOTS: [string, number[], [number, number, number], [number, number, number], boolean, ChannelInfo[]][] = [
    ["rover", [0.6, 0.4, 0.2], [0.2, 0.5, 0.9], [0, -2, 0.1], false, [TWIST, PATH]],
    ["belt", [3, 0.6, 0.3], [0.35, 0.38, 0.42], [0, 0, 0.15], true, [BELT]],
    ["turntable", [0.8, 0.2], [0.5, 0.52, 0.55], [2.8, 0, 0.1], true, [TURN]],
    ["gripper", [0.2, 0.2, 0.6], [0.95, 0.6, 0.15], [-2, -1, 0.3], false, [TWIST]],
    ["box_1", [0.3, 0.3, 0.3], [0.8, 0.55, 0.3], [-1.2, 0, 0.45], false, []],
    ["box_2", [0.3, 0.3, 0.3], [0.8, 0.55, 0.3], [-1.7, -1, 0.15], false, []],
];

/** Adds them to the scene, behind all others. */
export function addActing(scene: SceneInfo): Acting {
    const acting: Acting = { first: scene.robots.length, bodies: [], bonds: [] };
    for (const [name, size, rgb, [x, y, z], fixed, channels] of ROBOTS) {
        const frame: PoseArray = [0, 0, 0, 1, 0, 0, 0],
            shape: Visual =
                size.length === 2
                    ? { name, shape: "cylinder", radius: size[0], length: size[1], frame, rgb }
                    : { name, shape: "box", size, frame, rgb };
        const type = typeOf(scene.types.length, name, shape, fixed, channels),
            edges: [number, number, number] =
                size.length === 2 ? [2 * size[0], 2 * size[0], size[1]] : [size[0], size[1], size[2]];
        scene.robots.push({ name, type: scene.types.push(type) - 1 });
        const command = channels.map((channel) => ({
            tick: -1,
            values: channel.list ? [] : channel.values.map(() => 0),
        }));
        acting.bodies.push({ name, type, size: edges, fixed, x: PLACE_X + x, y, z, yaw: 0, command });
    }
    scene.flows = [
        {
            shape: { name: "chute", shape: "box", size: [2, 0.5, 0.2], frame: [PLACE_X, 1.5, 0.1, 1, 0, 0, 0] },
            linear: [0.4, 0, 0],
            angular: [0, 0, 0],
            belt: [0, 0, 0],
            at: [0, 0, 0],
        },
    ];
    scene.statics.push({ ...scene.flows[0].shape, rgb: [0.4, 0.4, 0.42] });
    return acting;
}

export function advanceActing(acting: Acting, dt: number): void {
    const held = new Set(acting.bonds.map((bond) => bond.other));
    acting.bodies.forEach((body, k) => {
        if (body.fixed || held.has(acting.first + k)) return;
        const [forwards = 0, left = 0, turn = 0] = body.command[0]?.values ?? [];
        body.x += (forwards * Math.cos(body.yaw) - left * Math.sin(body.yaw)) * dt;
        body.y += (forwards * Math.sin(body.yaw) + left * Math.cos(body.yaw)) * dt;
        body.yaw += turn * dt;
    });
    const box = acting.bodies.find((body) => body.name === "box_1"),
        belt = acting.bodies.find((body) => body.name === "belt");
    if (box !== undefined && belt !== undefined && !held.has(acting.first + acting.bodies.indexOf(box)))
        if (Math.abs(box.x - belt.x) < 1.5 && Math.abs(box.y - belt.y) < 0.3) box.x += belt.command[0].values[0] * dt;
    for (const { robot, other, from } of acting.bonds) {
        const a = acting.bodies[robot - acting.first],
            b = acting.bodies[other - acting.first],
            c = Math.cos(a.yaw),
            s = Math.sin(a.yaw);
        Object.assign(b, {
            x: a.x + c * from.x - s * from.y,
            y: a.y + s * from.x + c * from.y,
            z: a.z + from.z,
            yaw: a.yaw + from.yaw,
        });
    }
}

/** What is between two boxes, m; how the mock measures reach. */
function gap(a: Body, b: Body): number {
    const apart = (k: 0 | 1 | 2, d: number) => Math.max(0, Math.abs(d) - (a.size[k] + b.size[k]) / 2);
    return Math.hypot(apart(0, a.x - b.x), apart(1, a.y - b.y), apart(2, a.z - b.z));
}

export function obeyActing(acting: Acting, robot: number, order: OrderAction, tick: number): string {
    const body = acting.bodies[robot - acting.first];
    if (order.action === "command") {
        const k = body.type.channels?.findIndex((channel) => channel.name === order.name) ?? -1,
            channel = body.type.channels?.[k];
        if (channel === undefined) return `robot '${body.name}' has no command '${order.name}'`;
        const width = channel.values.length;
        if (channel.list ? order.values.length % width !== 0 : order.values.length !== width)
            return `command '${order.name}' of robot '${body.name}' has ${order.values.length} values; it takes ${width}`;
        body.command[k] = { tick, values: order.values };
    } else if (order.action === "attach") {
        const other = acting.bodies[order.other - acting.first];
        if (other === undefined || other === body) return `attach order of robot '${body.name}' names no other robot`;
        if (gap(body, other) > order.reach) return "";
        const [dx, dy, c, s] = [other.x - body.x, other.y - body.y, Math.cos(body.yaw), Math.sin(body.yaw)],
            from = { x: c * dx + s * dy, y: -s * dx + c * dy, z: other.z - body.z, yaw: other.yaw - body.yaw };
        const { link, other_link, max_force = null } = order;
        acting.bonds.push({ robot, link, other: order.other, other_link, max_force, from });
    } else if (order.action === "detach") {
        acting.bonds = acting.bonds.filter((bond) => bond.robot !== robot || bond.other !== order.other);
    } else if (order.action === "pose") {
        [body.x, body.y, body.z] = order.pose;
    } else if (order.action === "velocity") {
        return body.fixed ? `the base of robot '${body.name}' is fixed to the world` : "";
    }
    return "";
}

export function encodeActing(acting: Acting, entries: Map<number, Uint8Array>): void {
    acting.bodies.forEach((body, k) =>
        entries.set(acting.first + k, entry(acting.first + k, [body.x, body.y, body.z], body.yaw, [])),
    );
}

function surfacesOf(body: Body): SurfaceReport[] {
    const speed = body.command[0]?.values[0] ?? 0;
    if (speed === 0) return [];
    if (body.name === "belt") return [{ link: 0, linear: [speed, 0, 0], angular: [0, 0, 0], belt: [0, 0, 0] }];
    if (body.name === "turntable") return [{ link: 0, linear: [0, 0, 0], angular: [0, 0, speed], belt: [0, 0, 0] }];
    return [];
}

export function actingExtras(acting: Acting): object {
    return {
        surfaces: acting.bodies.flatMap((body, k) =>
            surfacesOf(body).map((surface) => ({ robot: acting.first + k, ...surface })),
        ),
        bonds: acting.bonds.map(({ robot, link, other, other_link }) => ({ robot, link, other, other_link })),
    };
}

export function actingReport(acting: Acting, robot: number): object {
    const body = acting.bodies[robot - acting.first],
        bonds = acting.bonds.map((bond) => ({ ...bond, force: 39.2, torque: 0.4, max_torque: null })),
        list = (name: string, items: object[]) => (items.length > 0 ? { [name]: items } : {});
    return {
        pose: [body.x, body.y, body.z, Math.cos(body.yaw / 2), 0, 0, Math.sin(body.yaw / 2)],
        linear: [body.fixed ? 0 : (body.command[0]?.values[0] ?? 0), 0, 0],
        angular: [0, 0, 0],
        joints: [],
        sensors: [],
        contacts: [],
        ...list("channels", body.command),
        ...list("surfaces", surfacesOf(body)),
        ...list(
            "bonds",
            bonds.filter((bond) => bond.robot === robot),
        ),
        ...list(
            "held_by",
            bonds.filter((bond) => bond.other === robot).map((bond) => ({ ...bond, other: bond.robot })),
        ),
    };
}
