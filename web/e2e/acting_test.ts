// Robots that act, in the page: commands of their on-board controllers, the pad that drives by them, belts that move, and
// bonds that are made and loosed by hand. With the program, in the world beside this file.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import type { Mesh, Object3D, ShaderMaterial, Vector3 } from "three";
import type { PoseArray } from "../src/wire/messages";
import { Bench, choose, notice, PROGRAM, time, until } from "./bench";
import { resting, seen, visiblePoint } from "./sight";

const mockOnly = PROGRAM === "" ? false : "no plugin of that world takes a list";
const bench = new Bench({ world: "../web/e2e/acting.sdf" });

const numberOf = (page: Page, name: string) =>
    page.evaluate((robot) => window.roboss.state.world.value?.fleet.find(robot) ?? -1, name);
const place = async (page: Page, name: string) => seen(page, await numberOf(page, name));
const command = (page: Page, name: string) => page.locator(".command", { has: page.getByText(name, { exact: true }) });

async function selected(page: Page, name: string): Promise<void> {
    await choose(page, name);
    await until("its report", async () => {
        const robot = await numberOf(page, name);
        return page.evaluate((r) => window.roboss.state.report.value?.robot === r, robot);
    });
}

/** The last command of the first channel of the selected robot. */
function lastCommand(page: Page): Promise<{ tick: number; values: (number | null)[] }> {
    return page.evaluate(() => window.roboss.state.report.value?.channels?.[0] ?? { tick: -2, values: [] });
}

bench.test("the inspector lists a robot's commands, and sends what is set", async (page) => {
    await selected(page, "rover");
    const drive = command(page, "cmd_vel");
    assert.match((await drive.textContent()) ?? "", /no command yet/);
    assert.match((await drive.textContent()) ?? "", /linear_x.*m\/s.*angular_z.*rad\/s/s);
    const from = await place(page, "rover");
    await page.getByLabel("linear_x of cmd_vel", { exact: true }).fill("0.5");
    await page.getByRole("button", { name: "Send cmd_vel" }).click();
    await until("it drives", async () => (await place(page, "rover")).x > from.x + 0.2);
    await until("the last command", async () => /last at \d+\.\d\d s/.test((await drive.textContent()) ?? ""));
    await drive.getByRole("button", { name: "Zero" }).click();
    await until("zero", async () => (await lastCommand(page)).values.every((value) => value === 0));
    await until("it stands", async () => {
        const { x } = await place(page, "rover"),
            then = await time(page);
        await until("time goes on", async () => (await time(page)) > then + 0.5);
        return Math.abs((await place(page, "rover")).x - x) < 0.001;
    });
});

bench.test("the pad drives by the robot's own command, and stops it by that", async (page) => {
    await selected(page, "rover");
    await until("its words", () => page.getByText("Drives by its command cmd_vel.").isVisible());
    const from = await place(page, "rover"),
        before = await lastCommand(page);
    await page.getByLabel(/^Velocity pad/).focus();
    await page.keyboard.down("ArrowUp");
    await until("forwards", async () => (await lastCommand(page)).values[0] === 1);
    await until("it drives", async () => (await place(page, "rover")).x > from.x + 0.3);
    await page.keyboard.up("ArrowUp");
    await until("zero", async () => (await lastCommand(page)).values.every((value) => value === 0));
    assert.ok((await lastCommand(page)).tick > before.tick);
});

bench.test("a drive is stopped when another robot is chosen while the pad is held", async (page) => {
    await selected(page, "rover");
    await page.getByLabel(/^Velocity pad/).focus();
    await page.keyboard.down("ArrowLeft");
    await until("it turns", async () => (await lastCommand(page)).values.some((value) => value === 2));
    const rover = await numberOf(page, "rover"),
        box = await numberOf(page, "box_2");
    await page.evaluate((robot) => window.roboss.state.selected.set(robot), box);
    await page.waitForTimeout(1000);
    await page.keyboard.up("ArrowLeft");
    await page.evaluate((robot) => window.roboss.state.selected.set(robot), rover);
    await until("zero", async () => (await lastCommand(page)).values.every((value) => value === 0));
});

bench.test("a robot without a drive says that its body is moved", async (page) => {
    await selected(page, "box_2");
    await until("its words", () => page.getByText("This robot has no drive of its own").isVisible());
    assert.equal(await page.locator(".command").count(), 0);
});

