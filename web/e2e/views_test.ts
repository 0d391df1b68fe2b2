// Where the camera is: the whole world at three sizes of the window, views with names, following a robot that drives, and
// several views at once.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, openPage, paused, until, WAIT_MS } from "./bench";
import { seen } from "./sight";

const bench = new Bench();
const SIZES = [
    { width: 390, height: 844 },
    { width: 1024, height: 768 },
    { width: 1440, height: 900 },
];

const arrived = (page: Page) =>
    page.evaluate(() =>
        window.roboss.views.shown.every(({ rig: { goal, now } }) => {
            const off = Math.hypot(...goal.target.map((value, k) => value - now.target[k])),
                turn = Math.hypot(goal.azimuth - now.azimuth, goal.elevation - now.elevation);
            return off < 0.003 * goal.distance && turn < 0.003 && Math.abs(goal.distance / now.distance - 1) < 0.003;
        }),
    );

/** How far scenery (no planes) reaches over the picture's edges, and how much of the picture it takes; -1 to 1. */
function extent(page: Page): Promise<{ left: number; right: number; bottom: number; top: number }> {
    return page.evaluate(() => {
        const { stage } = window.roboss,
            edges = { left: 9, right: -9, bottom: 9, top: -9 };
        for (const mesh of (stage.statics?.solids ?? []).filter(({ name }) => name !== "planes")) {
            const position = mesh.geometry.getAttribute("position"),
                point = stage.camera.position.clone();
            for (let k = 0; k < position.count; ++k) {
                point.set(position.getX(k), position.getY(k), position.getZ(k)).project(stage.camera);
                edges.left = Math.min(edges.left, point.x);
                edges.right = Math.max(edges.right, point.x);
                edges.bottom = Math.min(edges.bottom, point.y);
                edges.top = Math.max(edges.top, point.y);
            }
        }
        return edges;
    });
}

async function sees(page: Page, told: string): Promise<void> {
    await until("the camera arrives", () => arrived(page), WAIT_MS);
    const { left, right, bottom, top } = await extent(page),
        words = `${told}: ${[left, right, bottom, top].map((x) => x.toFixed(3)).join(" ")}`;
    assert.ok(left > -1 && right < 1 && bottom > -1 && top < 1, `outside of the picture, ${words}`);
    assert.ok(Math.max(right - left, top - bottom) > 1.3, `small in the picture, ${words}`);
}

/** The camera is at the selected robot. */
function atRobot(page: Page): Promise<void> {
    return until(
        "the camera is at the car",
        () =>
            page.evaluate(() => {
                const {
                        views: { rig },
                        state,
                    } = window.roboss,
                    at = (state.selected.value ?? 0) * 7,
                    base = state.world.value?.history.drawn.base;
                return (
                    base !== undefined &&
                    Math.hypot(rig.now.target[0] - base[at], rig.now.target[1] - base[at + 1]) < 0.1
                );
            }),
        WAIT_MS,
    );
}

for (const size of SIZES)
    bench.test(
        `the whole world is in a window of ${size.width} x ${size.height}, at first sight and from all sides`,
        async () => {
            const { page, errors } = await openPage(bench.browser, bench.run);
            await page.setViewportSize(size);
            await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
            for (const [key, name] of [
                ["h", "whole world"],
                ["5", "top"],
                ["6", "front"],
                ["7", "side"],
                ["8", "isometric"],
                ["0", "isometric without perspective"],
                ["8", "isometric without perspective"],
            ]) {
                await page.keyboard.press(key);
                if (key !== "0") await sees(page, name);
            }
            assert.ok(await page.evaluate(() => window.roboss.views.rig.orthographic));
            assert.deepEqual(errors, []);
            await page.context().close();
        },
    );

