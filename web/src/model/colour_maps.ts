// Colours of numbers and labels in pictures of cameras, as red, green, blue from 0 to 255.
export type Rgb = readonly [number, number, number];

/** Evenly spaced; between them colours are mixed. */
const MAPS = {
    /** Near is bright and warm, far is dark and cool, so that it reads as a grey picture does, too. */
    depth: ["#fff3c4", "#f9c74f", "#f3722c", "#c2316b", "#6a1f7e", "#2b1a5a", "#0d0f2b"],
    grey: ["#ffffff", "#0a0a0a"],
    thermal: ["#06030f", "#2a0a5e", "#8b1a6b", "#d8442f", "#f7a11b", "#fff6c8"],
} as const;
export type ColourMap = keyof typeof MAPS;

/** Nothing within reach, and nearer than the camera sees. */
export const BEYOND: Rgb = [38, 43, 52],
    BEFORE: Rgb = [255, 0, 160];

const channels = (hex: string): Rgb => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)) as unknown as Rgb;

const STEPS = 256;
function table(stops: readonly string[]): Uint8ClampedArray {
    const colours = stops.map(channels),
        mixed = new Uint8ClampedArray(3 * STEPS);
    for (let i = 0; i < STEPS; ++i) {
        const place = (i / (STEPS - 1)) * (colours.length - 1),
            k = Math.min(Math.floor(place), colours.length - 2),
            part = place - k;
        for (let c = 0; c < 3; ++c) mixed[3 * i + c] = colours[k][c] * (1 - part) + colours[k + 1][c] * part;
    }
    return mixed;
}
const TABLES = Object.fromEntries(
    Object.entries(MAPS).map(([name, stops]) => [name, table(stops)]),
) as unknown as Record<ColourMap, Uint8ClampedArray>;

/** `part` from 0 to 1. */
export function colourAt(map: ColourMap, part: number): Rgb {
    const at = 3 * Math.round(Math.min(1, Math.max(0, part)) * (STEPS - 1)),
        t = TABLES[map];
    return [t[at], t[at + 1], t[at + 2]];
}

/** For a scale beside the picture. */
export const gradientOf = (map: ColourMap): string => `linear-gradient(to right, ${MAPS[map].join(", ")})`;

/** Neighbouring labels differ much; 0 is nothing. `instance`: others of the label are darker or brighter. */
export function labelColour(label: number, instance = 0): Rgb {
    if (label === 0) return [24, 27, 33];
    const hue = (label * 137.508) % 360,
        light = 0.58 + 0.13 * (((instance + 1) % 3) - 1),
        a = 0.62 * Math.min(light, 1 - light),
        channel = (n: number) => {
            const k = (n + hue / 30) % 12;
            return Math.round(255 * (light - a * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
        };
    return [channel(0), channel(8), channel(4)];
}

export const cssOf = ([r, g, b]: Rgb): string => `rgb(${r} ${g} ${b})`;

/** Pixels of numbers in colours. */
export function paintNumbers(
    values: Float32Array,
    low: number,
    high: number,
    map: ColourMap,
): Uint8ClampedArray<ArrayBuffer> {
    const pixels = new Uint8ClampedArray(4 * values.length),
        scale = high > low ? 1 / (high - low) : 0;
    for (let i = 0; i < values.length; ++i) {
        const value = values[i];
        pixels.set(
            value === Infinity ? BEYOND : value === -Infinity ? BEFORE : colourAt(map, (value - low) * scale),
            4 * i,
        );
        pixels[4 * i + 3] = 255;
    }
    return pixels;
}
