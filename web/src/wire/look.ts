// The world's own lights, sky and camera in the scene's JSON (docs/viewer-protocol.md).
import type { PoseArray, Triple } from "./messages";

export interface LightInfo {
    name: string;
    kind: "point" | "spot" | "directional";
    /** In the world, or in the link that carries it. */
    frame: PoseArray;
    rgb: Triple;
    intensity: number;
    shadows: boolean;
    /** In its own frame; spot and directional. */
    direction?: Triple;
    range?: number;
    /** Of 1 / (constant + linear d + quadratic d^2). */
    attenuation?: Triple;
    /** Inner and outer angle from side to side, rad; falloff. */
    spot?: Triple;
}

export interface SkyInfo {
    sky: boolean;
    shadows: boolean;
    grid: boolean;
    ambient?: Triple;
    background?: Triple;
    fog?: { rgb: Triple; start: number; end: number; density: number };
}

export interface CameraInfo {
    name: string;
    frame: PoseArray;
    orthographic: boolean;
    view?: string;
    track?: string;
}

export interface LookInfo {
    lights?: LightInfo[];
    scene?: SkyInfo;
    camera?: CameraInfo;
}