bench.test("a command that the robot does not take is refused in words", async (page) => {
    const rover = await numberOf(page, "rover");
    await page.evaluate(
        (robot) => window.roboss.run.order(robot, { action: "command", name: "fly", values: [1] }),
        rover,
    );
    await until("why", async () => (await notice(page)).includes("has no command 'fly'"));
    await page.evaluate(
        (robot) => window.roboss.run.order(robot, { action: "command", name: "cmd_vel", values: [1, 2] }),
        rover,
    );
    await until("why", async () => /cmd_vel.*has 2 values; it takes \d/.test(await notice(page)));
});

bench.test(
    "a list is commanded row by row, and a row that is cut short is refused beside it",
    async (page) => {
        await selected(page, "rover");
        const path = command(page, "path"),
            rows = page.getByLabel("Rows of path");
        await rows.fill("1 2\n3");
        await page.getByRole("button", { name: "Send path" }).click();
        await until("why", async () => ((await path.locator(".fault").textContent()) ?? "").includes("has 3 values"));
        await rows.fill("1 2\n3 4");
        await page.getByRole("button", { name: "Send path" }).click();
        await until("both rows", async () => {
            const told = await page.evaluate(() => window.roboss.state.report.value?.channels?.[1].values);
            return JSON.stringify(told) === "[1,2,3,4]";
        });
    },
    mockOnly,
);

/** How far the marks of the belt have gone along its motion, and the time that is drawn; null: there are none. */
function marks(page: Page): Promise<{ moved: number; time: number } | null> {
    return page.evaluate(() => {
        const found: { moved: number; time: number }[] = [],
            { stage, state } = window.roboss;
        stage.overlays.traverse((object: Object3D) => {
            const { uniforms } = ((object as Mesh).material ?? {}) as ShaderMaterial;
            for (const [motion, way] of [
                ["linear", "moved"],
                ["belt", "belted"],
            ]) {
                const speed = uniforms?.[motion]?.value as Vector3 | undefined,
                    moved = uniforms?.[way]?.value as Vector3 | undefined;
                if (speed === undefined || moved === undefined || Math.abs(speed.length() - 0.5) > 1e-6) continue;
                found.push({ moved: moved.dot(speed) / speed.length(), time: state.drawnTime.value });
            }
        });
        return found[0] ?? null;
    });
}

bench.test("a belt shows marks that go as fast as it does, and none when it stands", async (page) => {
    await selected(page, "belt");
    assert.equal(await marks(page), null);
    await page.getByLabel("velocity of track_cmd_vel", { exact: true }).fill("0.5");
    await page.getByRole("button", { name: "Send track_cmd_vel" }).click();
    await until("marks", async () => (await marks(page)) !== null);
    await until("the panel says so", () => page.locator(".surfaces", { hasText: "0.50 m/s" }).isVisible());
    const first = await marks(page);
    await page.waitForTimeout(1500);
    const second = await marks(page);
    assert.ok(first !== null && second !== null && second.time > first.time + 0.5);
    const speed = (second.moved - first.moved) / (second.time - first.time);
    assert.ok(Math.abs(speed - 0.5) < 0.05, `${speed} m/s`);
    const box = await place(page, "box_1");
    await page.waitForTimeout(500);
    assert.ok((await place(page, "box_1")).x > box.x, "what lies on it goes along");
    await command(page, "track_cmd_vel").getByRole("button", { name: "Zero" }).click();
    await until("no marks", async () => (await marks(page)) === null);
});

/** The middle of the marked shape, in the world. */
function marksMiddle(page: Page): Promise<number[] | null> {
    return page.evaluate(() => {
        let middle: number[] | null = null;
        window.roboss.stage.overlays.traverse((object: Object3D) => {
            const { uniforms } = ((object as Mesh).material ?? {}) as ShaderMaterial;
            if (uniforms?.["belt"] === undefined) return;
            const { geometry, matrix } = object as Mesh;
            geometry.computeBoundingBox();
            const { min, max } = geometry.boundingBox!;
            middle = min.clone().add(max).multiplyScalar(0.5).applyMatrix4(matrix).toArray();
        });
        return middle;
    });
}

