// The page in a browser, with a run behind it: the picture, time, choosing robots and ordering them about by hand.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, time, until } from "./bench";
import { drag, resting, seen, visiblePoint } from "./sight";

const bench = new Bench();
const paused = (page: Page) => page.getByLabel("Play", { exact: true }).isVisible();
bench.test("the city appears: all its robots are listed, and the picture is a picture", async (page) => {
    const facts = await page.evaluate(() => {
        const { stage, state } = window.roboss;
        return { triangles: stage.renderer.info.render.triangles, robots: state.world.value?.fleet.count };
    });
    assert.ok(facts.triangles > 5000, `${facts.triangles} triangles`);
    assert.equal(await page.locator(".panel.left .count").first().textContent(), String(facts.robots));
    const colours = await page.evaluate(() => {
        const { stage } = window.roboss;
        stage.draw();
        const small = document.createElement("canvas"),
            draw = small.getContext("2d");
        small.width = small.height = 64;
        draw?.drawImage(stage.canvas, 0, 0, 64, 64);
        const data = draw?.getImageData(0, 0, 64, 64).data ?? new Uint8ClampedArray();
        return new Set(
            Array.from(
                { length: 4096 },
                (_, k) => `${data[4 * k] >> 4} ${data[4 * k + 1] >> 4} ${data[4 * k + 2] >> 4}`,
            ),
        ).size;
    });
    assert.ok(colours > 20, `${colours} colours`);
});

bench.test("time runs, is paused, steps by what is asked, and goes on", async (page) => {
    const began = await time(page);
    await until("time runs", async () => (await time(page)) > began + 0.5);
    await page.getByLabel("Pause", { exact: true }).click();
    await until("paused", () => paused(page));
    await page.waitForTimeout(1200);
    const stopped = await time(page);
    await page.waitForTimeout(1200);
    assert.equal(await time(page), stopped);
    await page.getByLabel("Ticks of a step").selectOption("100");
    await page.getByRole("button", { name: "Step", exact: true }).click();
    await until("a hundred ticks of 2 ms later", async () => Math.abs((await time(page)) - stopped - 0.2) < 1e-6);
    await page.getByLabel("Play", { exact: true }).click();
    await until("time runs again", async () => (await time(page)) > stopped + 0.5);
});

bench.test("the speed asked for is the speed that comes", async (page) => {
    const rtf = async () => parseFloat((await page.getByLabel("Real-time factor").textContent()) ?? "");
    await page.getByLabel("Speed", { exact: true }).selectOption("0.25");
    await until("a quarter", async () => Math.abs((await rtf()) - 0.25) < 0.08);
    await page.getByLabel("Speed", { exact: true }).selectOption("1");
    await until("one", async () => Math.abs((await rtf()) - 1) < 0.25);
});

bench.test("a robot is found by name and looked at, and a click in the picture selects it", async (page) => {
    await choose(page, "car_7");
    await page.getByLabel("Look at the selected robot").click();
    await until("its report", async () => page.locator(".reading").first().isVisible());
    await page.getByLabel("Pause", { exact: true }).click();
    await until("paused", () => paused(page));
    await page.getByLabel("Look at the selected robot").click();
    const at = await visiblePoint(page, 7, await resting(page, 7));
    assert.ok(at !== null, "car_7 is seen");
    await page.keyboard.press("Escape");
    await until("nothing selected", async () => (await page.locator(".row[aria-selected=true]").count()) === 0);
    await page.mouse.click(at.left, at.top);
    await until(
        "car_7 again",
        async () => (await page.locator(".robot-head h3", { hasText: /^car_7$/ }).count()) === 1,
    );
    await page.getByLabel("Play", { exact: true }).click();
    await until("runs", async () => !(await paused(page)));
});

bench.test("a robot is dragged over the ground, and is where it was dropped", async (page) => {
    await choose(page, "car_3");
    // Whoever drives it lets go.
    await page.getByLabel("Motor mode of front_left").selectOption("passive");
    const from = await drag(page, 3, 120, 40);
    await until("it stands elsewhere", async () => {
        const to = await seen(page, 3);
        return (
            Math.hypot(to.x - from.x, to.y - from.y) > 0.3 &&
            Math.hypot(to.left - from.left - 120, to.top - from.top - 40) < 45
        );
    });
});

