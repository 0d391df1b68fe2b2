// The page in a browser, with a run behind it: plots, timeline, cluster, colours, what one takes away, keys and
// accessibility, and a run that goes and comes back.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import type { Page } from "playwright-core";
import { Bench, choose, openPage, pressInBar, PROGRAM, startRun, time, until, WAIT_MS } from "./bench";

declare global {
    interface Window {
        axe: {
            run(): Promise<{
                violations: { id: string; impact: string; nodes: { html: string; failureSummary: string }[] }[];
            }>;
        };
    }
}

const bench = new Bench();
bench.test("variables are plotted, and the plots go away", async (page) => {
    await choose(page, "car_5");
    await page.getByLabel("Plot speed", { exact: true }).click();
    await page.getByLabel("Plot x", { exact: true }).click();
    await until("two charts", async () => (await page.locator(".chart .uplot").count()) === 2);
    await page.waitForTimeout(800);
    const points = await page.evaluate(() => document.querySelectorAll(".chart").length);
    assert.equal(points, 2);
    await page.getByLabel("Remove all plots").click();
    await until("no dock", async () => !(await page.locator(".dock").isVisible()));
});

bench.test("a refusal is shown in the program's words", async (page) => {
    await page.evaluate(() => window.roboss.run.control("nonsense"));
    await until("the refusal", async () =>
        ((await page.locator(".notice.bad").last().textContent()) ?? "").includes("nonsense"),
    );
});

bench.test("the run continues from an earlier time", async (page) => {
    await until("some seconds to go back over", async () => (await time(page)) > 4, WAIT_MS);
    const slider = page.getByLabel("Timeline: look at an earlier time"),
        now = await time(page);
    await until("a journal", async () => slider.isEnabled());
    const box = await slider.boundingBox();
    assert.ok(box !== null);
    await page.mouse.click(box.x + box.width * 0.4, box.y + box.height / 2);
    await until("it is seen", () => page.evaluate(() => window.roboss.state.shown.value !== null));
    assert.ok((await time(page)) >= now, "the run goes on meanwhile");
    await page.getByRole("button", { name: "Continue from here" }).click();
    await until("an earlier time", async () => (await time(page)) < now * 0.8);
    const after = await time(page);
    await until("and on from there", async () => (await time(page)) > after + 0.3);
});

bench.test(
    "a Simulator is killed: the panel tells of the loss, the others carry on, another is added",
    async (page) => {
        await page.getByRole("tab", { name: "Cluster" }).click();
        const rows = page.locator(".members tbody tr"),
            fact = (name: string) => page.locator(".fact", { hasText: name }).locator(".fact-value").textContent();
        await until("three Simulators", async () => (await fact("Simulators")) === "3");
        await until("messages", async () => /^[1-9][\d.]* k? ?\/s$/.test((await fact("Messages")) ?? ""));
        assert.match((await fact("Traffic")) ?? "", /^[1-9][\d.]* k?M?B\/s$/);
        assert.match((await rows.first().getAttribute("title")) ?? "", /messages\/s .* to the Controller/);
        const losses = Number(await fact("Losses"));
        const dialog = page.getByRole("dialog", { name: /^Kill Simulator/ });
        await rows.nth(1).getByRole("button", { name: /Kill/ }).click();
        await dialog.getByRole("button", { name: "Cancel" }).click();
        assert.equal(Number(await fact("Losses")), losses, "nothing is killed without a confirmation");
        await rows.nth(1).getByRole("button", { name: /Kill/ }).click();
        await dialog.getByRole("button", { name: "Kill" }).click();
        await until(
            "the loss",
            async () => Number(await fact("Losses")) === losses + 1 && (await fact("Simulators")) === "2",
            WAIT_MS,
        );
        const then = await time(page);
        await until("time runs on", async () => (await time(page)) > then + 0.5, WAIT_MS);
        const { held, all } = await page.evaluate(() => {
            const { status, world } = window.roboss.state,
                working = status.value?.members?.filter((member) => member.state === "active") ?? [];
            return {
                held: working.reduce((sum, member) => sum + member.robots, 0),
                all: world.value?.fleet.count,
            };
        });
        assert.equal(held, all);
        await page.getByRole("button", { name: "Add a Simulator" }).click();
        await until("three again", async () => (await fact("Simulators")) === "3", WAIT_MS);
    },
);

bench.test("robots are coloured by Simulator and by island", async (page) => {
    await page.getByRole("tab", { name: "View" }).click();
    const colours = () =>
        page.evaluate(() => {
            const { stage } = window.roboss,
                found = new Set<string>();
            stage.robots?.group.traverse((object) => {
                const data = (object as import("three").InstancedMesh).instanceColor?.array;
                for (let k = 0; data !== undefined && k + 2 < data.length; k += 3)
                    found.add(`${data[k].toFixed(3)} ${data[k + 1].toFixed(3)} ${data[k + 2].toFixed(3)}`);
            });
            return found.size;
        });
    await page.getByRole("radio", { name: /^Island/ }).check();
    await until("many colours", async () => (await colours()) > 24);
    await page.getByRole("radio", { name: /^Simulator/ }).check();
    await until("few colours", async () => (await colours()) <= 8);
    await page.getByRole("radio", { name: /^Model/ }).check();
});