bench.test("a page that is opened while a belt runs draws the marks on it", async (page) => {
    await selected(page, "belt");
    await page.getByLabel("velocity of track_cmd_vel", { exact: true }).fill("0.2");
    await page.getByRole("button", { name: "Send track_cmd_vel" }).click();
    await until("marks", async () => (await marksMiddle(page)) !== null);
    await page.reload();
    await page.waitForSelector("body[data-ready=true]");
    await until("marks again", async () => (await marksMiddle(page)) !== null);
    await selected(page, "belt");
    const middle = (await marksMiddle(page))!,
        belt = await place(page, "belt");
    assert.ok(
        Math.hypot(middle[0] - belt.x, middle[1] - belt.y, middle[2] - belt.z) < 1e-3,
        `the marks are at ${middle}`,
    );
    await command(page, "track_cmd_vel").getByRole("button", { name: "Zero" }).click();
    await until("it stands", async () => (await lastCommand(page)).values.every((value) => value === 0));
});

const bonds = (page: Page) => page.evaluate(() => window.roboss.state.extras.value?.bonds.length ?? 0);

bench.test("a robot takes hold of another that is chosen in the list, carries it, and lets go", async (page) => {
    await selected(page, "gripper");
    await page.locator("summary", { hasText: "Bonds" }).click();
    await page.getByLabel("Reach in m").fill("0.3");
    await page.getByLabel("Holding force in N").fill("5000");
    await page.getByRole("button", { name: "Attach to…" }).click();
    await until("a hint", () => page.getByText("Choose the robot that gripper shall hold").isVisible());
    await choose(page, "box_2");
    await until("the bond", async () => (await bonds(page)) === 1);
    assert.equal(await page.locator(".robot-head h3").textContent(), "gripper", "the holder stays selected");
    const row = page.locator(".bond");
    await until("its load", async () => /holds box_2.*[\d.]+ N of 5000 N/.test((await row.textContent()) ?? ""));
    const from = await place(page, "box_2");
    await page.getByLabel("linear_x of cmd_vel", { exact: true }).fill("-0.5");
    await page.getByRole("button", { name: "Send cmd_vel" }).click();
    await until("the box goes along", async () => (await place(page, "box_2")).x < from.x - 0.2);
    await command(page, "cmd_vel").getByRole("button", { name: "Zero" }).click();
    await selected(page, "box_2");
    await until("held", async () => /held by gripper/.test((await row.textContent()) ?? ""));
    await row.getByRole("button", { name: "Release" }).click();
    await until("no bond", async () => (await bonds(page)) === 0 && (await row.count()) === 0);
});

/** Puts the gripper so far from the box, along x, and waits until the page sees it there. */
async function putBesideBox(page: Page, x: number): Promise<void> {
    const gripper = await numberOf(page, "gripper"),
        box = await place(page, "box_2"),
        pose = [box.x + x, box.y, 0.3, 1, 0, 0, 0];
    await page.evaluate(
        ([robot, ...to]) => window.roboss.run.order(robot, { action: "pose", pose: to as PoseArray }),
        [gripper, ...pose],
    );
    let apart = NaN;
    await until("it is there", async () => {
        apart = (await place(page, "gripper")).x - (await place(page, "box_2")).x;
        return Math.abs(apart - x) < 0.04;
    }).catch((error: unknown) => {
        throw new Error(`the gripper is ${apart} m from the box: ${String(error)}`);
    });
}

/** Clicks on the box with Shift held, once the picture rests and the box is under the pointer. */
async function clickBox(page: Page): Promise<void> {
    const box = await numberOf(page, "box_2");
    await selected(page, "gripper");
    await page.getByLabel("Look at the selected robot").click();
    const at = await visiblePoint(page, box, await resting(page, box));
    assert.ok(at !== null, "the box is seen");
    await page.keyboard.down("Shift");
    await page.mouse.click(at.left, at.top);
    await page.keyboard.up("Shift");
}

/** Puts and clicks until `done`: a slow machine may draw the picture that is clicked into a moment late. */
async function clickUntil(page: Page, x: number, what: string, done: () => Promise<boolean>): Promise<void> {
    for (let left = 4; left > 0 && !(await done()); --left)
        try {
            await putBesideBox(page, x);
            await clickBox(page);
            await until(what, done, 8000);
        } catch (error: unknown) {
            if (left === 1) throw error;
        }
}

bench.test(
    "with Shift, a click in the picture attaches to the selected robot; out of reach, that is said",
    async (page) => {
        const said = async () => (await notice(page)).includes("gripper does not hold box_2");
        await clickUntil(page, -1, "it is out of reach", said);
        assert.equal(await bonds(page), 0);
        await clickUntil(page, -0.3, "the bond", async () => (await bonds(page)) === 1);
        await page.locator(".bond").getByRole("button", { name: "Release" }).click();
        await until("no bond", async () => (await bonds(page)) === 0);
    },
);

bench.endsWithCleanConsole();
