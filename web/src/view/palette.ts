// Colours of the picture: the two themes, and colours that tell groups apart.
import * as THREE from "three";
import type { Theme } from "../model/viewer_state";

export interface ScenePalette {
    skyTop: number;
    skyHorizon: number;
    ground: number;
    grid: number;
    gridStrength: number;
    sun: number;
    sunStrength: number;
    /** What the sky, its rim and the ground send. */
    lightSky: number;
    lightHorizon: number;
    lightGround: number;
    skyStrength: number;
    accent: number;
}

export const PALETTES: Record<Theme, ScenePalette> = {
    dark: {
        skyTop: 0x0d1117,
        skyHorizon: 0x1d242f,
        ground: 0x262d38,
        grid: 0x8fa3bd,
        gridStrength: 0.16,
        sun: 0xfff1dc,
        sunStrength: 2.3,
        lightSky: 0xbccfe8,
        lightHorizon: 0xd9dde4,
        lightGround: 0x8f8a84,
        skyStrength: 0.8,
        accent: 0x5aa9ff,
    },
    light: {
        skyTop: 0xc3d7ec,
        skyHorizon: 0xf1f4f8,
        ground: 0xe4e7eb,
        grid: 0x32465e,
        gridStrength: 0.13,
        sun: 0xfff4e3,
        sunStrength: 2.6,
        lightSky: 0xd3e2f5,
        lightHorizon: 0xf3f4f6,
        lightGround: 0xb5afa7,
        skyStrength: 0.82,
        accent: 0x0b6bd8,
    },
};

/** Twelve hues far apart, of like lightness; then around again, lighter and darker by turns. */
const HUES = [212, 24, 142, 282, 48, 338, 176, 4, 92, 250, 310, 196];

export function groupColour(index: number, out = new THREE.Color()): THREE.Color {
    const turn = Math.floor(index / HUES.length);
    const lightness = 0.56 + [0, 0.14, -0.14, 0.07][turn % 4];
    return out.setHSL(HUES[index % HUES.length] / 360, 0.72, lightness, THREE.SRGBColorSpace);
}

export function groupCss(index: number): string {
    return `#${groupColour(index).getHexString(THREE.SRGBColorSpace)}`;
}

const SLOW = new THREE.Color(0x3a5fcd),
    MIDDLE = new THREE.Color(0x35c46b),
    FAST = new THREE.Color(0xffb020);

/** 0 blue, 0.5 green, 1 amber. */
export function rampColour(f: number, out: THREE.Color): THREE.Color {
    const t = Math.max(0, Math.min(1, f));
    return t < 0.5 ? out.copy(SLOW).lerp(MIDDLE, t * 2) : out.copy(MIDDLE).lerp(FAST, t * 2 - 1);
}