bench.test("a picture is saved, and a link brings back camera and selection", async (page) => {
    const [download] = await Promise.all([page.waitForEvent("download"), pressInBar(page, "Save a picture")]);
    const picture = readFileSync(await download.path());
    assert.equal(picture.subarray(1, 4).toString(), "PNG");
    assert.ok(picture.length > 5000, `${picture.length} bytes`);
    await choose(page, "car_9");
    await pressInBar(page, "Look at the selected robot");
    await page.waitForTimeout(1000);
    await pressInBar(page, "Copy a link to this view");
    const link = page.url(),
        camera = await page.evaluate(() => window.roboss.views.rig.goal.distance);
    const other = await openPage(bench.browser, { ...bench.run, url: link });
    await until("the same robot", async () => (await other.page.locator(".robot-head h3").textContent()) === "car_9");
    const found = await other.page.evaluate(() => window.roboss.views.rig.goal.distance);
    assert.ok(Math.abs(found - camera) < 0.02, `${found} is not ${camera}`);
    assert.deepEqual(other.errors, []);
    await other.page.context().close();
});

/** Plays a video to its end: the frames that were shown, and what was wrong with it. */
async function play(page: Page, video: Buffer): Promise<{ problem: string; frames: number }> {
    return page.evaluate(async (text) => {
        const film = document.createElement("video");
        film.muted = true;
        film.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]));
        let frames = 0;
        const count = () => {
            ++frames;
            film.requestVideoFrameCallback(count);
        };
        film.requestVideoFrameCallback(count);
        const ended = new Promise<string>((resolve) => {
            film.onended = () => resolve("");
            film.onerror = () => resolve(film.error?.message ?? "it cannot be played");
        });
        await film.play();
        return { problem: await ended, frames };
    }, video.toString("base64"));
}

bench.test("a video is recorded and saved", async (page) => {
    await pressInBar(page, "Record a video");
    await page.waitForTimeout(2500);
    const [download] = await Promise.all([page.waitForEvent("download"), pressInBar(page, "Record a video")]);
    const video = readFileSync(await download.path());
    assert.match(download.suggestedFilename(), /\.(webm|mp4)$/);
    const { problem, frames } = await play(page, video);
    assert.equal(problem, "");
    assert.ok(frames > 1, `${frames} frames in ${video.length} bytes`);
});

bench.test("keys do what the card says, and the card opens with ?", async (page) => {
    await page.locator(".view canvas").focus();
    await page.keyboard.press("?");
    assert.ok(await page.getByRole("dialog").isVisible());
    await page.keyboard.press("Escape");
    await page.keyboard.press("m");
    assert.equal(await page.getByLabel("Move a robot").getAttribute("aria-pressed"), "true");
    await page.keyboard.press("v");
});

bench.test("axe finds nothing serious, dark or light, with help or without", async (page) => {
    const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
    await page.evaluate(axe);
    await choose(page, "car_5");
    for (const theme of ["dark", "light"] as const) {
        await page.evaluate((name) => window.roboss.state.theme.set(name), theme);
        for (const tab of ["Robot", "Cluster", "View"]) {
            await page.getByRole("tab", { name: tab }).click();
            await page.waitForTimeout(300);
            const found = await page.evaluate(async () => {
                const results = await window.axe.run();
                return results.violations
                    .filter((one) => one.impact === "serious" || one.impact === "critical")
                    .map((one) => `${one.id}: ${one.nodes[0].html} ${one.nodes[0].failureSummary}`);
            });
            assert.deepEqual(found, [], `${theme}, ${tab}`);
        }
    }
});

bench.test(
    "a run that is gone shows a banner, and one that comes back is found",
    async (page) => {
        const { port } = bench.run;
        await bench.run.stop();
        await until("the banner", async () => page.locator(".banner").isVisible());
        assert.match((await page.locator(".banner").textContent()) ?? "", /gone/);
        bench.run = await startRun({ port });
        await until("it is back", async () => !(await page.locator(".banner").isVisible()), WAIT_MS);
        const then = await time(page);
        await until("and time runs", async () => (await time(page)) > then);
        // That the socket could not be opened meanwhile is the one thing that a browser must say.
        bench.errors = bench.errors.filter((text) => !/WebSocket connection|ERR_CONNECTION_REFUSED/.test(text));
    },
    PROGRAM === "" ? false : "the port of a run is its own choice",
);

bench.test("the palette finds rewind by its beginning, and Escape closes it", async (page) => {
    await page.locator("body").press("Control+k");
    await page.keyboard.type("rew");
    const first = page.locator(".palette-list li").first();
    assert.match((await first.textContent()) ?? "", /^Rewind/);
    assert.equal(await first.getAttribute("aria-selected"), "true");
    assert.equal(await page.locator(".palette-list li", { hasText: "Remove" }).count(), 0);
    await page.keyboard.press("Escape");
    await page.locator("dialog.palette").waitFor({ state: "hidden" });
});

bench.test("Escape lets go of the robot, and the camera follows none", async (page) => {
    await page.evaluate(() => window.roboss.director.followRobot(1));
    await page.locator("body").press("Escape");
    await until("orbit", () => page.evaluate(() => window.roboss.state.cameraMode.value === "orbit"));
});

bench.endsWithCleanConsole();
