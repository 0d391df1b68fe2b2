// What a newcomer sees at first: nothing over the picture covers anything else, names fit, rays leave the world in sight.
// With the mock gateway, at several sizes of the window.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, fewPixels, openPage, PROGRAM, until } from "./bench";
import { apart, type Box, boxes, within } from "./boxes";

const skip = PROGRAM === "" ? false : "the mock gateway shows it, too";
const bench = new Bench({ cars: 24 }, skip);
const SIZES = [
    { width: 1000, height: 700 },
    { width: 1280, height: 800 },
    { width: 1600, height: 900 },
    { width: 400, height: 800 },
];
const control = (what: "pause" | "resume") => bench.page.evaluate((word) => window.roboss.run.control(word), what);
const drawn = (page: Page) =>
    page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

const OVER = ".banner, .question, .legend, .gizmo-bar, .adding-hint, .view-buttons, .view-toggle";

bench.test("nothing over the picture covers anything else, at four sizes of the window", async (page) => {
    await page.evaluate(() => {
        const { state } = window.roboss;
        state.colourBy.set("simulator");
        state.tool.set("place");
        state.adding.set({ words: "box", put: () => undefined });
        state.over.set({ reason: "a request ended it", failed: false });
    });
    for (const size of SIZES) {
        await page.setViewportSize(size);
        // The next status takes the banner away.
        await page.evaluate(() => window.roboss.state.over.set({ reason: "a request ended it", failed: false }));
        const all = await boxes(page, OVER);
        assert.ok(all.length >= 4, `${size.width}: ${all.map(({ what }) => what).join()}`);
        apart(all);
        within(all, (await boxes(page, ".view"))[0]);
    }
    await page.evaluate(() => {
        const { state } = window.roboss;
        state.colourBy.set("model");
        state.tool.set("select");
        state.adding.set(null);
    });
    await page.setViewportSize({ width: 1100, height: 640 });
});

bench.test("the first steps stand beside the robots: below the side panel, on a phone where no robot is", async () => {
    await control("pause"); // a run that stands is drawn seldom
    await fewPixels(bench.page);
    for (const size of [SIZES[0], SIZES[3]]) {
        const { page, errors } = await openPage(bench.browser, bench.run, "?hints", { size });
        await fewPixels(page);
        await drawn(page);
        const [card] = await boxes(page, ".hints"),
            [picture] = await boxes(page, ".view canvas");
        if (size.width > 900) apart([card, picture]);
        const robots = await page.evaluate(() => {
            const { stage, state } = window.roboss,
                box = stage.canvas.getBoundingClientRect(),
                base = state.world.value?.history.drawn.base ?? new Float32Array();
            return Array.from({ length: base.length / 7 }, (_, r) => {
                const at = stage.camera.position.clone().set(base[r * 7], base[r * 7 + 1], base[r * 7 + 2]);
                at.project(stage.camera);
                return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
            });
        });
        assert.ok(robots.length >= 24);
        for (const [x, y] of robots)
            assert.ok(x < card.left || x > card.right || y < card.top || y > card.bottom, "a robot is below the card");
        await page.getByRole("button", { name: "Got it" }).click();
        assert.equal(await page.locator(".hints").count(), 0);
        assert.deepEqual(errors, []);
        await page.context().close();
    }
    await bench.page.setViewportSize({ width: 1101, height: 640 }); // all pixels again
    await control("resume");
});

bench.test("names neither overlap nor are cut, and many are shown", async (page) => {
    // A car that drives on would be out of sight before a slow camera arrives.
    await page.evaluate(async () => {
        window.roboss.state.colourBy.set("speed");
        window.roboss.state.toggle("names", true);
        await window.roboss.run.control("pause");
    });
    for (const selected of [null, 3]) {
        await page.evaluate((robot) => {
            window.roboss.state.selected.set(robot);
            if (robot === null) window.roboss.director.home();
            else window.roboss.director.focus(robot);
        }, selected);
        await until("the camera arrives", () => page.evaluate(() => window.roboss.views.arrived));
        let tags: Box[] = [];
        await until("names", async () => (tags = await boxes(page, ".tag")).length >= (selected === null ? 5 : 1));
        apart([...tags, ...(await boxes(page, OVER))]);
        within(tags, (await boxes(page, ".view canvas"))[0]);
    }
    await page.evaluate(async () => {
        const { state, run } = window.roboss;
        state.selected.set(null);
        state.colourBy.set("model");
        state.toggle("names", false);
        await run.control("resume");
    });
});

