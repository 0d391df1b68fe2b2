// The light of the sky as an environment: what faces the sky is lit by it, what shines mirrors it a little. Made anew
// when the theme changes. three.js would blur it by its PMREMGenerator, which costs a machine without a graphics
// processor seven seconds; this sky depends on the height above the horizon alone, so a table for each roughness is enough.
import * as THREE from "three";
import type { ScenePalette } from "./palette";

type Colour = [number, number, number];

/** Pixels of a face of the cube, for the levels of rising roughness. */
const SIZES = [128, 64, 32, 16, 8];
const ROWS = 256;
const RINGS = 48;
const SECTORS = 12;

const mix = (a: Colour, b: Colour, t: number) => a.map((value, k) => value + t * (b[k] - value)) as Colour;

function smooth(edge: number, x: number): number {
    const t = Math.min(1, x / edge);
    return t * t * (3 - 2 * t);
}

/** What comes from a direction; `up`: the sine of its height above the horizon. */
function skyColour(palette: ScenePalette): (up: number) => Colour {
    const [sky, rim, ground] = [palette.lightSky, palette.lightHorizon, palette.lightGround].map(
        (hex) => new THREE.Color().setHex(hex).toArray() as Colour,
    );
    const low = mix([0, 0, 0], rim, 0.8);
    return (up) => (up > 0 ? mix(rim, sky, smooth(0.6, up)) : mix(low, ground, smooth(0.25, -up)));
}

/**
 * Returns the light that a surface of this roughness reflects, seen along its normal: the mean of the sky over the GGX
 * lobe. A ring of the lobe has the same angle to the direction; rings are spread as visible normals are (Heitz 2018).
 */
export function reflected(palette: ScenePalette, roughness: number): (up: number) => Colour {
    const sky = skyColour(palette);
    if (roughness === 0) return sky;
    const alpha2 = roughness ** 4,
        rings = Array.from({ length: RINGS }, (_, k) => {
            const x = (k + 0.5) / RINGS;
            return (1 - x - alpha2 * x) / (1 - x + alpha2 * x);
        }).filter((cosine) => cosine > 0),
        sectors = Array.from({ length: SECTORS }, (_, k) => Math.cos(((k + 0.5) / SECTORS) * Math.PI));
    return (up) => {
        const sum: Colour = [0, 0, 0];
        let weight = 0;
        for (const cosine of rings)
            for (const sector of sectors) {
                const across = Math.sqrt(Math.max(0, (1 - up * up) * (1 - cosine * cosine)));
                sky(up * cosine + across * sector).forEach((value, c) => (sum[c] += cosine * value));
                weight += cosine;
            }
        return mix([0, 0, 0], sum, 1 / weight);
    };
}

/** The sine of the height of a pixel's direction: of the six faces, in the order of OpenGL; s and t from -1 to 1. */
const HEIGHTS: ((s: number, t: number) => number)[] = [
    (s) => -s,
    (s) => s,
    (_, t) => t,
    (_, t) => -t,
    () => 1,
    () => -1,
];

function level(palette: ScenePalette, size: number, roughness: number): THREE.CompressedTextureMipmap[] {
    const light = reflected(palette, roughness),
        rows = new Uint16Array(4 * ROWS);
    for (let row = 0; row < ROWS; ++row)
        [...light((2 * row + 1) / ROWS - 1), 1].forEach(
            (value, c) => (rows[4 * row + c] = THREE.DataUtils.toHalfFloat(value)),
        );
    return HEIGHTS.map((height) => {
        const data = new Uint16Array(4 * size * size);
        for (let y = 0; y < size; ++y)
            for (let x = 0; x < size; ++x) {
                const [s, t] = [(2 * x + 1) / size - 1, (2 * y + 1) / size - 1],
                    up = height(s, t) / Math.sqrt(1 + s * s + t * t),
                    row = Math.min(ROWS - 1, Math.floor(((up + 1) / 2) * ROWS));
                data.set(rows.subarray(4 * row, 4 * row + 4), 4 * (y * size + x));
            }
        return { data, width: size, height: size };
    });
}

/** A cube with prefiltered levels, as three.js' materials read them (PMREMGenerator.lodToRoughness). */
export function skyLight(palette: ScenePalette): THREE.Texture {
    const last = SIZES.length - 1,
        levels = SIZES.map((size, k) => level(palette, size, 1 - Math.sqrt(1 - k / last))),
        faces = HEIGHTS.map((_, face) => ({
            width: SIZES[0],
            height: SIZES[0],
            mipmaps: levels.map((faces) => faces[face]),
        }));
    // Only a "compressed" cube brings levels of its own from its first level on.
    const cube = new THREE.CompressedCubeTexture(faces as never, THREE.RGBAFormat as never, THREE.HalfFloatType);
    cube.mipmaps = levels.map((faces) => faces[0]);
    cube.minFilter = THREE.LinearMipmapLinearFilter;
    cube.colorSpace = THREE.LinearSRGBColorSpace;
    cube.isPMREMTexture = true;
    cube.needsUpdate = true;
    return cube;
}
