// How the mock's cars move: each drives round and round a block until a person gives it an order; then it is a cart that
// obeys wheel speeds, velocities and pushes. No physics, but what a page needs to be tried against.
import { BLOCK_M, seeded, TRACK_HALF, WHEEL_RADIUS } from "./city";
import { type Acting, addActing, advanceActing, obeyActing } from "./acting";
import type { OrderAction, SceneInfo } from "../src/wire/messages";

export interface Car {
    x: number;
    y: number;
    z: number;
    yaw: number;
    vx: number;
    vy: number;
    turn: number;
    wheels: number[];
    targets: number[];
    manual: boolean;
    /** N, while time < until. */
    push: { x: number; y: number; until: number };
    loop: { x: number; y: number; half: number; at: number; speed: number; clockwise: boolean };
}

export interface Crane {
    q: number[];
    v: number[];
    targets: { mode: string; value: number }[];
}

export interface Traffic {
    time: number;
    cars: Car[];
    crane: Crane;
    acting: Acting;
}

const CORNER_M = 0.9;
const MASS_KG = 6.2;

/** Place and heading on a square loop with round corners, `s` metres from its start. */
function onLoop(loop: Car["loop"], s: number): { x: number; y: number; yaw: number } {
    const straight = 2 * (loop.half - CORNER_M),
        corner = (Math.PI / 2) * CORNER_M,
        side = straight + corner;
    const around = 4 * side;
    const t = ((s % around) + around) % around,
        n = Math.floor(t / side),
        along = t - n * side;
    const bend = Math.max(0, along - straight) / CORNER_M;
    const px = along < straight ? -loop.half + CORNER_M + along : loop.half - CORNER_M + CORNER_M * Math.sin(bend);
    const py = along < straight ? -loop.half : -loop.half + CORNER_M * (1 - Math.cos(bend));
    const turn = (n * Math.PI) / 2,
        c = Math.cos(turn),
        sn = Math.sin(turn);
    const x = c * px - sn * py,
        y = sn * px + c * py,
        yaw = turn + bend;
    return loop.clockwise ? { x: loop.x + x, y: loop.y - y, yaw: -yaw } : { x: loop.x + x, y: loop.y + y, yaw };
}

export function makeTraffic(scene: SceneInfo, half: number, seed: number): Traffic {
    const random = seeded(seed + 7),
        cars: Car[] = [];
    const count = scene.robots.length - 1;
    for (let k = 0; k < count; ++k) {
        const i = Math.floor(random() * 2 * half) - half,
            j = Math.floor(random() * 2 * half) - half,
            size = 1 + Math.floor(random() * 2);
        const clockwise = random() < 0.5;
        const loop = {
            x: (i + size / 2) * BLOCK_M,
            y: (j + size / 2) * BLOCK_M,
            half: (size * BLOCK_M) / 2 + (clockwise ? 0.7 : -0.7),
            at: random() * 100,
            speed: 0.6 + random() * 1.4,
            clockwise,
        };
        cars.push({
            x: 0,
            y: 0,
            z: 0.08,
            yaw: 0,
            vx: 0,
            vy: 0,
            turn: 0,
            wheels: [0, 0, 0, 0],
            targets: [0, 0, 0, 0],
            manual: false,
            push: { x: 0, y: 0, until: 0 },
            loop,
        });
    }
    const traffic = {
        acting: addActing(scene),
        time: 0,
        cars,
        crane: {
            q: [0, -0.3, 0.5],
            v: [0, 0, 0],
            targets: [0.4, -0.3, 0.5].map((value, k) => ({ mode: k === 0 ? "velocity" : "position", value })),
        },
    };
    for (const car of cars) drive(car, 0, 0);
    return traffic;
}

