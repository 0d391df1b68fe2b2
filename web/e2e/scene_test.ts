// Handling the scene, with the program: hidden and locked things, the gizmo, typed poses, several robots at once, copy,
// remove, undo. In the world beside this file.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, PROGRAM, until } from "./bench";
import { names, near, pause, press, row, selected, stand } from "./scene_steps";
import { resting, visiblePoint } from "./sight";

const skip = PROGRAM === "" ? "the mock changes no world" : false;
const bench = new Bench({ world: "../web/e2e/scene.sdf", port: 8290 }, skip);

bench.test("what is hidden leaves the picture, what is locked is not picked, and a reload keeps both", async (page) => {
    await choose(page, "crate_1");
    await press(page, "f");
    const robot = await page.evaluate(() => window.roboss.state.selected.value ?? -1),
        at = await visiblePoint(page, robot, await resting(page, robot));
    assert.ok(at !== null);
    const there = () => page.evaluate(({ left, top }) => window.roboss.robotAt(left, top), at);
    const click = async (label: string) => {
        await row(page, "crate_1").hover();
        await row(page, "crate_1").getByLabel(label).click();
    };
    assert.equal(await there(), robot);
    await click("Lock crate_1: it cannot be picked or moved");
    assert.equal(await there(), null);
    await click("Unlock crate_1");
    await click("Hide crate_1");
    await until("hidden", async () => (await there()) === null);
    await click("Lock crate_1: it cannot be picked or moved");
    await row(page, "wall").hover();
    await page.getByLabel("Hide wall").click();
    const solids = () =>
        page.evaluate(() => window.roboss.stage.statics?.solids.filter(({ name }) => name === "solids").length);
    assert.equal(await solids(), 0);
    await page.reload();
    await until("the scene is drawn", () => page.evaluate(() => document.body.dataset.ready === "true"));
    assert.equal(await row(page, "crate_1").getByLabel("Show crate_1").getAttribute("aria-pressed"), "true");
    assert.equal(await row(page, "crate_1").getByLabel("Unlock crate_1").getAttribute("aria-pressed"), "true");
    assert.equal(await solids(), 0);
    for (const label of ["Show crate_1", "Unlock crate_1"]) await click(label);
    await row(page, "wall").hover();
    await page.getByLabel("Show wall").click();
    assert.equal(await solids(), 1);
});

bench.test("the tree is walked, folded and selected from by keys", async (page) => {
    const tree = page.getByRole("tree", { name: "Scene" });
    await tree.focus();
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowDown"); // the crates are of one type, which has a heading
    await page.keyboard.press("ArrowDown");
    await until("the first robot", () => page.evaluate(() => window.roboss.state.selected.value === 0));
    await page.keyboard.press("Shift+ArrowDown");
    assert.deepEqual(await page.evaluate(() => window.roboss.scene.selection.robots), [0, 1]);
    await page.keyboard.press("End");
    await until("the wall", () => page.evaluate(() => window.roboss.state.scenery.value === "wall"));
    await page.getByText("box 4 × 0.2 × 1 m").waitFor();
    await choose(page, "pendulum");
    await tree.focus();
    await page.keyboard.press("ArrowRight");
    await row(page, "hinge").waitFor();
    assert.equal(await row(page, "rod").getAttribute("aria-level"), "3");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await row(page, "hinge").count(), 0);
});

/** A point of the window at this arrow of the gizmo. */
async function arrow(page: Page, axis: string): Promise<{ left: number; top: number }> {
    let found: { left: number; top: number } | null = null;
    await until(`the arrow ${axis}`, async () => {
        found = await page.evaluate((wanted) => {
            const { stage, scene } = window.roboss,
                box = stage.canvas.getBoundingClientRect();
            for (let y = 8; y < box.height; y += 6)
                for (let x = 8; x < box.width; x += 6)
                    if (scene.gizmo.axisAt(x, y) === wanted) return { left: box.left + x, top: box.top + y };
            return null;
        }, axis);
        return found !== null;
    });
    return found ?? { left: 0, top: 0 };
}