bench.test("long names in the list are told apart: their ends are seen", async (page) => {
    await page.setViewportSize(SIZES[0]);
    const [rows, cut] = await page.evaluate(() => {
        const { state } = window.roboss,
            world = state.world.value;
        if (world === null) return [[], 0];
        world.fleet.scene.robots.forEach((robot, k) => (robot.name = `autonomous_mobile_robot_north_side_${k}`));
        state.world.set(world);
        const shown = [...document.querySelectorAll<HTMLElement>(".row.robot")].map((row) => {
            const tail = row.querySelector(".name-tail")?.getBoundingClientRect(),
                list = row.parentElement?.getBoundingClientRect();
            return tail !== undefined && list !== undefined && tail.width > 10 && tail.right <= list.right;
        });
        return [shown, shown.filter((whole) => !whole).length];
    });
    assert.ok(rows.length > 5);
    assert.equal(cut, 0);
    await page.setViewportSize({ width: 1100, height: 640 });
    await page.reload();
    await page.waitForSelector("body[data-ready=true]");
});

bench.test("names of Simulators are told apart in the table of the cluster: their ends are seen", async (page) => {
    await page.getByRole("tab", { name: "Cluster" }).click();
    for (const size of SIZES.slice(0, 3)) {
        await page.setViewportSize(size);
        await until("three names", async () => (await page.locator(".member-words .name-tail").count()) === 3);
        const [tails, cells] = [await boxes(page, ".member-words .name-tail"), await boxes(page, ".members tbody th")];
        tails.forEach((tail, k) => within([tail], cells[k]));
    }
    await page.getByRole("tab", { name: "Robot" }).click();
    await page.setViewportSize({ width: 1100, height: 640 });
});

bench.test("titles in the list of commands are whole on a phone", async (page) => {
    await page.setViewportSize(SIZES[3]);
    await page.keyboard.press("Control+k");
    const cut = await page.evaluate(() =>
        [...document.querySelectorAll<HTMLElement>(".palette-title")]
            .filter((title) => title.scrollWidth > title.clientWidth + 1)
            .map((title) => title.textContent),
    );
    assert.deepEqual(cut, []);
    assert.ok((await page.locator(".palette-title").count()) > 20);
    await page.keyboard.press("Escape");
    await page.setViewportSize({ width: 1100, height: 640 });
});

bench.test("a lidar of 720 beams is a fan through which the world is seen", async (page) => {
    const share = await page.evaluate(async () => {
        const { stage, state, director, run } = window.roboss,
            world = state.world.value,
            frames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        if (world === null) return 1;
        await run.control("pause");
        Object.assign(world.fleet.type(3).sensors[0], { samples: 720, min_angle: -Math.PI, max_angle: Math.PI });
        state.selected.set(3);
        director.followRobot(3);
        window.roboss.views.rig.goal.elevation = 1.5;
        while (!window.roboss.views.arrived) await frames();
        let reports = 0;
        state.report.follow((report) => {
            if (report?.robot !== 3) return;
            report.sensors[0] = { ranges: Array.from({ length: 720 }, () => 1) };
            ++reports;
        });
        const pixels = async (rays: boolean) => {
            state.toggle("rays", rays);
            for (const before = reports; reports < before + 2;) await frames();
            stage.draw();
            const copy = document.createElement("canvas"),
                draw = copy.getContext("2d");
            [copy.width, copy.height] = [stage.canvas.width, stage.canvas.height];
            draw?.drawImage(stage.canvas, 0, 0);
            return draw?.getImageData(0, 0, copy.width, copy.height).data ?? new Uint8ClampedArray();
        };
        const [plain, rayed] = [await pixels(false), await pixels(true)];
        // The inner third of the fan, where its rays lie closest together.
        const wide = stage.canvas.width,
            change = (k: number) => Math.max(...[0, 1, 2].map((c) => Math.abs(plain[4 * k + c] - rayed[4 * k + c]))),
            all = Array.from({ length: plain.length / 4 }, (_, k) => k),
            touched = all.filter((k) => change(k) > 4),
            mean = (list: number[]) => list.reduce((sum, value) => sum + value, 0) / Math.max(1, list.length),
            middle = [mean(touched.map((k) => k % wide)), mean(touched.map((k) => Math.floor(k / wide)))],
            away = (k: number) => Math.hypot((k % wide) - middle[0], Math.floor(k / wide) - middle[1]),
            radius = touched.reduce((most, one) => Math.max(most, away(one)), 0),
            inner = all.filter((k) => away(k) < radius / 3);
        const covered = inner.filter((k) => change(k) > 70).length;
        state.toggle("rays", false);
        state.selected.set(null);
        await run.control("resume");
        return touched.length > 500 ? covered / inner.length : 1;
    });
    assert.ok(share < 0.35, `${(100 * share).toFixed(0)} % of the inner fan is opaque`);
});

bench.endsWithCleanConsole();
