// Plots: several robots in one, export, values under the cursor, kept across reloads and in the link. And the palette.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { Bench, choose, openPage, until, WAIT_MS } from "./bench";

const bench = new Bench({ cars: 12 });
const curves = (page: Page) => page.locator(".chart-key").count();

async function plot(page: Page, robot: string, name: string): Promise<void> {
    await choose(page, robot);
    await page.getByLabel(`Plot ${name}`, { exact: true }).click();
}

bench.test("two robots are compared in one plot, a third variable gets a plot of its own", async (page) => {
    await page.setViewportSize({ width: 1600, height: 900 });
    await plot(page, "car_1", "speed");
    await plot(page, "car_2", "speed");
    await plot(page, "car_2", "yaw");
    await until("two plots", async () => (await page.locator(".chart .uplot").count()) === 2);
    assert.equal(await page.locator(".chart").first().locator(".chart-key").count(), 2);
    await until("values", async () => /^-?\d/.test((await page.locator(".chart-value").first().textContent()) ?? ""));
    await page.getByLabel("Variable to plot").selectOption("position.x");
    await page.getByRole("button", { name: "New plot" }).click();
    await until("three plots", async () => (await page.locator(".chart .uplot").count()) === 3);
});

bench.test("plots are saved as a table and as a picture", async (page) => {
    const [table] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: "CSV" }).click(),
    ]);
    const rows = readFileSync(await table.path(), "utf8")
        .trim()
        .split("\n");
    assert.equal(rows[0], "time [s],car_1 speed [m/s],car_2 speed [m/s],car_2 yaw [°],car_2 x [m]");
    assert.ok(rows.length > 5 && rows.every((row) => row.split(",").length === 5), `${rows.length} rows`);
    const [picture] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name: "PNG" }).click(),
    ]);
    assert.equal(
        readFileSync(await picture.path())
            .subarray(1, 4)
            .toString(),
        "PNG",
    );
});

bench.test("time is zoomed by a drag in all plots at once, and held", async (page) => {
    const box = await page.locator(".chart .u-over").first().boundingBox();
    assert.ok(box !== null);
    await page.mouse.move(box.x + box.width * 0.3, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.6, box.y + 20, { steps: 4 });
    await page.mouse.up();
    await page.getByRole("button", { name: "Whole time" }).click();
    await page.getByLabel("Hold the plots").click();
    assert.equal(await page.getByLabel("Hold the plots").getAttribute("aria-pressed"), "true");
    await page.getByLabel("Hold the plots").click();
});

bench.test("an eighth plotted robot is refused with the reason", async (page) => {
    for (let k = 3; k <= 7; ++k) await plot(page, `car_${k}`, "speed");
    const before = await curves(page);
    await plot(page, "car_8", "speed");
    await until("the reason", () => page.locator(".notice.bad", { hasText: "at most 7 robots" }).isVisible());
    assert.equal(await curves(page), before);
});

bench.test("plots come back after a reload, and with a link in another browser", async (page) => {
    const before = await curves(page);
    await page.getByLabel("Copy a link to this view").click();
    const link = page.url();
    await page.reload();
    await page.waitForSelector("body[data-ready=true]");
    await until("the same curves", async () => (await curves(page)) === before, WAIT_MS);
    const other = await openPage(bench.browser, { ...bench.run, url: link });
    await until("the same curves by the link", async () => (await curves(other.page)) === before, WAIT_MS);
    await other.page.context().close();
    await page.getByLabel("Remove all plots").click();
});

bench.test("the palette finds actions, overlays and robots by a few letters", async (page) => {
    await page.keyboard.press("Control+k");
    const input = page.getByLabel("Find a command or a robot");
    await input.fill("laser");
    await page.keyboard.press("Enter");
    assert.ok(await page.evaluate(() => window.roboss.state.overlays.value.has("rays")));
    await page.getByLabel("All commands").first().click();
    await input.fill("car_11");
    await page.locator(".palette-list li").first().click();
    assert.equal(await page.evaluate(() => window.roboss.state.selected.value), 11);
    await page.keyboard.press("Control+k");
    await input.fill("colour speed");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => window.roboss.state.colourBy.value), "speed");
    assert.equal(await page.locator("dialog[open]").count(), 0);
});

bench.endsWithCleanConsole();
