// What is ordered in the page is what the world does: a Client written in C++, which joined the same cluster over the
// network, says so. It knows nothing of the page, nor of the gateway.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, choose, type CppClient, PROGRAM, until } from "./bench";
import { drag } from "./sight";

const skip = PROGRAM === "" ? "the mock has no cluster" : false;
const bench = new Bench({ cluster: true, told: ["car_3", "car_11"] }, skip);
const of = (robot: string) => (bench.client as CppClient).of(robot);

/** Where the page says that the selected robot is. */
async function told(page: Page, robot: number): Promise<number[]> {
    await until("its report", () => page.evaluate((r) => window.roboss.state.report.value?.robot === r, robot));
    return page.evaluate(() => [...(window.roboss.state.report.value?.pose ?? [])].slice(0, 3));
}

function apart(a: number[], b: number[]): number {
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bench.test("the Client sees the robots that the page shows, where it shows them", async (page) => {
    await until("its first words", async () => bench.client?.told.size === 2);
    await choose(page, "car_3");
    const shown = await told(page, 3);
    assert.ok(apart(of("car_3").position, shown) < 0.05, `${shown} ${JSON.stringify(of("car_3"))}`);
});

bench.test("a car that is dragged in the page stands elsewhere for the Client too", async (page) => {
    const { position } = of("car_3");
    await drag(page, 3, 120, 40);
    await until("it is elsewhere", async () => apart(of("car_3").position, position) > 0.3);
    await until("and there they agree", async () => {
        return apart(of("car_3").position, await told(page, 3)) < 0.05;
    });
});

bench.test("a joint order of the page is the motor's set-point, and the wheel turns as ordered", async (page) => {
    await choose(page, "car_11");
    const wheel = () => of("car_11").joints.front_left[0];
    assert.ok(Math.abs(wheel().velocity) < 0.5, `it stands still: ${JSON.stringify(wheel())}`);
    await page.getByLabel("Motor mode of front_left").selectOption("velocity");
    await page.getByLabel("Target of front_left").fill("8");
    await until("the order", async () => wheel().mode === "velocity" && wheel().target === 8);
    await until("8 rad/s", async () => Math.abs(wheel().velocity - 8) < 0.3);
});

bench.test("time stands still for the Client while the page has paused it, and goes on", async (page) => {
    await page.getByLabel("Pause", { exact: true }).click();
    await until("paused", () => page.getByLabel("Play", { exact: true }).isVisible());
    await page.waitForTimeout(500);
    const { time } = of("car_3");
    await page.waitForTimeout(1500);
    assert.equal(of("car_3").time, time);
    await page.getByLabel("Play", { exact: true }).click();
    await until("it goes on", async () => of("car_3").time > time + 0.5);
});

bench.endsWithCleanConsole();
