// A recording in the page: it is scrubbed both ways over all branches, played from where it is seen, and stays open at its
// end. In the world beside this file, where the place of the ball tells the time.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { Bench, paused, PROGRAM, time, until } from "./bench";

const SPEED = 0.5;
const skip = PROGRAM === "" ? "the mock records nothing" : false;

/** Two branches: one to 6 s, and one that leaves it at 3 s and goes to 4 s. */
function recorded(folder: string, world: string): string[] {
    const journal = join(folder, "recorded.journal"),
        record = (...options: string[]) => {
            const done = spawnSync(PROGRAM, [
                "run",
                world,
                "--headless",
                "--speed",
                "max",
                "--journal",
                journal,
                ...options,
            ]);
            assert.equal(done.status, 0, String(done.stderr));
        };
    record("--until", "6");
    record("--until", "4", "--from", `${journal}@3`);
    return ["replay", `${journal}#1`, "--speed", "10"];
}

const bench = new Bench({ world: "../web/e2e/timeline.sdf", program: recorded }, skip);

interface Sight {
    x: number;
    time: number;
    exact: boolean;
}

function sight(page: Page): Promise<Sight> {
    return page.evaluate(() => {
        const { state, run } = window.roboss,
            world = state.world.value,
            robot = world?.fleet.find("slider") ?? -1,
            shown = state.shown.value;
        return {
            x: world?.history.drawn.base[robot * 7] ?? NaN,
            time: state.drawnTime.value,
            exact: shown?.exact === true && Math.abs(shown.time_s - (run.preview.wanted.value?.time ?? -9)) < 0.01,
        };
    });
}

async function click(page: Page, label: string, share: number): Promise<void> {
    const box = await page.getByLabel(label, { exact: true }).boundingBox();
    assert.ok(box !== null);
    await page.mouse.click(box.x + 6.5 + (box.width - 13) * share, box.y + box.height / 2);
}

/** Waits until the moment is drawn, where the ball was then. */
async function drawn(page: Page, from: number, to: number): Promise<void> {
    await until(`a moment from ${from} s to ${to} s`, async () => {
        const is = await sight(page);
        return is.exact && is.time >= from && is.time <= to && Math.abs(is.x - SPEED * is.time) < 0.02;
    });
}

const MAIN = "Timeline: look at an earlier time";

bench.test("the recording plays to its end and stays open there", async (page) => {
    await until("the end", async () => Math.abs((await time(page)) - 6) < 1e-6);
    assert.ok(await paused(page));
    assert.equal(await page.getByRole("button", { name: "Continue from here" }).count(), 0);
});

bench.test("it is scrubbed both ways", async (page) => {
    await click(page, MAIN, 0.5);
    await drawn(page, 2.8, 3.2);
    await click(page, MAIN, 0.2);
    await drawn(page, 1.1, 1.3);
    await click(page, MAIN, 0.9);
    await drawn(page, 5.3, 5.5);
    assert.ok(Math.abs((await time(page)) - 6) < 1e-6, "the replay itself stays where it is");
});

bench.test("it plays from the moment that is seen", async (page) => {
    await click(page, MAIN, 0.1);
    await drawn(page, 0.5, 0.7);
    await page.getByLabel("Speed", { exact: true }).selectOption("1");
    await page.getByRole("button", { name: "Play from here" }).click();
    await until("it plays", async () => (await time(page)) > 0.65 && (await time(page)) < 4);
    const then = await time(page);
    await until("on", async () => (await time(page)) > then + 0.3);
});

bench.test("another branch is seen, and played", async (page) => {
    await page.getByRole("button", { name: /^Branches and bookmarks/ }).click();
    await click(page, "Timeline of branch 2", 0.5);
    await drawn(page, 3.4, 3.6);
    assert.match((await page.getByLabel("Earlier moment").textContent()) ?? "", /of branch 2; the replay is at/);
    await page.getByRole("button", { name: "Play from here" }).click();
    await until("branch 2", () => page.evaluate(() => window.roboss.state.status.value?.branch === 2));
    await until("its end", async () => Math.abs((await time(page)) - 4) < 1e-6);
});

bench.endsWithCleanConsole();