bench.test("a robot is pushed along the arrow that is drawn", async (page) => {
    await choose(page, "car_8");
    await page.getByRole("button", { name: "Follow", exact: true }).last().click();
    await page.waitForTimeout(1500);
    await page.getByRole("button", { name: "Orbit" }).click();
    await page.getByLabel(/^Motor mode of front_left/).selectOption("passive");
    for (const wheel of ["front_right", "rear_left", "rear_right"])
        await page.getByLabel(`Motor mode of ${wheel}`).selectOption("passive");
    await page.getByLabel("Push a robot").click();
    // On a busy machine the car may have rolled on before the mouse gets there: then once more.
    let from = await seen(page, 8);
    const pulls = async () => /\d N$/.test((await page.locator(".labels").textContent()) ?? "");
    await until("the arrow says how hard", async () => {
        from = await seen(page, 8);
        await page.mouse.move(from.left, from.top);
        await page.mouse.down();
        await page.mouse.move(from.left + 250, from.top, { steps: 8 });
        for (const end = Date.now() + 3_000; Date.now() < end; await page.waitForTimeout(100))
            if (await pulls()) return true;
        await page.mouse.up();
        return false;
    });
    await until("it gives way to the right", async () => (await seen(page, 8)).left > from.left + 12);
    await page.mouse.up();
    await page.getByLabel("Select", { exact: true }).click();
});

bench.test("a joint's slider orders its motor, and the joint obeys", async (page) => {
    await choose(page, "car_11");
    const slider = page.getByLabel("Target of front_left"),
        modes = page.getByLabel("Motor mode of front_left");
    await modes.selectOption("velocity");
    await slider.fill("8");
    const velocity = page
        .locator(".joint", { has: page.getByText("front_left", { exact: true }) })
        .locator(".reading", { hasText: "velocity" })
        .locator(".value");
    await until("8 rad/s", async () => Math.abs(Number(await velocity.textContent()) - 8) < 0.5);
    assert.match((await page.locator(".joint .motor").first().textContent()) ?? "", /velocity → 8\.00 rad\/s/);
});

bench.test("the velocity pad drives a robot while a key is held, and stops it after", async (page) => {
    await choose(page, "car_12");
    const from = await seen(page, 12),
        pad = page.getByLabel(/^Velocity pad/);
    await pad.focus();
    await page.keyboard.down("ArrowUp");
    await until("it drives", async () => {
        const to = await seen(page, 12);
        return Math.hypot(to.x - from.x, to.y - from.y) > 0.3;
    });
    await page.keyboard.up("ArrowUp");
    const speed = page.locator(".reading", { hasText: "speed" }).first().locator(".value");
    await until("it stands", async () => Number(await speed.textContent()) < 0.1);
});

bench.test("the track of a car is what its GPS and its odometer say", async (page) => {
    await page.getByRole("button", { name: "Follow", exact: true }).last().click();
    await page.evaluate(() => window.roboss.state.toggle("tracks", true));
    const pad = page.getByLabel(/^Velocity pad/),
        labels = page.locator(".tag.way");
    await pad.focus();
    await page.keyboard.down("ArrowUp");
    await until("both have a line", async () => (await labels.count()) === 2);
    await page.waitForTimeout(2000);
    await page.keyboard.up("ArrowUp");
    assert.deepEqual((await labels.allTextContents()).sort(), ["gps", "odometer"]);
    await until("the GPS line ends at the car", async () => {
        const [car, box] = [await seen(page, 12), await page.locator(".tag.way.gps").boundingBox()];
        return box !== null && Math.hypot(box.x + box.width / 2 - car.left, box.y - car.top) < 70;
    });
    await choose(page, "car_11");
    await until("another car's lines", async () => (await labels.count()) !== 1);
    await page.evaluate(() => window.roboss.state.toggle("tracks", false));
    await until("no lines", async () => (await labels.count()) === 0);
});

bench.endsWithCleanConsole();