bench.test("an arrow of the gizmo moves a paused robot in steps, and undo takes it back", async (page) => {
    await pause(page, true);
    await choose(page, "crate_1");
    await press(page, "f");
    await press(page, "g");
    await page.getByLabel("Steps (Ctrl)").check();
    const before = (await stand(page, "crate_1")).pose;
    await resting(page, await page.evaluate(() => window.roboss.state.selected.value ?? 0));
    const at = await arrow(page, "X");
    await page.mouse.move(at.left, at.top);
    await page.mouse.down();
    // Away from the pendulum.
    for (let k = 1; k <= 8; ++k) await page.mouse.move(at.left - 12 * k, at.top);
    await page.mouse.up();
    // The picture follows the pointer frame by frame: it has arrived when it rests.
    let last = before[0];
    await until("it is drawn where it will be", async () => {
        const drawn = (await stand(page, "crate_1")).pose[0],
            rests = drawn === last && Math.abs(drawn - before[0]) > 0.05;
        last = drawn;
        await page.waitForTimeout(200);
        return rests && !(await page.locator(".tag", { hasText: / m$/ }).isVisible());
    });
    const moved = (await stand(page, "crate_1")).pose;
    near([moved[0] * 10], [Math.round(moved[0] * 10)], 1e-4, "a multiple of 0.1 m");
    near(moved.slice(1), before.slice(1), 1e-4, "only along x");
    // An order takes effect with the next tick after it has arrived.
    const step = async () => (await press(page, "."), false);
    const x = () =>
        page.evaluate(() => {
            const { report, selected } = window.roboss.state;
            return report.value?.robot === selected.value ? (report.value?.pose[0] ?? NaN) : NaN;
        });
    await until("the run has it there", async () => Math.abs((await x()) - moved[0]) < 1e-3 || (await step()));
    await press(page, "Control+z");
    await until("it is back", async () => Math.abs((await x()) - before[0]) < 1e-3 || (await step()));
    await press(page, "v");
});

bench.test("a pose that is typed puts the robot there, in a running world, too", async (page) => {
    await pause(page, false);
    await choose(page, "crate_2");
    const field = (name: string, unit: string) => page.getByLabel(`${name} of the robot, ${unit}`);
    await until("its pose", async () => (await field("x", "m").inputValue()) !== "");
    await field("x", "m").fill("2.5");
    await field("yaw", "degrees").fill("90");
    await field("yaw", "degrees").press("Enter");
    await until("it is there", async () => {
        const { pose } = await stand(page, "crate_2");
        return Math.abs(pose[0] - 2.5) < 0.01 && Math.abs(pose[3] - Math.SQRT1_2) < 0.01;
    });
    await field("x", "m").fill("far");
    await field("x", "m").press("Enter");
    assert.equal(await field("x", "m").getAttribute("aria-invalid"), "true");
    await field("x", "m").press("Escape");
});

bench.test("several robots are removed at once, and undo brings them back as they were", async (page) => {
    await pause(page, true);
    const before = await names(page),
        gone = ["crate_1", "pendulum"],
        stands = await Promise.all(gone.map((name) => stand(page, name)));
    assert.ok(Math.abs(stands[1].joints[0]) > 1e-4, "the pendulum swings");
    await row(page, gone[0]).click();
    await row(page, gone[1]).click({ modifiers: ["Control"] });
    await press(page, "Delete");
    await until("removed", async () => (await names(page)).join() === before.filter((n) => !gone.includes(n)).join());
    await press(page, "Control+z");
    await until("back", async () => (await names(page)).length === before.length);
    await until("both are selected again", async () => (await selected(page)) === "pendulum crate_1");
    await until("drawn", async () => (await stand(page, "pendulum")).joints[0] !== 0);
    for (const [k, name] of gone.entries()) {
        const now = await stand(page, name);
        near(now.pose, stands[k].pose, 1e-4, `${name}'s pose`);
        near(now.joints, stands[k].joints, 1e-4, `${name}'s joints`);
    }
    await press(page, "Control+Shift+Z");
    await until("removed again", async () => (await names(page)).length === before.length - 2);
    await page.getByLabel("Undo", { exact: true }).click();
    await until("back again", async () => (await names(page)).length === before.length);
});

bench.test("a copy has the joint positions of its original and stands beside it", async (page) => {
    await until("it is drawn", async () => (await stand(page, "pendulum")).joints[0] !== 0);
    const original = await stand(page, "pendulum");
    await choose(page, "pendulum");
    await press(page, "Control+d");
    await until("the copy is selected", () =>
        page.evaluate(() => {
            const { world, selected } = window.roboss.state;
            return world.value?.fleet.name(selected.value ?? -1) === "pendulum_1";
        }),
    );
    await until("drawn", async () => (await stand(page, "pendulum_1")).joints[0] !== 0);
    const copy = await stand(page, "pendulum_1");
    near(copy.joints, original.joints, 1e-4, "joints");
    assert.ok(copy.pose[0] > original.pose[0] + 0.5);
    near(copy.pose.slice(1), original.pose.slice(1), 1e-4, "the rest of its pose");
    await press(page, "Control+z");
    await until("gone", async () => !(await names(page)).includes("pendulum_1"));
    await until("its original is selected", async () => (await selected(page)) === "pendulum");
});

bench.endsWithCleanConsole();
