// Adding to the world, with the program: files that are dropped or chosen, shapes with their sizes; then scenery and
// several robots are selected in the picture. In the world beside this file.
import assert from "node:assert/strict";
import { Bench, PROGRAM, until } from "./bench";
import { names, near, press } from "./scene_steps";

const skip = PROGRAM === "" ? "the mock changes no world" : false;
const bench = new Bench({ world: "../web/e2e/scene.sdf", port: 8310 }, skip);

const URDF = `<robot name="puck"><link name="body"><inertial><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><cylinder radius="0.2" length="0.1"/></geometry></collision>
<visual><geometry><cylinder radius="0.2" length="0.1"/></geometry></visual></link></robot>`;

// A floor of its own, a body at rest, and one robot: what many files of MuJoCo have.
const MJCF = `<mujoco model="hopper"><worldbody><light pos="0 0 3"/><geom name="floor" type="plane" size="5 5 .1"/>
<body name="post" pos="0 2 .5"><geom type="box" size=".1 .1 .5"/></body>
<body name="torso" pos="0 0 1.2"><freejoint/><geom type="capsule" size=".07 .2" rgba="1 .5 0 1"/>
<body name="leg" pos="0 0 -.3"><joint name="knee" type="hinge" axis="0 1 0" range="-60 60"/>
<geom type="capsule" fromto="0 0 0 0 0 -.4" size=".05"/></body></body></worldbody>
<actuator><motor joint="knee" gear="20"/></actuator></mujoco>`;

bench.test("an MJCF file is added twice, with another name the second time", async (page) => {
    for (const [n, expected] of ["torso", "torso_1"].entries()) {
        await page.getByLabel("Add a shape or a file").click();
        await page
            .getByLabel("SDF, URDF or MJCF file")
            .setInputFiles({ name: "hopper.xml", mimeType: "text/xml", buffer: Buffer.from(MJCF) });
        await page.getByText("Click where hopper.xml shall stand.").waitFor();
        const box = (await page.locator("canvas").boundingBox()) ?? { x: 0, y: 0, width: 0, height: 0 };
        await page.mouse.click(box.x + box.width * (0.4 + 0.2 * n), box.y + box.height * 0.75);
        await until(expected, async () => (await names(page)).includes(expected));
    }
    const robot = await page.evaluate(() => {
        const fleet = window.roboss.state.world.value?.fleet,
            type = fleet?.type(fleet.find("torso_1") ?? 0);
        return { links: type?.links.map(({ name }) => name), shapes: type?.links.map(({ visuals }) => visuals.length) };
    });
    assert.deepEqual(robot.links, ["torso", "leg"]);
    assert.deepEqual(robot.shapes, [1, 1]);
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
        .getByLabel("SDF, URDF or MJCF file")
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
    await until("it stands on the ground", () =>
        page.evaluate(() => {
            const world = window.roboss.state.world.value,
                z = world?.history.latest?.base[(world.fleet.find("box") ?? 0) * 7 + 2] ?? 0;
            return z > 0.15 && z < 3;
        }),
    );
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
