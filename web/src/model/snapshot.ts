// Where all robots are at one time: base poses (seven numbers each) and joint coordinates. A State message tells only
// what moved, so a snapshot is the one before it with these changes.
import type { Fleet } from "./fleet";
import { POSE_WIDTH } from "../kinematics/pose";

export class Snapshot {
    time = 0;
    tick = 0;
    readonly base: Float32Array;
    readonly joints: Float32Array;
    /** 1 where the robot moved since the snapshot before. */
    readonly moved: Uint8Array;

    constructor(fleet: Fleet) {
        this.base = new Float32Array(fleet.count * POSE_WIDTH);
        this.joints = new Float32Array(fleet.coordinates);
        this.moved = new Uint8Array(fleet.count);
        for (let r = 0; r < fleet.count; ++r) this.base[r * POSE_WIDTH + 3] = 1;
    }

    copyFrom(other: Snapshot): void {
        this.time = other.time;
        this.tick = other.tick;
        this.base.set(other.base);
        this.joints.set(other.joints);
        this.moved.fill(0);
    }
}