bench.test("a followed car stays in the middle of the picture while it drives", async (page) => {
    await choose(page, "car_3");
    await page.locator(".view canvas").focus(); // a key is typed where the search has the focus
    await page.keyboard.press("3");
    await atRobot(page);
    await until("the camera arrives", () => arrived(page), WAIT_MS);
    const box = await page.evaluate(() => {
        const { left, top, width, height } = window.roboss.stage.canvas.getBoundingClientRect();
        return { left, top, width, height };
    });
    const robot = await page.evaluate(() => window.roboss.state.selected.value ?? 0),
        begin = await seen(page, robot);
    let moved = 0;
    await until("it drives on", async () => {
        const at = await seen(page, robot);
        moved = Math.hypot(at.x - begin.x, at.y - begin.y);
        const across = Math.abs(at.left - box.left - box.width / 2) / box.width,
            down = Math.abs(at.top - box.top - box.height / 2) / box.height;
        assert.ok(across < 0.1 && down < 0.1, `off the middle by ${across.toFixed(3)}, ${down.toFixed(3)}`);
        return moved > 2;
    });
});

bench.test("a double click follows the robot", async (page) => {
    await page.keyboard.press("1");
    await page.keyboard.press("Escape");
    // A car that stands is where it was seen.
    await page.evaluate(() => window.roboss.run.control("pause"));
    await until("it stands", () => paused(page));
    await page.evaluate(() => window.roboss.director.followRobot(4));
    await atRobot(page);
    await until("the camera arrives", () => arrived(page), WAIT_MS);
    await page.keyboard.press("1");
    await page.evaluate(() => window.roboss.state.selected.set(null));
    await until(
        "it is met by the double click",
        async () => {
            const at = await seen(page, 4);
            await page.mouse.dblclick(at.left, at.top);
            return page.evaluate(
                () => window.roboss.state.cameraMode.value === "follow" && window.roboss.state.selected.value === 4,
            );
        },
        WAIT_MS,
    );
    await page.evaluate(() => window.roboss.run.control("resume"));
});

bench.test("four views have cameras of their own, a click makes one active, and the address keeps them", async () => {
    const { page, errors } = await openPage(bench.browser, bench.run);
    await page.getByRole("group", { name: "Views", exact: true }).getByRole("button", { name: "4" }).click();
    await until("four frames", async () => (await page.locator(".view-frame").count()) === 4);
    const elevations = await page.evaluate(() => window.roboss.views.cameras.map(({ rig }) => rig.goal.elevation));
    assert.ok(elevations[1] > 1.5, "the second view looks down");
    assert.ok(Math.abs(elevations[2]) < 0.1 && Math.abs(elevations[3]) < 0.1, "two look from the side");
    const box = await page.evaluate(() => {
        const { left, top, width, height } = window.roboss.stage.canvas.getBoundingClientRect();
        return { left, top, width, height };
    });
    await page.mouse.click(box.left + 0.75 * box.width, box.top + 0.75 * box.height);
    await until("the last one is active", () => page.evaluate(() => window.roboss.views.active.value === 3));
    await page.keyboard.press("5");
    await page.evaluate(() => window.roboss.director.followRobot(2));
    await page.mouse.click(box.left + 0.25 * box.width, box.top + 0.9 * box.height);
    await until("the third is active", () => page.evaluate(() => window.roboss.views.active.value === 2));
    assert.equal(await page.evaluate(() => window.roboss.state.cameraMode.value), "orbit");
    await page.keyboard.press("6");
    const before = await page.evaluate(() => window.roboss.views.cameras.map(({ mode, robot }) => `${mode} ${robot}`));
    assert.equal(before[3], "follow 2");
    await until("the address has them", async () => {
        const words = new URLSearchParams(new URL(page.url()).hash.slice(1));
        return words.get("views") === "4" && (words.get("view4") ?? "").includes(";follow;");
    });
    await until("the cameras arrive", () => arrived(page), WAIT_MS);
    await until("the address keeps up", async () => /view3=[^&]*,1\.1,/.test(new URL(page.url()).hash));
    await page.reload();
    await page.waitForSelector("body[data-ready=true]");
    assert.equal(await page.evaluate(() => window.roboss.views.count.value), 4);
    assert.equal(await page.evaluate(() => window.roboss.views.cameras[3].mode), "follow");
    assert.equal(await page.evaluate(() => window.roboss.views.cameras[3].robot), 2);
    await page.getByRole("group", { name: "Views", exact: true }).getByRole("button", { name: "1" }).click();
    await until("one view", async () => (await page.locator(".view-frame").count()) === 0);
    assert.deepEqual(errors, []);
    await page.context().close();
});

bench.endsWithCleanConsole();
