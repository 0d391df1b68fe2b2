// Reads Picture, the binary message with what a camera sees: a header, JSON about it, and a JPEG or PNG. Numbers (depths,
// temperatures) stand in a PNG as 256 red + green: 0 below all, 65535 above all (docs/viewer-protocol.md).
import type { PoseArray } from "./messages";
import { PICTURE_BYTES, PICTURE_KIND, readPictureHeader } from "../protocol";

export type Shows = "color" | "depth" | "labels" | "boxes" | "temperature";

export interface PictureAbout {
    shows: Shows;
    columns: number;
    rows: number;
    /** Of the camera in the world: x ahead, y left, z up. */
    pose: PoseArray;
    /** fx fy cx cy, pixels of this picture. */
    intrinsics: number[];
    /** k1 k2 p1 p2 k3. */
    distortion: number[];
    low?: number;
    high?: number;
    unit?: string;
    /** Left, top, right, bottom, pixels. */
    boxes?: number[][];
    /** Of boxes in space: where their eight corners are seen; null: behind the camera. */
    corners?: ([number, number] | null)[][];
    /** Of each box. */
    labels?: number[];
}

export interface PictureMessage {
    scene: number;
    tick: number;
    time: number;
    robot: number;
    sensor: number;
    about: PictureAbout;
    file: Blob;
}

export const isPicture = (data: ArrayBuffer): boolean =>
    data.byteLength > PICTURE_BYTES && new DataView(data).getUint8(0) === PICTURE_KIND;

export function readPicture(data: ArrayBuffer): PictureMessage {
    const { scene, tick, time, robot, sensor, about_bytes } = readPictureHeader(new DataView(data)),
        end = PICTURE_BYTES + about_bytes;
    if (end > data.byteLength) throw new Error(`a Picture of ${data.byteLength} bytes ends in its JSON`);
    const about = JSON.parse(
        new TextDecoder().decode(new Uint8Array(data, PICTURE_BYTES, about_bytes)),
    ) as PictureAbout;
    const type = about.shows === "color" || about.shows === "boxes" ? "image/jpeg" : "image/png";
    return { scene, tick, time, robot, sensor, about, file: new Blob([new Uint8Array(data, end)], { type }) };
}

const BELOW = 0,
    ABOVE = 65535,
    STEPS = 65533;

/** Values of the pixels, from their red and green; -Infinity below all, Infinity above all. */
export function numbersOf(rgba: Uint8ClampedArray, low: number, high: number): Float32Array {
    const values = new Float32Array(rgba.length / 4);
    for (let i = 0; i < values.length; ++i) {
        const count = 256 * rgba[4 * i] + rgba[4 * i + 1];
        values[i] =
            count === BELOW ? -Infinity : count === ABOVE ? Infinity : low + ((count - 1) / STEPS) * (high - low);
    }
    return values;
}
