// How the marks on a moving surface lie and move, from how the surface moves: in rows along a straight motion, in rings
// around an axis. Pure functions; the picture is made by flow_marks.ts.
import { inverse, transform } from "../kinematics/pose";
import type { PoseArray, Triple, Visual } from "../wire/messages";
import type { SurfaceMotion } from "../wire/onboard";

/** A motion as marks show it, in the frame of the marks. */
export interface Flow {
    linear: Triple;
    belt: Triple;
    /** rad/s; where it is not 0, the surface turns, and `linear` and `belt` are 0. */
    angular: Triple;
    /** m: a point of the axis. */
    at: Triple;
}

const RESTS = 1e-9;

function cross(a: readonly number[], b: readonly number[]): Triple {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function scaled(a: readonly number[], by: number): Triple {
    return [a[0] * by, a[1] * by, a[2] * by];
}

function sum(a: readonly number[], b: readonly number[]): Triple {
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

/** Round along its own z, or all round: a belt around it is a turn. */
function radiusOf(visual: Visual): number | null {
    return visual.shape === "cylinder" || visual.shape === "sphere" || visual.shape === "capsule"
        ? (visual.radius ?? null)
        : null;
}

/** The motion of one shape, in the frame in which motion and shape are given. `at`: what `angular` turns about. */
export function flowOf(motion: SurfaceMotion, visual: Visual, at: Triple = [0, 0, 0]): Flow {
    const belt = motion.belt ?? [0, 0, 0],
        radius = radiusOf(visual),
        middle: Triple = [visual.frame[0], visual.frame[1], visual.frame[2]];
    let { linear, angular } = motion,
        axis = at;
    if (Math.hypot(...angular) < RESTS && Math.hypot(...linear) < RESTS && radius !== null && radius > 0) {
        angular = scaled(belt, 1 / radius);
        axis = middle;
    }
    const turn = Math.hypot(...angular);
    if (turn < RESTS) return { linear, belt, angular: [0, 0, 0], at: middle };
    // linear + angular x (p - at) vanishes on the axis through at + angular x linear / turn^2.
    const shift = scaled(cross(angular, linear), 1 / (turn * turn));
    return { linear: [0, 0, 0], belt: [0, 0, 0], angular, at: sum(axis, shift) };
}

/** A shape given in the world, in the frame `pose` (of the world). */
export function shapeIn(pose: readonly number[], visual: Visual): Visual {
    const back = inverse(pose),
        place = transform(back, visual.frame),
        [, , , w, x, y, z] = visual.frame,
        [bw, bx, by, bz] = back.slice(3);
    const frame: PoseArray = [
        ...place,
        bw * w - bx * x - by * y - bz * z,
        bw * x + bx * w + by * z - bz * y,
        bw * y - bx * z + by * w + bz * x,
        bw * z + bx * y - by * x + bz * w,
    ];
    return { ...visual, frame };
}

const ROW_M = 0.4;

/** Rows of marks: whole ones fill the shape. */
export interface Rows {
    /** m, width of a row, and how many there are; on a disc: of rings. */
    pitch: number;
    rows: number;
    /** The same of rows around a round shape, along its axis. */
    side: number;
    sides: number;
}

function filled(width: number): [number, number] {
    const rows = Math.max(1, Math.round(width / ROW_M));
    return [width / rows, rows];
}

function widthOf(visual: Visual): number {
    switch (visual.shape) {
        case "box":
            return [...(visual.size ?? [1, 1, 1])].sort((a, b) => a - b)[1];
        case "plane":
            return Math.min(visual.size?.[0] || ROW_M, visual.size?.[1] || ROW_M);
        case "ellipsoid":
            return Math.min(...(visual.radii ?? [1, 1, 1]));
        case "mesh":
            return ROW_M;
        default:
            return visual.radius ?? 1;
    }
}

export function rowsOf(visual: Visual): Rows {
    const width = widthOf(visual),
        round = visual.shape === "cylinder" || visual.shape === "capsule",
        [pitch, rows] = filled(width > 0 ? width : ROW_M),
        [side, sides] = round && (visual.length ?? 0) > 0 ? filled(visual.length ?? 1) : [pitch, rows];
    return { pitch, rows, side, sides };
}

/** Where the marks have got to: how far, and how far round. */
export class FlowPhase {
    readonly moved: Triple = [0, 0, 0];
    readonly belted: Triple = [0, 0, 0];
    angle = 0;

    /** Time passes, or is turned back; `pitch`: after such a distance, marks look the same. */
    advance(flow: Flow, seconds: number, pitch: number): void {
        for (let k = 0; k < 3; ++k) {
            this.moved[k] += flow.linear[k] * seconds;
            this.belted[k] += flow.belt[k] * seconds;
        }
        this.angle = (this.angle + Math.hypot(...flow.angular) * seconds) % (2 * Math.PI);
        for (const way of [this.moved, this.belted]) {
            // Kept short, so that single precision in the picture suffices.
            const length = Math.hypot(...way),
                spare = Math.floor(length / pitch) * pitch;
            if (length > 100 * pitch) for (let k = 0; k < 3; ++k) way[k] *= 1 - spare / length;
        }
    }
}
