// The hand, with the program: the first gesture is obeyed while it lasts, a push is the force that it says, a spring
// lifts and holds; and who has control. In the world beside this file.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import type { OrderAction } from "../src/wire/messages";
import { Bench, choose, openPage, paused, PROGRAM, time, until, WAIT_MS } from "./bench";
import { resting, visiblePoint } from "./sight";

declare global {
    interface Window {
        given: { robot: number; action: OrderAction }[];
    }
}

const skip = PROGRAM === "" ? "the mock has no physics" : false;
const bench = new Bench({ world: "../web/e2e/gestures.sdf" }, skip);

const numberOf = (page: Page, name: string) =>
    page.evaluate((robot) => window.roboss.state.world.value?.fleet.find(robot) ?? -1, name);

/** Time and velocity of the selected robot, as the run measures them. */
function motion(page: Page): Promise<{ time: number; speed: number; x: number; y: number; z: number }> {
    return page.evaluate(() => {
        const report = window.roboss.state.report.value,
            [x, y, z] = report?.pose ?? [0, 0, 0];
        return { time: report?.time ?? 0, speed: Math.hypot(...(report?.linear ?? [0])), x, y, z };
    });
}

/** Presses the mouse on the robot, in the middle of the picture. */
async function grab(page: Page, name: string, tool: string): Promise<{ left: number; top: number }> {
    const robot = await numberOf(page, name);
    await choose(page, name);
    await until("its report", () => page.evaluate((r) => window.roboss.state.report.value?.robot === r, robot));
    await page.getByLabel("Look at the selected robot").click();
    const at = await visiblePoint(page, robot, await resting(page, robot));
    assert.ok(at !== null, `${name} is seen`);
    await page.getByLabel(tool).click();
    await page.mouse.move(at.left, at.top);
    await page.mouse.down();
    return at;
}

bench.test("a push is obeyed from its first moment, and is the force that it says", async (page) => {
    await page.evaluate(() => {
        const { run } = window.roboss,
            order = run.order.bind(run);
        window.given = [];
        run.order = (robot, action) => {
            window.given.push({ robot, action });
            return order(robot, action);
        };
    });
    const at = await grab(page, "floater", "Push a robot");
    await page.mouse.move(at.left + 30, at.top, { steps: 4 });
    await until("it moves while it is held", async () => (await motion(page)).speed > 0.1);
    const force = await page.evaluate(() => {
        const action = window.given.at(-1)?.action;
        return action?.action === "wrench" ? Math.hypot(...action.force) : NaN;
    });
    assert.ok(force > 0.5 && force < 20, `${force} N`);
    // A machine that is too busy to renew the order leaves gaps; then once more. It is never more than the force.
    let ratio = 0;
    for (let left = 4; left > 0 && ratio < 0.995; --left) {
        const from = await motion(page);
        await until("3 s", async () => (await motion(page)).time > from.time + 3, WAIT_MS);
        const to = await motion(page);
        ratio = (to.speed - from.speed) / (to.time - from.time) / force;
        assert.ok(ratio < 1.005, `${ratio} of ${force} N`);
    }
    assert.ok(ratio >= 0.995, `${ratio} of ${force} N on 1 kg`);
    await page.mouse.up();
    await page.waitForTimeout(300);
    const after = await motion(page);
    await until("time goes on", async () => (await motion(page)).time > after.time + 0.5);
    assert.ok(Math.abs((await motion(page)).speed - after.speed) < 1e-6, "nothing pushes after the release");
});

bench.test("a robot is lifted, is held while the hand rests, and falls when it is let go", async (page) => {
    const at = await grab(page, "crate", "Move a robot");
    await page.keyboard.down("Alt");
    await page.mouse.move(at.left, at.top - 150, { steps: 10 });
    await page.keyboard.up("Alt");
    await until("it hangs", async () => (await motion(page)).z > 0.5);
    await until("it comes to rest", async () => (await motion(page)).speed < 0.02);
    const held = await motion(page);
    await until("2 s", async () => (await motion(page)).time > held.time + 2);
    assert.ok(Math.abs((await motion(page)).z - held.z) < 0.02, "it stays where it is held");
    await page.mouse.up();
    await until("it lies on the ground", async () => (await motion(page)).z < 0.45);
});

