import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { PALETTES } from "../src/view/palette";
import { reflected, skyLight } from "../src/view/sky_light";

const near = (a: readonly number[], b: readonly number[], bound: number, what: string) =>
    a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < bound, `${what}: ${a.join()} and ${b.join()}`));

test("a surface that is wholly rough and faces up gathers the upper half by its cosine", () => {
    const mirror = reflected(PALETTES.dark, 0),
        steps = 2000,
        gathered = [0, 0, 0];
    // The mean over the half sphere, weighted by the cosine z: 2 z dz.
    for (let k = 0; k < steps; ++k) {
        const z = (k + 0.5) / steps;
        mirror(z).forEach((value, c) => (gathered[c] += (2 * z * value) / steps));
    }
    near(reflected(PALETTES.dark, 1)(1), gathered, 2e-3, "up");
});

test("what is hardly rough reflects as a mirror does, and blur never goes beyond the colours of the sky", () => {
    const mirror = reflected(PALETTES.light, 0);
    for (const up of [-1, -0.6, 0.4, 1]) near(reflected(PALETTES.light, 0.05)(up), mirror(up), 5e-3, `${up}`);
    const all = Array.from({ length: 401 }, (_, k) => mirror(k / 200 - 1)),
        bound = (pick: typeof Math.min, c: number) => pick(...all.map((one) => one[c]));
    for (const roughness of [0.2, 0.6, 1])
        for (let up = -1; up <= 1; up += 0.125)
            reflected(
                PALETTES.light,
                roughness,
            )(up).forEach((value, c) => {
                assert.ok(value >= bound(Math.min, c) - 1e-9 && value <= bound(Math.max, c) + 1e-9);
            });
});

test("faces of the cube look along their axes: sky above, ground below, both at the sides", () => {
    const cube = skyLight(PALETTES.dark),
        faces = cube.image as { mipmaps: { data: Uint16Array; width: number }[] }[],
        colour = (face: number, x: number, y: number) => {
            const { data, width } = faces[face].mipmaps[0],
                at = 4 * (Math.floor(y * width) * width + Math.floor(x * width));
            return [0, 1, 2].map((c) => THREE.DataUtils.fromHalfFloat(data[at + c]));
        },
        mirror = reflected(PALETTES.dark, 0);
    assert.deepEqual(
        faces[0].mipmaps.map(({ width }) => width),
        [128, 64, 32, 16, 8],
    );
    near(colour(4, 0.5, 0.5), mirror(1), 2e-3, "+z");
    near(colour(5, 0.5, 0.5), mirror(-1), 2e-3, "-z");
    // Halfway to the edge that faces +z, at tan = 0.5. In the order +x, -x, +y, -y, as OpenGL lays faces.
    const up = Math.sin(Math.atan(0.5));
    for (const [face, x, y] of [
        [0, 0.25, 0.5],
        [1, 0.75, 0.5],
        [2, 0.5, 0.75],
        [3, 0.5, 0.25],
    ]) {
        near(colour(face, x, y), mirror(up), 2e-2, `face ${face}, up`);
        near(colour(face, 1 - x, 1 - y), mirror(-up), 2e-2, `face ${face}, down`);
    }
});
