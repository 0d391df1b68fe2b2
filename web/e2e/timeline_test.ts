// Earlier moments, with the program: pointing and dragging show them while the run goes on, the run continues from one in
// a new branch, and moments have names. A replay is scrubbed both ways.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, PROGRAM, time, until, WAIT_MS } from "./bench";

const skip = PROGRAM === "" ? "the mock has no branches" : false;
const bench = new Bench({ world: "../web/e2e/timeline.sdf", single: true }, skip);
/** The slider of the world moves at this speed, from x = 0 at the start (timeline.sdf). */
const SPEED = 0.5;

const track = (page: Page) => page.getByLabel("Timeline: look at an earlier time");
const strip = (page: Page) => page.getByLabel("Earlier moment");

interface Sight {
    x: number;
    time: number;
    exact: boolean;
    shown: boolean;
}

/** Where the page draws the slider, and which moment it shows. */
function sight(page: Page): Promise<Sight> {
    return page.evaluate(() => {
        const { state } = window.roboss,
            world = state.world.value,
            robot = world?.fleet.find("slider") ?? -1,
            shown = state.shown.value;
        return {
            x: world?.history.drawn.base[robot * 7] ?? NaN,
            time: state.drawnTime.value,
            exact:
                shown?.exact === true &&
                shown.time_s === state.drawnTime.value && // the picture shows it already
                Math.abs(shown.time_s - (window.roboss.run.preview.wanted.value?.time ?? -1)) < 0.0021, // a tick
            shown: shown !== null,
        };
    });
}

/** Waits until an earlier moment between these times is drawn as it was. */
async function seen(page: Page, less_than: number, more_than = -1): Promise<Sight> {
    let found: Sight | null = null;
    await until("the moment is drawn", async () => {
        const is = await sight(page),
            expected = is.time < less_than && is.time > more_than;
        if (is.shown && is.exact && expected && Math.abs(is.x - SPEED * is.time) < 0.02) found = is;
        return found !== null;
    });
    return found as unknown as Sight;
}

async function place(page: Page, share: number): Promise<{ x: number; y: number }> {
    const box = await track(page).boundingBox();
    assert.ok(box !== null);
    return { x: box.x + box.width * share, y: box.y + box.height / 2 };
}

bench.test("pointing at the timeline shows an earlier moment, and leaving it the present", async (page) => {
    await until("a few seconds", async () => (await time(page)) > 4, WAIT_MS);
    const now = await time(page),
        at = await place(page, 0.3);
    await page.mouse.move(at.x, at.y);
    await seen(page, 0.6 * now);
    const before = await time(page);
    await until("the run goes on meanwhile", async () => (await time(page)) > before + 0.4);
    assert.ok((await sight(page)).shown, "the moment still shows");
    await page.mouse.move(at.x, at.y - 200);
    await until("the present", async () => !(await sight(page)).shown);
    await until("it is drawn", async () => (await sight(page)).time > before);
});

bench.test("dragging shows each moment while the run goes on, and releasing changes nothing", async (page) => {
    const began = await time(page);
    const from = await place(page, 0.9);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    let drawn = began;
    for (const share of [0.7, 0.5, 0.3]) {
        const at = await place(page, share);
        await page.mouse.move(at.x, at.y, { steps: 3 });
        drawn = (await seen(page, drawn - 0.3)).time;
    }
    const back = await place(page, 0.6);
    await page.mouse.move(back.x, back.y, { steps: 3 });
    await seen(page, await time(page), drawn + 0.3);
    await page.mouse.up();
    await until("the run goes on", async () => (await time(page)) > began + 0.5);
    assert.match((await strip(page).textContent()) ?? "", /^You see [\d:.]+ of branch 1; the run is at [\d:.]+/);
    assert.ok((await sight(page)).shown, "the moment stays");
});

bench.test("keys move by a tick and by a second, and Escape goes back to now", async (page) => {
    await track(page).focus();
    const { time: at } = await seen(page, await time(page));
    await page.keyboard.press("ArrowLeft");
    await until("a tick earlier", async () => Math.abs((await sight(page)).time - at + 0.002) < 1e-4);
    await page.keyboard.press("Shift+ArrowLeft");
    await until("a second earlier", async () => Math.abs((await sight(page)).time - at + 1.002) < 1e-4);
    await page.keyboard.press("Home");
    await until("the beginning", async () => (await sight(page)).time === 0);
    await track(page).blur();
    await page.keyboard.press("Escape");
    await until("the present", async () => !(await sight(page)).shown && !(await strip(page).isVisible()));
});

bench.test("a moment gets a name, and the name leads back to it", async (page) => {
    const at = await place(page, 0.4);
    await page.mouse.click(at.x, at.y);
    const { time: then } = await seen(page, await time(page));
    await track(page).blur();
    await page.keyboard.press("b");
    await page.getByRole("textbox", { name: /^Name the moment/ }).fill("the bend");
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
    await until("the present", async () => !(await sight(page)).shown);
    await page.getByRole("button", { name: /^Branches and bookmarks/ }).click();
    await page.getByRole("button", { name: "the bend", exact: true }).click();
    await until("the same moment", async () => Math.abs((await sight(page)).time - then) < 0.0021);
    await page.getByRole("button", { name: "Remove bookmark the bend" }).click();
    await until(
        "it is gone",
        async () => (await page.getByRole("button", { name: "the bend", exact: true }).count()) === 0,
    );
    await page.getByRole("button", { name: "Back to now" }).click();
});

bench.test("the run continues from an earlier moment in a new branch, and the old one stays", async (page) => {
    const at = await place(page, 0.5);
    await page.mouse.click(at.x, at.y);
    const { time: then } = await seen(page, await time(page));
    await page.getByRole("button", { name: "Continue from here" }).click();
    await until("branch 2", () => page.evaluate(() => window.roboss.state.status.value?.branch === 2));
    await until("from there on", async () => (await time(page)) > then + 0.3 && (await time(page)) < then + 20);
    await until("where it was", async () => {
        const is = await sight(page);
        return !is.shown && Math.abs(is.x - SPEED * is.time) < 0.05;
    });
    const old = page.getByLabel("Timeline of branch 1");
    await until("both branches", async () => (await page.getByLabel(/^Timeline of branch/).count()) === 2);
    const box = await old.boundingBox();
    assert.ok(box !== null);
    await page.mouse.click(box.x + box.width * 0.95, box.y + box.height / 2);
    await until("the old branch", async () => /of branch 1/.test((await strip(page).textContent()) ?? ""));
    const is = await seen(page, 1e9);
    assert.ok(is.time > then, "behind the moment at which the run left it");
    await page.getByRole("button", { name: "Back to now" }).click();
});

bench.endsWithCleanConsole();
