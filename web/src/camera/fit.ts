// The camera from which everything is inside the picture, as near as possible: exact for balls, whatever the aspect ratio
// and whatever part of the picture panels cover. In the camera's axes (right, up, forward) each edge of the free part is a
// plane through the eye; a ball is inside where it is on the inner side of all four. That is linear in the eye's place.
import type { CameraWords } from "../model/address";
import type { Triple } from "../wire/messages";

/** A ball about a thing, or one of its corners with radius 0. */
export interface Ball {
    at: Triple;
    radius: number;
}

/** A picture, and how much of it is covered at each side; CSS pixels. */
export interface FreePart {
    width: number;
    height: number;
    left: number;
    right: number;
    top: number;
    bottom: number;
}

export interface Sight {
    azimuth: number;
    elevation: number;
    orthographic: boolean;
}

export const FIELD_DEG = 46;
/** Of the free part's edges that stays empty. */
const MARGIN = 0.05;
const NEAREST_M = 0.3;
export const HALF_HEIGHT = Math.tan((FIELD_DEG / 2) * (Math.PI / 180));

const dot = (a: Triple, b: Triple) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Right, up and forward of a camera that looks at its target from this direction. */
export function axesOf(azimuth: number, elevation: number): { right: Triple; up: Triple; forward: Triple } {
    const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
    return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], forward: [-ce * ca, -ce * sa, -se] };
}

/** Tangents of the free part's edges from the middle of the picture: left and bottom to the other side are positive. */
function edges(free: FreePart): { left: number; right: number; top: number; bottom: number } {
    const unit = (2 * HALF_HEIGHT) / free.height,
        wide = free.width - free.left - free.right,
        high = free.height - free.top - free.bottom,
        inset = MARGIN * Math.min(wide, high);
    return {
        left: (free.width / 2 - free.left - inset) * unit,
        right: (free.width / 2 - free.right - inset) * unit,
        top: (free.height / 2 - free.top - inset) * unit,
        bottom: (free.height / 2 - free.bottom - inset) * unit,
    };
}

/** Along one axis of the picture: the farthest-forward depth of the eye, and where the eye then is. */
function along(balls: readonly Ball[], axis: Triple, forward: Triple, low: number, high: number) {
    let least = Infinity,
        most = -Infinity;
    for (const { at, radius } of balls) {
        const side = dot(at, axis),
            depth = dot(at, forward);
        most = Math.max(most, side - high * depth + radius * Math.hypot(1, high));
        least = Math.min(least, side + low * depth - radius * Math.hypot(1, low));
    }
    return {
        depth: (least - most) / (low + high),
        at: (depth: number) => (most + high * depth + least - low * depth) / 2,
    };
}

/** The same without perspective: the distance that the rig needs, and the middle. */
function flat(balls: readonly Ball[], axis: Triple, low: number, high: number) {
    let least = Infinity,
        most = -Infinity;
    for (const { at, radius } of balls) {
        least = Math.min(least, dot(at, axis) - radius);
        most = Math.max(most, dot(at, axis) + radius);
    }
    return { distance: (most - least) / (low + high), at: (d: number) => (most - high * d + least + low * d) / 2 };
}

export function fitted(balls: readonly Ball[], sight: Sight, free: FreePart): CameraWords {
    const { right, up, forward } = axesOf(sight.azimuth, sight.elevation),
        edge = edges(free),
        words = (eye: [number, number, number], distance: number): CameraWords => ({
            target: [0, 1, 2].map(
                (k) => right[k] * eye[0] + up[k] * eye[1] + forward[k] * (eye[2] + distance),
            ) as Triple,
            azimuth: sight.azimuth,
            elevation: sight.elevation,
            distance,
        });
    const depths = balls.map(({ at }) => dot(at, forward)),
        middle = (Math.min(...depths) + Math.max(...depths)) / 2;
    if (sight.orthographic) {
        const x = flat(balls, right, edge.left, edge.right),
            y = flat(balls, up, edge.bottom, edge.top),
            distance = Math.max(NEAREST_M, x.distance, y.distance);
        return words([x.at(distance), y.at(distance), middle - distance], distance);
    }
    const x = along(balls, right, forward, edge.left, edge.right),
        y = along(balls, up, forward, edge.bottom, edge.top),
        nearest = Math.min(...balls.map(({ at, radius }) => dot(at, forward) - radius)),
        depth = Math.min(x.depth, y.depth, nearest - NEAREST_M);
    return words([x.at(depth), y.at(depth), depth], middle - depth);
}

/** Where a point is seen, -1 to 1 across the whole picture; for tests and marks. */
export function seenAt(point: Triple, camera: CameraWords, free: FreePart, orthographic: boolean): [number, number] {
    const { right, up, forward } = axesOf(camera.azimuth, camera.elevation),
        from = point.map((value, k) => value - camera.target[k]) as Triple,
        depth = orthographic ? camera.distance : camera.distance + dot(from, forward),
        high = HALF_HEIGHT * depth;
    return [dot(from, right) / (high * (free.width / free.height)), dot(from, up) / high];
}
