// Pictures over shapes, in a world that has them: a plane, a box, meshes that bring their own (OBJ, DAE), the right way
// up. What is tested are colours of pixels.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, PROGRAM } from "./bench";

const skip = PROGRAM === "" ? "the mock's city has no pictures" : false;
const bench = new Bench({ world: "yard.sdf", query: "?hide=panels&quality=high&theme=light" }, skip);

type Place = [number, number, number];
interface Pixel {
    r: number;
    g: number;
    b: number;
    /** Right and up, 0 to 1 from corner to corner. */
    right: number;
    up: number;
}

/** The pixels between two points of the world, seen from a point that looks at their middle. */
function pixels(page: Page, from: Place, low: Place, high: Place): Promise<Pixel[]> {
    return page.evaluate(
        ([eye, a, b]) => {
            const { stage } = window.roboss,
                { camera, canvas } = stage,
                middle = a.map((value, k) => (value + b[k]) / 2);
            camera.position.set(eye[0], eye[1], eye[2]);
            camera.up.set(0, 0, 1);
            camera.lookAt(middle[0], middle[1], middle[2]);
            camera.updateMatrixWorld();
            stage.draw();
            const at = (place: number[]) => {
                const seen = camera.position.clone().set(place[0], place[1], place[2]).project(camera);
                return [((seen.x + 1) / 2) * canvas.width, ((1 - seen.y) / 2) * canvas.height];
            };
            const [p, q] = [at(a), at(b)],
                left = Math.ceil(Math.min(p[0], q[0])),
                top = Math.ceil(Math.min(p[1], q[1])),
                width = Math.floor(Math.abs(p[0] - q[0])),
                height = Math.floor(Math.abs(p[1] - q[1]));
            const copy = document.createElement("canvas"),
                draw = copy.getContext("2d") as CanvasRenderingContext2D;
            copy.width = width;
            copy.height = height;
            draw.drawImage(canvas, -left, -top);
            const data = draw.getImageData(0, 0, width, height).data;
            return Array.from({ length: width * height }, (_, k) => ({
                r: data[4 * k],
                g: data[4 * k + 1],
                b: data[4 * k + 2],
                right: (k % width) / width,
                up: 1 - Math.floor(k / width) / height,
            }));
        },
        [from, low, high] as const,
    );
}

function mean(list: Pixel[], value: (pixel: Pixel) => number): number {
    return list.reduce((sum, pixel) => sum + value(pixel), 0) / list.length;
}

function spread(list: Pixel[], value: (pixel: Pixel) => number): number {
    const middle = mean(list, value);
    return Math.sqrt(mean(list, (pixel) => (value(pixel) - middle) ** 2));
}

bench.test(
    "a sign from a DAE file shows its picture upright: a red bar above a blue arrow to the right",
    async (page) => {
        // The board is 1.2 x 0.6 m at (1.6, 2.2, 1.1) and looks along -y, turned by -0.2 rad.
        const [c, s] = [Math.cos(-0.2), Math.sin(-0.2)],
            board = (x: number, z: number): Place => [1.6 + c * x, 2.2 + s * x, 1.1 + z];
        const shown = await pixels(page, [1.6 + 3 * s, 2.2 - 3 * c, 1.1], board(-0.58, -0.28), board(0.58, 0.28));
        const red = shown.filter(({ r, g, b }) => r > 1.6 * g && r > 1.6 * b),
            blue = shown.filter(({ r, g, b }) => b > 1.5 * r && b > 1.05 * g && b > 80);
        assert.ok(red.length > 0.05 * shown.length, `${red.length} red of ${shown.length}`);
        assert.ok(blue.length > 0.1 * shown.length, `${blue.length} blue of ${shown.length}`);
        assert.ok(mean(red, (p) => p.up) > 0.85, "the bar is on top");
        const high = (right: number) =>
                spread(
                    blue.filter((p) => Math.abs(p.right - right) < 0.03),
                    (p) => p.up,
                ),
            [shaft, head] = [high(0.4), high(0.64)];
        assert.ok(head > 1.4 * shaft, `the arrow's head is at the right: ${head}, its shaft ${shaft}`);
    },
);

bench.test("a barrel from an OBJ file has grey hoops and brown staves", async (page) => {
    const shown = await pixels(page, [0.3, -3.5, 0.35], [0.2, -0.73, 0.05], [0.4, -0.73, 0.55]);
    const hoops = shown.filter(({ r, b }) => b > 0.93 * r),
        staves = shown.filter(({ r, b }) => r > 1.3 * b);
    assert.ok(hoops.length > 0.1 * shown.length, `${hoops.length} grey of ${shown.length}`);
    assert.ok(staves.length > 0.3 * shown.length, `${staves.length} brown of ${shown.length}`);
});

bench.test("the crates are of planks, the ground is paved", async (page) => {
    const crate = await pixels(page, [-1, -4, 0.3], [-1.2, -0.15, 0.05], [-0.8, -0.15, 0.45]),
        ground = await pixels(page, [2, -2.5, 4], [1, -3.2, 0], [3, -1.8, 0]);
    for (const [name, shown] of Object.entries({ crate, ground })) {
        const dark = spread(shown, (p) => p.r + p.g + p.b);
        assert.ok(dark > 25, `${name}: ${dark}`);
    }
    assert.ok(mean(crate, (p) => p.r) > 1.3 * mean(crate, (p) => p.b), "wood is brown");
});

bench.endsWithCleanConsole();
