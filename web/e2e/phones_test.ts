// The page on phones and tablets: whatever a wide screen offers is reached, targets are large enough for fingers, nothing
// scrolls sideways, and the picture stays in sight.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";
import { openPage, PROGRAM, type Run, startBrowser, startRun, until, WAIT_MS } from "./bench";
import { resting } from "./sight";

const SIZES = [
    { name: "phone", width: 390, height: 844 },
    { name: "phone held sideways", width: 844, height: 390 },
    { name: "tablet", width: 768, height: 1024 },
    { name: "tablet held sideways", width: 1024, height: 768 },
];
const TARGET_PX = 44;
const CONTROLS = "button, select, input, textarea, summary, [role=tab], [role=separator]";
const limit = { timeout: 3 * WAIT_MS, skip: PROGRAM === "" ? false : "the sizes of the page do not depend on the run" };
let browser: Browser, run: Run, page: Page;
/** Names of the controls of a wide screen. */
const offered = new Set<string>();

before(async () => {
    if (limit.skip !== false) return;
    browser = await startBrowser();
    run = await startRun({ cars: 20 });
    await offer();
    page = await touchPage();
}, limit);
after(async () => {
    await browser?.close();
    await run?.stop();
});

/** What stands for a control: its name, or what it is. */
function names(page: Page): Promise<string[]> {
    return page.evaluate((controls) => {
        const found = new Set<string>();
        for (const one of document.querySelectorAll<HTMLElement>(controls)) {
            if (one.closest("dialog, .sheet-bar, .sheet-head, .more, .row") !== null || !one.checkVisibility())
                continue;
            const name =
                one.getAttribute("aria-label") ??
                (one as HTMLInputElement).labels?.[0]?.textContent ??
                one.textContent ??
                "";
            if (name !== "") found.add(name.trim());
        }
        return [...found];
    }, CONTROLS);
}

/** Controls in sight that are smaller than a finger; a label counts with its box. */
function small(page: Page): Promise<string[]> {
    return page.evaluate(
        ([controls, target]) => {
            const found: string[] = [];
            for (const one of document.querySelectorAll<HTMLElement>(controls as string)) {
                if (!one.checkVisibility()) continue;
                const inner = one.matches("[type=checkbox], [type=radio]") ? one.closest("label") : one,
                    box = (inner ?? one).getBoundingClientRect();
                if (box.width + 0.5 < (target as number) || box.height + 0.5 < (target as number))
                    found.push(`${one.outerHTML.slice(0, 90)} ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`);
            }
            return found;
        },
        [CONTROLS, TARGET_PX] as const,
    );
}

async function touchPage(): Promise<Page> {
    const viewport = { width: 390, height: 844 },
        context = await browser.newContext({ viewport, hasTouch: true, isMobile: true }),
        opened = await context.newPage();
    opened.setDefaultTimeout(WAIT_MS);
    await opened.goto(`${run.url}?quality=low&select=car_5`);
    await opened.waitForSelector("body[data-ready=true]");
    return opened;
}

async function offer(): Promise<void> {
    const wide = await openPage(browser, run, "select=car_5");
    await wide.page.setViewportSize({ width: 1600, height: 900 });
    await reported(wide.page);
    for (const tab of await wide.page.getByRole("tab").all()) {
        await tab.click();
        (await names(wide.page)).forEach((one) => offered.add(one));
    }
    // What opens and closes panels there are the tabs of the sheets here.
    for (const one of ["Robots panel", "Side panel", "Robot", "Cameras", "Cluster", "View"]) offered.delete(one);
    await wide.page.context().close();
}

async function sized(width: number, height: number): Promise<void> {
    const close = page.getByLabel("Close the sheet");
    if (await close.isVisible()) await close.tap();
    await page.setViewportSize({ width, height });
    await until("the new size", () => page.evaluate((w) => window.roboss.stage.canvas.clientWidth <= w, width));
    await page.waitForTimeout(300);
}

/** Opens all that can be opened, one after the other, and calls `look` each time. */
async function throughAll(look: (where: string) => Promise<void>): Promise<void> {
    await look("the page");
    for (const more of await page.locator(".more").all()) {
        if (!(await more.isVisible())) continue;
        await more.tap();
        await look("a menu");
        await more.tap();
    }
    const views = page.locator(".view-toggle");
    if (await views.isVisible()) {
        await views.tap();
        await look("the views");
        await views.tap();
    }
    const bar = page.locator(".sheet-bar button");
    if (await page.locator(".sheet-bar").isVisible())
        for (const button of await bar.all()) {
            await button.tap();
            await page.waitForTimeout(200);
            await look(`the sheet ${await button.textContent()}`);
        }
    else
        for (const tab of await page.getByRole("tab").all()) {
            await tab.tap();
            await page.waitForTimeout(200);
            await look(`the tab ${await tab.textContent()}`);
        }
}

