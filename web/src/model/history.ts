// The last few snapshots, and the poses between them: what is drawn lies a few milliseconds behind what came, so that
// motion is smooth although States come in bursts.
import type { Fleet } from "./fleet";
import { Course } from "./fleet";
import { Snapshot } from "./snapshot";
import { POSE_WIDTH, slerp } from "../kinematics/pose";

const KEPT = 6;
/** Where nothing is seen, m. */
const BELOW = -1e6;
const TURN = 2 * Math.PI;

/** From angle a towards b the short way round. */
export function betweenAngles(a: number, b: number, f: number): number {
    let way = (b - a) % TURN;
    if (way > Math.PI) way -= TURN;
    else if (way < -Math.PI) way += TURN;
    return a + way * f;
}

export class History {
    private readonly ring: Snapshot[];
    private filled = 0;
    private newest = -1;
    /** What sample() wrote last. */
    readonly drawn: Snapshot;
    /** Robots whose drawn pose changed by the last sample(). */
    readonly changed: Uint8Array;
    private readonly unsettled: Uint8Array;
    private readonly ahead = new Map<number, ArrayLike<number>>();

    constructor(private readonly fleet: Fleet) {
        this.ring = Array.from({ length: KEPT }, () => new Snapshot(fleet));
        this.drawn = new Snapshot(fleet);
        this.changed = new Uint8Array(fleet.count);
        this.unsettled = new Uint8Array(fleet.count).fill(1);
    }

    get latest(): Snapshot | null {
        return this.newest < 0 ? null : this.ring[this.newest];
    }

    get earliestTime(): number {
        return this.filled === 0 ? 0 : this.back(this.filled - 1).time;
    }

    /** The snapshot that the next State is written into: a copy of the latest. */
    next(): Snapshot {
        const slot = this.ring[(this.newest + 1) % KEPT];
        if (this.latest !== null) slot.copyFrom(this.latest);
        else slot.moved.fill(0);
        return slot;
    }

    /** Takes the snapshot that next() gave. A time that goes back (a rewind) leaves only this one. */
    take(): void {
        const before = this.latest;
        this.newest = (this.newest + 1) % KEPT;
        const taken = this.ring[this.newest];
        if (before !== null && taken.time < before.time) {
            this.filled = 1;
            this.unsettled.fill(1);
            return;
        }
        if (before !== null && taken.time === before.time) this.unsettled.fill(1);
        this.filled = Math.min(this.filled + 1, KEPT);
        for (let r = 0; r < this.fleet.count; ++r) this.unsettled[r] |= taken.moved[r];
    }

    private back(n: number): Snapshot {
        return this.ring[(this.newest - n + KEPT) % KEPT];
    }

    /** Poses of an earlier moment into `drawn`; robots that are hidden lie far below everything. */
    hold(moment: Snapshot, hidden: Uint8Array): void {
        this.drawn.copyFrom(moment);
        for (let r = 0; r < this.fleet.count; ++r) if (hidden[r] !== 0) this.drawn.base[r * POSE_WIDTH + 2] = BELOW;
        this.changed.fill(1);
        this.unsettled.fill(1);
    }

    /** Poses at `time` into `drawn`, and which of them changed. */
    sample(time: number): void {
        if (this.filled === 0) return;
        let n = 0;
        while (n + 1 < this.filled && this.back(n).time > time) ++n;
        const from = this.back(n),
            to = n === 0 ? from : this.back(n - 1);
        const f = from === to ? 1 : Math.max(0, Math.min(1, (time - from.time) / (to.time - from.time || 1)));
        this.drawn.time = from === to ? to.time : from.time + f * (to.time - from.time);
        this.drawn.tick = Math.round(from.tick + f * (to.tick - from.tick));
        const settled = from === to;
        for (let r = 0; r < this.fleet.count; ++r) {
            this.changed[r] = this.unsettled[r];
            if (this.unsettled[r] === 0) continue;
            this.between(r, from, to, f);
            if (settled) this.unsettled[r] = 0;
        }
        this.drawnAhead();
    }

    /** Draws the base of a robot here until `show` is called without a pose: where an order will put it. */
    show(robot: number, base: ArrayLike<number> | null): void {
        if (base === null) this.ahead.delete(robot);
        else this.ahead.set(robot, base);
        this.unsettled[robot] = 1;
    }

    /** Robots that are drawn elsewhere than they are. */
    get shownAhead(): number[] {
        return [...this.ahead.keys()];
    }

    private drawnAhead(): void {
        for (const [robot, base] of this.ahead)
            for (let k = 0; k < POSE_WIDTH; ++k) this.drawn.base[robot * POSE_WIDTH + k] = base[k];
    }

    private between(robot: number, from: Snapshot, to: Snapshot, f: number): void {
        const b = robot * POSE_WIDTH,
            out = this.drawn;
        for (let k = b; k < b + 3; ++k) out.base[k] = from.base[k] + f * (to.base[k] - from.base[k]);
        slerp(out.base, b + 3, from.base, b + 3, to.base, b + 3, f);
        const first = this.fleet.firstCoordinate[robot],
            courses = this.fleet.courses[this.fleet.typeOf[robot]];
        for (let k = 0; k < courses.length; ++k) {
            const q = first + k,
                a = from.joints[q],
                z = to.joints[q];
            if (courses[k] === Course.Circle) out.joints[q] = betweenAngles(a, z, f);
            else if (courses[k] === Course.Line) out.joints[q] = a + f * (z - a);
            else if (courses[k] === Course.QuaternionStart) slerp(out.joints, q, from.joints, q, to.joints, q, f);
        }
    }
}
