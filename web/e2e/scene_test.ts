// Handling the scene, with the program: hidden and locked things, the gizmo, typed poses, several robots at once, copy,
// remove, undo, files that are dropped and shapes that are added. In the world beside this file.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, PROGRAM, until } from "./bench";
import { resting, visiblePoint } from "./sight";

const skip = PROGRAM === "" ? "the mock changes no world" : false;
const bench = new Bench({ world: "../web/e2e/scene.sdf", port: 8290 }, skip);

const URDF = `<robot name="puck"><link name="body"><inertial><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><cylinder radius="0.2" length="0.1"/></geometry></collision>
<visual><geometry><cylinder radius="0.2" length="0.1"/></geometry></visual></link></robot>`;

const names = (page: Page) =>
    page.evaluate(() => window.roboss.state.world.value?.fleet.scene.robots.map(({ name }) => name) ?? []);
const row = (page: Page, name: string) => page.locator(".row", { hasText: new RegExp(`^${name}$`) });
const paused = (page: Page) => page.evaluate(() => window.roboss.state.status.value?.paused === true);

/** A key of the page, not of the field that has the focus. */
async function press(page: Page, key: string): Promise<void> {
    await page.locator("canvas").focus();
    await page.keyboard.press(key);
}

/** Where a robot is drawn: its own frame and its joint coordinates. */
function stand(page: Page, name: string): Promise<{ pose: number[]; joints: number[] }> {
    return page.evaluate((wanted) => {
        const { state, scene } = window.roboss,
            world = state.world.value,
            robot = world?.fleet.find(wanted);
        if (world === null || robot === undefined) return { pose: [], joints: [] };
        const [from, to] = [world.fleet.firstCoordinate[robot], world.fleet.firstCoordinate[robot + 1]];
        return { pose: scene.placing.frame(robot), joints: [...world.history.drawn.joints.slice(from, to)] };
    }, name);
}

async function pause(page: Page, on: boolean): Promise<void> {
    if ((await paused(page)) !== on) await page.getByLabel(on ? "Pause" : "Play", { exact: true }).click();
    await until(on ? "paused" : "running", async () => (await paused(page)) === on);
    if (!on) return;
    // The last States of the time before have come when nothing moves any more.
    let before = "";
    await until("it rests", async () => {
        const now = JSON.stringify(await Promise.all((await names(page)).map((name) => stand(page, name))));
        return now === before || ((before = now), false);
    });
}

const near = (a: readonly number[], b: readonly number[], within: number, what: string) =>
    assert.ok(
        a.length === b.length && a.every((value, k) => Math.abs(value - b[k]) <= within),
        `${what}: ${a}, not ${b}`,
    );

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
});

bench.test("a file that is dropped on the picture is added there", async (page) => {
    await page.evaluate((content) => {
        const data = new DataTransfer(),
            { canvas } = window.roboss.stage,
            box = canvas.getBoundingClientRect(),
            at = { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 };
        data.items.add(new File([content], "puck.urdf"));
        for (const kind of ["dragover", "drop"])
            canvas.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true, ...at }));
    }, URDF);
    await until("the puck", async () => (await names(page)).includes("puck"));
    // Larger than other messages may be.
    const large = URDF.replace("<link", `<!-- ${"x".repeat(200_000)} --><link`);
    await page.getByLabel("Add a shape or a file").click();
    await page
        .getByLabel("SDF or URDF file")
        .setInputFiles({ name: "large.urdf", mimeType: "text/xml", buffer: Buffer.from(large) });
    await page.getByText("Click where large.urdf shall stand.").waitFor();
    const box = (await page.locator("canvas").boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
    await page.mouse.click(box.x + box.width * 0.3, box.y + box.height * 0.7);
    await until("another puck", async () => (await names(page)).includes("puck_1"));
});

bench.test("a box with the sizes that are given is added, and scenery is chosen in the picture", async (page) => {
    await page.getByLabel("Add a shape or a file").click();
    await page.getByLabel("Length (x)").fill("0");
    await page.getByRole("button", { name: "Add at the middle of the view" }).click();
    await page.getByText("Sizes are numbers above 0").waitFor();
    await page.getByLabel("Length (x)").fill("0.6");
    await page.getByRole("spinbutton", { name: "Mass" }).fill("2.5");
    await page.getByRole("button", { name: "Add at the middle of the view" }).click();
    await until("the box", async () => (await names(page)).includes("box"));
    const type = await page.evaluate(() => {
        const fleet = window.roboss.state.world.value?.fleet;
        return fleet?.type(fleet.find("box") ?? 0);
    });
    assert.deepEqual(type?.links[0].visuals[0].size, [0.6, 0.4, 0.4]);
    assert.equal(type?.links[0].mass, 2.5);
    near(type?.links[0].inertia?.slice(0, 1) ?? [], [(2.5 * 0.32) / 12], 1e-9, "its inertia");
    await press(page, "h");
    await until("the wall under some point", () =>
        page.evaluate(() => {
            const { canvas } = window.roboss.stage,
                box = canvas.getBoundingClientRect();
            for (let y = 8; y < box.height; y += 8)
                for (let x = 8; x < box.width; x += 8) {
                    if (window.roboss.scene.sceneryAt(box.left + x, box.top + y) !== "wall") continue;
                    Object.assign(document.body.dataset, { wallx: box.left + x, wally: box.top + y });
                    return true;
                }
            return false;
        }),
    );
    const at = await page.evaluate(() => [Number(document.body.dataset.wallx), Number(document.body.dataset.wally)]);
    await page.mouse.click(at[0], at[1]);
    await until("the wall", () => page.evaluate(() => window.roboss.state.scenery.value === "wall"));
});

bench.test("a box drawn with Shift selects what is in it", async (page) => {
    await page.keyboard.press("Escape");
    const box = (await page.locator("canvas").boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
    const count = (await names(page)).length;
    await press(page, "h");
    // Until the camera has arrived, some may be outside.
    await until("all of them", async () => {
        await page.keyboard.down("Shift");
        await page.mouse.move(box.x + 4, box.y + 4);
        await page.mouse.down();
        await page.mouse.move(box.x + box.width - 4, box.y + box.height - 4, { steps: 4 });
        await page.mouse.up();
        await page.keyboard.up("Shift");
        return page.evaluate((n) => window.roboss.scene.selection.robots.length === n, count);
    });
    await page.keyboard.press("Escape");
});

bench.endsWithCleanConsole();
