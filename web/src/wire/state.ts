// Reads State, the one binary message: which robots moved, and where they are. Layout and scales: docs/viewer-protocol.md.
import type { Fleet } from "../model/fleet";
import {
    FLAG_PREVIEW,
    FLAG_REST,
    FLAG_WHOLE,
    readStateHeader,
    STATE_BYTES,
    STATE_COORDINATE_SCALE,
    STATE_ENTRY_COORDINATES_AT,
    STATE_ENTRY_ORIENTATION_AT,
    STATE_ENTRY_POSITION_AT,
    STATE_ENTRY_ROBOT_AT,
    STATE_KIND,
    STATE_ORIENTATION_SCALE,
} from "../protocol";
import type { Snapshot } from "../model/snapshot";

const ORIENTATION_UNIT = 1 / STATE_ORIENTATION_SCALE;
const COORDINATE_UNIT = 1 / STATE_COORDINATE_SCALE;

export interface StateHeader {
    whole: boolean;
    resting: boolean;
    /** Of an earlier moment that was asked for. */
    preview: boolean;
    scene: number;
    tick: number;
    time: number;
    robots: number;
}

export function readHeader(data: DataView): StateHeader {
    if (data.byteLength < STATE_BYTES) throw new Error(`a State of ${data.byteLength} bytes is too short`);
    if (data.getUint8(0) !== STATE_KIND)
        throw new Error(`a binary message of kind ${data.getUint8(0)}, which this page does not know`);
    const { flags, scene, tick, time, robots } = readStateHeader(data);
    return {
        whole: (flags & FLAG_WHOLE) !== 0,
        resting: (flags & FLAG_REST) !== 0,
        preview: (flags & FLAG_PREVIEW) !== 0,
        scene,
        tick,
        time,
        robots,
    };
}

/** Writes what the message says into `snapshot`, which holds the State before it. */
export function readState(data: DataView, fleet: Fleet, snapshot: Snapshot): StateHeader {
    const header = readHeader(data);
    let at = STATE_BYTES;
    for (let n = 0; n < header.robots; ++n) {
        const robot = data.getUint32(at + STATE_ENTRY_ROBOT_AT, true);
        if (robot >= fleet.count) throw new Error(`a State tells of robot ${robot}, but the scene has ${fleet.count}`);
        at = readRobot(data, at, robot, fleet, snapshot);
    }
    if (at !== data.byteLength) throw new Error(`a State has ${data.byteLength} bytes, its robots take ${at}`);
    snapshot.time = header.time;
    snapshot.tick = header.tick;
    return header;
}

function readRobot(data: DataView, start: number, robot: number, fleet: Fleet, snapshot: Snapshot): number {
    const base = snapshot.base,
        b = robot * 7;
    for (let k = 0; k < 3; ++k) base[b + k] = data.getFloat32(start + STATE_ENTRY_POSITION_AT + 4 * k, true);
    let norm = 0;
    for (let k = 0; k < 4; ++k) {
        const component = data.getInt16(start + STATE_ENTRY_ORIENTATION_AT + 2 * k, true) * ORIENTATION_UNIT;
        base[b + 3 + k] = component;
        norm += component * component;
    }
    const scale = norm > 0 ? 1 / Math.sqrt(norm) : 1;
    for (let k = 3; k < 7; ++k) base[b + k] *= scale;
    let at = start + STATE_ENTRY_COORDINATES_AT;
    const first = fleet.firstCoordinate[robot],
        ranges = fleet.ranges[fleet.typeOf[robot]];
    for (let k = 0; k < ranges.length; ++k, at += 2)
        snapshot.joints[first + k] = data.getInt16(at, true) * COORDINATE_UNIT * ranges[k];
    snapshot.moved[robot] = 1;
    return at;
}
