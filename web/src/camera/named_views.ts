// Directions with names. Robots face along x, so the front view looks against it, and the side view along y.
import type { CameraInfo } from "../wire/look";
import type { CameraWords } from "../model/address";
import { rotate } from "../kinematics/pose";

export const NAMED_VIEWS = ["top", "front", "side", "isometric"] as const;
export type NamedView = (typeof NAMED_VIEWS)[number];

/** From which a camera looks at its target. */
export interface Direction {
    azimuth: number;
    elevation: number;
}

/** rad */
export function angleBetween(a: Direction, b: Direction): number {
    const flat = Math.cos(a.elevation) * Math.cos(b.elevation) * Math.cos(a.azimuth - b.azimuth);
    return Math.acos(Math.max(-1, Math.min(1, flat + Math.sin(a.elevation) * Math.sin(b.elevation))));
}

export const DIRECTIONS: Record<NamedView, Direction> = {
    top: { azimuth: -Math.PI / 2, elevation: Math.PI / 2 - 0.001 },
    front: { azimuth: 0, elevation: 0.02 },
    side: { azimuth: -Math.PI / 2, elevation: 0.02 },
    isometric: { azimuth: -Math.PI / 4, elevation: Math.atan(Math.SQRT1_2) },
};

/** The camera that the file describes: at its place, along its x axis. `depth`: of what it looks at, m. */
export function wordsOfCamera(camera: CameraInfo, depth: number): CameraWords {
    const eye = camera.frame,
        ahead = rotate(eye, [1, 0, 0]),
        toGround = ahead[2] < -0.02 ? -eye[2] / ahead[2] : Infinity,
        distance = Math.max(0.5, toGround > 0 && toGround < 4 * depth ? toGround : depth);
    return {
        target: [0, 1, 2].map((k) => eye[k] + ahead[k] * distance) as [number, number, number],
        azimuth: Math.atan2(-ahead[1], -ahead[0]),
        elevation: Math.asin(Math.max(-1, Math.min(1, -ahead[2]))),
        distance,
    };
}
