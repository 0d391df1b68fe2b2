// What the tests of handling the scene do and ask again and again.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { paused, settled, until } from "./bench";

export const names = (page: Page) =>
    page.evaluate(() => window.roboss.state.world.value?.fleet.scene.robots.map(({ name }) => name) ?? []);
/** Names of the robots that are selected, the primary one first. */
export const selected = (page: Page) =>
    page.evaluate(() => {
        const { scene, state } = window.roboss;
        return scene.selection.robots.map((robot) => state.world.value?.fleet.name(robot)).join(" ");
    });
export const row = (page: Page, name: string) => page.locator(".row", { hasText: new RegExp(`^${name}$`) });

/** A key of the page, not of the field that has the focus. */
export async function press(page: Page, key: string): Promise<void> {
    await page.locator("canvas").focus();
    await page.keyboard.press(key);
}

/** Where a robot is drawn: its own frame and its joint coordinates. */
export function stand(page: Page, name: string): Promise<{ pose: number[]; joints: number[] }> {
    return page.evaluate((wanted) => {
        const { state, scene } = window.roboss,
            world = state.world.value,
            robot = world?.fleet.find(wanted);
        if (world === null || robot === undefined) return { pose: [], joints: [] };
        const [from, to] = [world.fleet.firstCoordinate[robot], world.fleet.firstCoordinate[robot + 1]];
        return { pose: scene.placing.frame(robot), joints: [...world.history.drawn.joints.slice(from, to)] };
    }, name);
}

export async function pause(page: Page, on: boolean): Promise<void> {
    if ((await paused(page)) !== on) await page.getByLabel(on ? "Pause" : "Play", { exact: true }).click();
    await until(on ? "paused" : "running", async () => (await paused(page)) === on);
    if (!on) return;
    // The last States of the time before have come when nothing moves any more.
    await settled("it rests", async () =>
        JSON.stringify(await Promise.all((await names(page)).map((name) => stand(page, name)))),
    );
}

export const near = (a: readonly number[], b: readonly number[], within: number, what: string) =>
    assert.ok(
        a.length === b.length && a.every((value, k) => Math.abs(value - b[k]) <= within),
        `${what}: ${a}, not ${b}`,
    );
