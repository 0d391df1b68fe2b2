// Own numbers in the inspector, of joints, links, gravity and wind: they are shown, changed, refused in words, given back and undone.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, fewPixels, notice, until } from "./bench";

const bench = new Bench();
const section = (page: Page) => page.locator("details.section", { has: page.locator(".number-choice") });
const damping = (page: Page) => page.getByLabel(/^damping of front_left/);
const row = (page: Page, name: string) =>
    page.locator(".number-row", { has: page.locator(".label", { hasText: new RegExp(`^${name}$`) }) });
const fault = async (page: Page) => (await section(page).locator(".fault").textContent()) ?? "";
const press = (page: Page, name: string) => section(page).getByRole("button", { name, exact: true }).click();

/** The damping of the front left wheel that the robot has of its own; null: that of the file. */
function own(page: Page): Promise<number | null> {
    return page.evaluate(() => {
        const joints = window.roboss.state.report.value?.own?.joints ?? [],
            type = window.roboss.state.world.value!.fleet.type(window.roboss.state.selected.value!),
            wheel = type.joints.findIndex(({ name }) => name === "front_left");
        return joints.find(({ joint }) => joint === wheel)?.values["damping"] ?? null;
    });
}

async function set(page: Page, text: string): Promise<void> {
    await damping(page).fill(text);
    await damping(page).press("Enter");
}

bench.test("the numbers are folded, and asked for when they are opened", async (page) => {
    await fewPixels(page);
    await choose(page, "car_3");
    await until("the section", () => section(page).isVisible());
    assert.equal(await damping(page).count(), 0);
    assert.equal(await page.evaluate(() => window.roboss.state.wantsNumbers.value), null);
    await section(page).locator("summary").click();
    await page.getByLabel("Which numbers are shown").selectOption({ label: "front_left" });
    await until("its damping", () => damping(page).isVisible());
    assert.match((await row(page, "damping").textContent()) ?? "", /N m s\/rad/);
    assert.equal(await row(page, "damping").getAttribute("class"), "number-row", "it is that of the file");
});

bench.test("a number is set, marked, and the file's stands beside it", async (page) => {
    const before = await damping(page).inputValue();
    await set(page, "0.4");
    await until("it is the robot's", async () => (await own(page)) === 0.4);
    await until("its mark", async () => ((await row(page, "damping").textContent()) ?? "").includes(`file: ${before}`));
    assert.equal(await damping(page).inputValue(), "0.4");
    await until("the title", async () => /Numbers \(1 own\)/.test((await section(page).textContent()) ?? ""));
});

bench.test("a field refuses what is no number at once, and shows why the run refuses a number", async (page) => {
    await damping(page).fill("much");
    assert.equal(await damping(page).getAttribute("aria-invalid"), "true");
    assert.equal(await fault(page), "Not a number: damping.");
    assert.ok(await section(page).getByRole("button", { name: "Set", exact: true }).isDisabled());
    await damping(page).press("Escape");
    await until("its number again", async () => (await damping(page).inputValue()) === "0.4");
    assert.equal(await fault(page), "");
    await set(page, "-1");
    await until("why", async () => (await fault(page)).includes("cannot be negative"));
    assert.ok((await notice(page)).includes("cannot be negative"));
    assert.equal(await own(page), 0.4);
    await damping(page).press("Escape");
});

bench.test("limits are sent together", async (page) => {
    const upper = page.getByLabel(/^upper of front_left/);
    await upper.fill("2");
    await press(page, "Set");
    await until("its mark", async () => (await row(page, "upper").getAttribute("class")) === "number-row own");
    assert.equal(await page.getByLabel(/^lower of front_left/).inputValue(), "-∞");
});

bench.test("the numbers of the file are given back, and each change is undone", async (page) => {
    await press(page, "As in the file");
    await until("the file's", async () => (await own(page)) === null);
    await until("no mark", async () => (await row(page, "damping").getAttribute("class")) === "number-row");
    const undo = (forth = false) =>
        page.evaluate((again) => {
            const { undo } = window.roboss.scene.editing;
            return again ? undo.redo() : undo.undo();
        }, forth);
    assert.equal(await undo(), "numbers of front_left of car_3");
    await until("as before", async () => (await own(page)) === 0.4);
    await undo();
    await undo();
    await until("as at first", async () => (await own(page)) === null);
    await undo(true);
    await until("set again", async () => (await own(page)) === 0.4);
});

bench.test("a link has a mass", async (page) => {
    await page.getByLabel("Which numbers are shown").selectOption({ label: "chassis" });
    const mass = page.getByLabel(/^mass of chassis/);
    await until("its mass", () => mass.isVisible());
    await mass.fill("7");
    await press(page, "Set");
    await until("it is the robot's", () =>
        page.evaluate(() => window.roboss.state.report.value?.own?.links?.[0]?.values["mass"] === 7),
    );
});

bench.test("gravity and wind are set by component, refused in words, given back and undone", async (page) => {
    const own = () =>
        page.evaluate(() => {
            const { gravity, wind } = window.roboss.state.report.value?.own ?? {};
            return JSON.stringify({ gravity, wind });
        });
    await page.getByLabel("Which numbers are shown").selectOption({ label: "gravity and wind" });
    const down = page.getByLabel("gravity_z of car_3, m/s^2");
    await until("the file's", async () => (await down.inputValue()) === "-9.8");
    assert.equal(await page.evaluate(() => window.roboss.state.wantsNumbers.value), null, "reports have them");
    await down.fill("-1.62");
    await page.getByLabel("wind_x of car_3, m/s").fill("3");
    await press(page, "Set");
    await until("they are the robot's", async () => (await own()) === '{"gravity":[0,0,-1.62],"wind":[3,0,0]}');
    await until("marks", async () => (await section(page).locator(".number-row.own").count()) === 2);
    assert.match((await row(page, "gravity_z").textContent()) ?? "", /m\/s\^2file: -9.8$/);
    assert.match((await row(page, "wind_x").textContent()) ?? "", /m\/sfile: 0$/);
    await down.fill("-1001");
    await down.press("Enter");
    await until("why", async () => (await fault(page)).includes("beyond the limit"));
    await down.press("Escape");
    await press(page, "As in the file");
    await until("the file's again", async () => (await own()) === "{}");
    assert.equal(await page.evaluate(() => window.roboss.scene.editing.undo.undo()), "gravity and wind of car_3");
    await until("as before", async () => (await own()) === '{"gravity":[0,0,-1.62],"wind":[3,0,0]}');
    await until("it is shown", async () => (await down.inputValue()) === "-1.62");
    await page.getByLabel("Which numbers are shown").selectOption({ label: "chassis •" });
});

bench.test("a page that may only look has no way to change them", async (page) => {
    await page.evaluate(() => {
        const { roles } = window.roboss.state;
        if (roles.value !== null) roles.set({ ...roles.value, role: "watch" });
    });
    assert.equal(await page.getByLabel(/^mass of chassis/).getAttribute("readonly"), "");
    assert.equal(await section(page).getByRole("button", { name: "Set", exact: true }).isVisible(), false);
    await page.getByLabel("Which numbers are shown").selectOption({ label: "gravity and wind •" });
    assert.equal(await page.getByLabel("gravity_z of car_3, m/s^2").getAttribute("readonly"), "");
});

bench.endsWithCleanConsole();