/** How far the point that is held is from where it is pulled, and how far beyond that it is, seen from `from`; m. */
function offTarget(page: Page, from: number[]): Promise<{ off: number; beyond: number; speed: number }> {
    return page.evaluate((start) => {
        const report = window.roboss.state.report.value,
            action = window.given.at(-1)?.action;
        if (report === null || action?.action !== "pull") return { off: NaN, beyond: NaN, speed: NaN };
        const [x, y, z, w, i, j, k] = report.pose,
            [px, py, pz] = action.point,
            t = [2 * (j * pz - k * py), 2 * (k * px - i * pz), 2 * (i * py - j * px)];
        const held = [
            x + px + w * t[0] + j * t[2] - k * t[1],
            y + py + w * t[1] + k * t[0] - i * t[2],
            z + pz + w * t[2] + i * t[1] - j * t[0],
        ];
        const off = held.map((value, n) => value - action.target[n]),
            way = action.target.map((value, n) => value - start[n]),
            beyond = (off[0] * way[0] + off[1] * way[1]) / Math.hypot(way[0], way[1]);
        return { off: Math.hypot(...off), beyond, speed: Math.hypot(...report.linear) };
    }, from);
}

bench.test("the point that is held follows the hand over the ground and does not overshoot", async (page) => {
    await until("it lies still", async () => (await motion(page)).speed < 0.01);
    const at = await grab(page, "crate", "Move a robot"),
        before = await motion(page),
        from = [before.x, before.y, before.z];
    try {
        await page.mouse.move(at.left + 140, at.top, { steps: 8 });
        let beyond = 0;
        await until("it arrives and rests", async () => {
            const now = await offTarget(page, from);
            beyond = Math.max(beyond, now.beyond);
            return now.off < 0.15 && now.speed < 0.02;
        });
        assert.ok((await motion(page)).x !== before.x && beyond < 0.05, `${beyond} m beyond the target`);
    } finally {
        await page.mouse.up();
        await page.getByLabel("Select", { exact: true }).click();
    }
});

bench.test("another page sees who has control, asks for it, and gets it", async (page) => {
    await until("this page has it", () => page.getByText("You have control").isVisible());
    const other = await openPage(bench.browser, bench.run);
    const desk = other.page.getByLabel("Control of the run");
    await until("its words", async () =>
        /page \d+ \(127\.0\.0\.1\) has control/.test((await desk.textContent()) ?? ""),
    );
    await other.page.getByLabel("Pause", { exact: true }).click();
    await until("a refusal", async () => /has control/.test(await other.page.locator(".notice.bad").innerText()));
    await desk.getByRole("button", { name: "Ask for control" }).click();
    await page.getByRole("button", { name: "Hand over" }).click();
    await until("the other page has it", () => other.page.getByText("You have control").isVisible());
    await other.page.getByLabel("Pause", { exact: true }).click();
    await until("paused", () => paused(page));
    await other.page.getByLabel("Play", { exact: true }).click();
    await until("runs", () => page.evaluate(() => window.roboss.state.status.value?.paused === false));
    assert.deepEqual(other.errors, []);
    await other.page.context().close();
    await until("nobody has it", () => page.evaluate(() => window.roboss.state.roles.value?.holder === null));
});

bench.test("saving over a file and ending the run ask first", async (page) => {
    await page.getByRole("tab", { name: "Cluster" }).click();
    const save = async () => {
        await page.getByRole("button", { name: "Save…" }).click();
        await page.getByRole("dialog").getByRole("button", { name: "Save" }).click();
    };
    const said = async (what: RegExp) =>
        (await page.locator(".notice").allTextContents()).some((text) => what.test(text));
    await save();
    await until("it is saved", () => said(/saved .* in .*saved\.roboss/));
    await page.evaluate(() => document.querySelectorAll(".notice").forEach((notice) => notice.remove()));
    await save();
    await page
        .getByRole("dialog", { name: /exists/ })
        .getByRole("button", { name: "Cancel" })
        .click();
    assert.ok(!(await said(/saved/)), "nothing is overwritten without a confirmation");
    await save();
    await page
        .getByRole("dialog", { name: /exists/ })
        .getByRole("button", { name: "Overwrite" })
        .click();
    await until("it is overwritten", () => said(/saved .* in .*saved\.roboss/));
    await page.getByRole("button", { name: "End the run" }).click();
    await page.getByRole("dialog").getByRole("button", { name: "Cancel" }).click();
    const then = await time(page);
    await until("it goes on", async () => (await time(page)) > then + 0.5);
});

bench.endsWithCleanConsole();