function drive(car: Car, dt: number, time: number): void {
    if (!car.manual) {
        car.loop.at += car.loop.speed * dt;
        const before = { x: car.x, y: car.y, yaw: car.yaw };
        Object.assign(car, onLoop(car.loop, car.loop.at));
        if (dt > 0) {
            car.vx = (car.x - before.x) / dt;
            car.vy = (car.y - before.y) / dt;
            car.turn = Math.atan2(Math.sin(car.yaw - before.yaw), Math.cos(car.yaw - before.yaw)) / dt;
        }
        car.wheels = car.wheels.map(
            (angle, k) =>
                angle + ((car.loop.speed + (k % 2 === 0 ? -1 : 1) * car.turn * TRACK_HALF) / WHEEL_RADIUS) * dt,
        );
        return;
    }
    const left = ((car.targets[0] + car.targets[2]) / 2) * WHEEL_RADIUS,
        right = ((car.targets[1] + car.targets[3]) / 2) * WHEEL_RADIUS;
    const pace = (left + right) / 2,
        f = 1 - Math.exp(-4 * dt);
    car.vx += f * (pace * Math.cos(car.yaw) - car.vx);
    car.vy += f * (pace * Math.sin(car.yaw) - car.vy);
    car.turn += f * ((right - left) / (3 * TRACK_HALF) - car.turn);
    if (time < car.push.until) {
        car.vx += (car.push.x / MASS_KG) * dt;
        car.vy += (car.push.y / MASS_KG) * dt;
    }
    car.x += car.vx * dt;
    car.y += car.vy * dt;
    car.yaw += car.turn * dt;
    car.z += (0.08 - car.z) * Math.min(1, 6 * dt);
    car.wheels = car.wheels.map((angle, k) => angle + car.targets[k] * dt);
}

export function advance(traffic: Traffic, dt: number): void {
    for (const car of traffic.cars) drive(car, dt, traffic.time);
    const crane = traffic.crane;
    for (let k = 0; k < 3; ++k) {
        const target = crane.targets[k];
        crane.v[k] =
            target.mode === "velocity" ? target.value : Math.max(-0.8, Math.min(0.8, 4 * (target.value - crane.q[k])));
        crane.q[k] += crane.v[k] * dt;
    }
    advanceActing(traffic.acting, dt);
    traffic.time += dt;
}

/** Empty where it is obeyed; else why not. */
export function obey(traffic: Traffic, robot: number, order: OrderAction, tick: number): string {
    if (robot >= traffic.acting.first) return obeyActing(traffic.acting, robot, order, tick);
    const car = traffic.cars[robot];
    if (car === undefined) return obeyCrane(traffic.crane, order);
    if (order.action === "command") return `robot 'car_${robot}' has no command '${order.name}'`;
    if (order.action === "joint" && order.joint >= 4) return `car has no joint ${order.joint}`;
    car.manual = true;
    if (order.action === "pose") {
        [car.x, car.y] = order.pose;
        car.z = order.pose[2] + 0.08;
        car.yaw = Math.atan2(
            2 * (order.pose[3] * order.pose[6] + order.pose[4] * order.pose[5]),
            1 - 2 * (order.pose[5] ** 2 + order.pose[6] ** 2),
        );
        car.vx = car.vy = car.turn = 0;
    } else if (order.action === "velocity") {
        [car.vx, car.vy] = order.linear;
        car.turn = order.angular[2];
    } else if (order.action === "wrench") {
        car.push = { x: order.force[0], y: order.force[1], until: traffic.time + order.duration };
    } else if (order.action === "pull") {
        if (order.max_force === 0) return "";
        const [c, s] = [Math.cos(car.yaw), Math.sin(car.yaw)];
        car.x = order.target[0] - c * order.point[0] + s * order.point[1];
        car.y = order.target[1] - s * order.point[0] - c * order.point[1];
        car.vx = car.vy = 0;
    } else if (order.action === "joint") {
        car.targets[order.joint] = order.mode === "passive" ? 0 : order.target;
    }
    return "";
}

function obeyCrane(crane: Crane, order: OrderAction): string {
    if (order.action !== "joint") return "the crane's base is fixed: only its joints can be moved";
    if (order.mode === "position" && order.joint === 1 && (order.target < -0.9 || order.target > 0.3))
        return "luff: the target lies outside its limits";
    crane.targets[order.joint] =
        order.mode === "passive" ? { mode: "velocity", value: 0 } : { mode: order.mode, value: order.target };
    return "";
}