/** The inspector's rows come with the first report. */
async function reported(shown: Page): Promise<void> {
    await until("the report", () => shown.evaluate(() => window.roboss.state.report.value?.robot === 5));
}

for (const { name, width, height } of SIZES)
    test(`on a ${name} everything is reached, by targets of 44 px, and nothing scrolls sideways`, limit, async () => {
        await sized(width, height);
        await page.evaluate(() => window.roboss.state.selected.set(5));
        await reported(page);
        const reached = new Set<string>();
        await throughAll(async (where) => {
            (await names(page)).forEach((one) => reached.add(one));
            assert.deepEqual(await small(page), [], `${where}: too small`);
            const sizes = await page.evaluate(() => ({
                over: document.documentElement.scrollWidth - window.innerWidth,
                scale: window.visualViewport?.scale,
                view: window.roboss.stage.canvas.clientHeight * window.roboss.stage.canvas.clientWidth,
                all: window.innerWidth * window.innerHeight,
            }));
            assert.ok(sizes.over <= 0 && sizes.scale === 1, `${where} is wider than the screen`);
            assert.ok(sizes.view > 0.25 * sizes.all, `${where}: the picture keeps ${sizes.view} of ${sizes.all}`);
        });
        const missing = [...offered].filter((one) => !reached.has(one) && !/^(Play|Pause)$/.test(one));
        assert.deepEqual(missing, []);
    });

test("fingers turn, move and zoom the picture, and a long press opens a robot's sheet", limit, async () => {
    await sized(390, 844);
    const goal = () => page.evaluate(() => structuredClone(window.roboss.views.rig.goal)),
        client = await page.context().newCDPSession(page);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", ...points: [number, number][]) =>
        client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const began = await goal();
    await touch("touchStart", [200, 300]);
    await touch("touchMove", [260, 320]);
    await touch("touchEnd");
    const turned = await goal();
    assert.ok(Math.abs(turned.azimuth - began.azimuth) > 0.1, "one finger turns");
    assert.deepEqual(turned.target, began.target);
    await touch("touchStart", [150, 300], [250, 300]);
    await touch("touchMove", [100, 300], [300, 300]);
    await touch("touchEnd");
    const nearer = await goal();
    assert.ok(nearer.distance < 0.8 * turned.distance, `${nearer.distance} of ${turned.distance}: a pinch zooms`);
    assert.equal(nearer.azimuth, turned.azimuth);
    await touch("touchStart", [150, 300], [250, 300]);
    await touch("touchMove", [150, 380], [250, 380]);
    await touch("touchEnd");
    const moved = await goal();
    assert.ok(Math.hypot(...moved.target.map((value, k) => value - nearer.target[k])) > 0.5, "two fingers move");
    await page.evaluate(() => window.roboss.run.control("pause"));
    await page.getByRole("button", { name: "More", exact: true }).tap();
    await page.getByLabel("Look at the selected robot").tap();
    const at = await resting(page, 5);
    await page.touchscreen.tap(20, 120);
    await until("nothing selected", () => page.evaluate(() => window.roboss.state.selected.value === null));
    await touch("touchStart", [at.left, at.top]);
    await until("the sheet", () => page.locator(".inspector h3", { hasText: /^car_5$/ }).isVisible());
    await touch("touchEnd");
    assert.equal(await page.evaluate(() => window.roboss.state.selected.value), 5, "letting go keeps the selection");
    await page.getByLabel("Close the sheet").tap();
    assert.ok(!(await page.locator(".panel.right").isVisible()));
});

test("the head of a sheet is dragged higher, and down to close it", limit, async () => {
    await sized(390, 844);
    const panel = page.locator(".panel.right"),
        height = async () => (await panel.boundingBox())?.height ?? 0;
    await page.locator(".sheet-bar button", { hasText: "Cluster" }).tap();
    const before = await height(),
        box = await page.locator(".sheet-head h2").boundingBox();
    assert.ok(box !== null);
    await page.mouse.move(box.x + 5, box.y + 5);
    await page.mouse.down();
    await page.mouse.move(box.x + 5, box.y - 145);
    await until("higher", async () => Math.abs((await height()) - before - 150) < 4);
    await page.mouse.move(box.x + 5, 840);
    await page.mouse.up();
    assert.ok(!(await panel.isVisible()));
});
