// How a shape looks, in the scene's JSON (docs/viewer-protocol.md).
import type { PoseArray, Triple } from "./messages";

/** What lies over a colour: pictures by their hash, and numbers from 0 to 1. */
export interface Finish {
    colour?: string;
    normal?: string;
    roughness_map?: string;
    metalness_map?: string;
    roughness?: number;
    metalness?: number;
    /** Light that it gives off. */
    emissive?: Triple;
}

export interface Visual {
    name: string;
    shape: "box" | "sphere" | "cylinder" | "capsule" | "cone" | "ellipsoid" | "plane" | "mesh";
    frame: PoseArray;
    rgb?: Triple;
    alpha?: number;
    size?: number[];
    radius?: number;
    length?: number;
    radii?: Triple;
    mesh?: number;
    /** Of a collision shape: it takes no part in the surface motion of its link. */
    still?: boolean;
    finish?: Finish;
    /** false: it throws no shadow. */
    casts?: boolean;
}
