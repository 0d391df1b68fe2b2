// Cameras of a robot on the page, with the real program: live pictures of all kinds, scales and boxes, one of them large, and
// points in the picture of the world; on a desktop and on a phone.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";
import { Bench, PROGRAM, until } from "./bench";

const skip = PROGRAM === "" ? "the mock has no cameras" : false;
const bench = new Bench({ world: "../web/e2e/cameras.sdf", single: true, query: "?select=rover" }, skip);
const thumbnail = (page: Page, name: string) => page.getByRole("button", { name: `Show ${name}`, exact: true });
const title = (page: Page) => page.locator(".camera-head h3").textContent();
const time = (page: Page) => page.locator(".camera-time").textContent();
const waits = (page: Page) => page.locator(".cameras .waits").count();

/** How many colours the large picture has. */
function colours(page: Page, where = ".cameras > .camera-view"): Promise<number> {
    return page.locator(`${where} canvas`).evaluate((canvas) => {
        const { width, height } = canvas as HTMLCanvasElement,
            data = (canvas as HTMLCanvasElement).getContext("2d")?.getImageData(0, 0, width, height).data ?? [];
        const seen = new Set<number>();
        for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
        return seen.size;
    });
}

bench.test("pictures come when the panel is looked at, and live", async (page) => {
    assert.equal(await page.evaluate(() => window.roboss.state.cameras.wishes.value.length), 0);
    await page.getByRole("tab", { name: "Cameras" }).click();
    await until("all nine pictures", async () => (await page.locator(".camera-thumbnail").count()) === 9);
    await until("they have come", async () => (await waits(page)) === 0);
    assert.equal(await title(page), "front");
    assert.ok((await colours(page)) > 500, "a picture of many colours");
    const first = await time(page);
    await until("a newer picture", async () => (await time(page)) !== first);
});

bench.test("depth has a scale in metres and says the value under the pointer, in colours or grey", async (page) => {
    await thumbnail(page, "depth").click();
    await until("its picture", async () => (await waits(page)) === 0);
    const scale = page.locator(".cameras > .camera-view .camera-scale");
    assert.match((await scale.textContent()) ?? "", /^\d\.\d\d m\d+\.\d\d m$/);
    assert.ok((await colours(page)) > 50);
    await page.locator(".cameras > .camera-view canvas").hover({ position: { x: 100, y: 100 } });
    await until("a value", async () =>
        /^\(\d+, \d+\)\s+(\d+\.\d{3} m|nothing in reach)$/.test(
            (await page.locator(".cameras > .camera-view .camera-reading").textContent()) ?? "",
        ),
    );
    await page.getByRole("button", { name: "Grey" }).click();
    const grey = await page.locator(".cameras > .camera-view canvas").evaluate((canvas) => {
        const { width, height } = canvas as HTMLCanvasElement,
            data = (canvas as HTMLCanvasElement).getContext("2d")?.getImageData(0, 0, width, height).data ?? [];
        let same = 0;
        for (let i = 0; i < data.length; i += 4) same += data[i] === data[i + 1] && data[i + 1] === data[i + 2] ? 1 : 0;
        return same / (data.length / 4);
    });
    assert.ok(grey > 0.5, `${grey}`);
    await page.getByRole("button", { name: "Colours" }).click();
});

bench.test("temperatures are in kelvins, labels have names, boxes stand where things are", async (page) => {
    await thumbnail(page, "heat").click();
    const scale = page.locator(".cameras > .camera-view .camera-scale");
    await until("kelvins", async () => /K.*K$/.test((await scale.textContent()) ?? ""));
    await thumbnail(page, "labels").click();
    await until("labels", async () => /label \d/.test((await scale.textContent()) ?? ""));
    await thumbnail(page, "boxes").click();
    const boxes = page.locator(".cameras > .camera-view .camera-box");
    await until("boxes", async () => (await boxes.count()) > 1);
    await until("their labels", async () =>
        /^label \d$/.test((await page.locator(".cameras > .camera-view .camera-label").allTextContents())[0] ?? ""),
    );
    await until("boxes inside the picture", () =>
        page.evaluate(() => {
            const inside = (selector: string) =>
                [...document.querySelectorAll(`.cameras > .camera-view ${selector}`)].map((one) =>
                    one.getBoundingClientRect(),
                );
            const [frame] = inside(".camera-frame"),
                boxes = inside(".camera-box");
            return (
                boxes.some((box) => box.width > 8 && box.height > 8) &&
                boxes.every((box) => box.left >= frame.left - 4 && box.right <= frame.right + 4)
            );
        }),
    );
    await thumbnail(page, "boxes_3d").click();
    await until("edges of boxes", () =>
        page
            .locator(".cameras > .camera-view .camera-marks path")
            .first()
            .evaluate((path) => (path.getAttribute("d")?.split("M").length ?? 0) === 13),
    );
});

bench.test("one picture lies large over the world, and ends when it is closed", async (page) => {
    await thumbnail(page, "front").click();
    await page.getByLabel("Show it over the picture").click();
    await until("it is there", () => page.locator(".camera-over").isVisible());
    await until("a picture", async () => (await colours(page, ".camera-over")) > 500);
    await page.getByRole("tab", { name: "View" }).click();
    await until("only that one is wanted", () =>
        page.evaluate(() => window.roboss.state.cameras.wishes.value.length === 1),
    );
    await page.getByLabel("Close the large picture").click();
    await until("nothing is wanted", () => page.evaluate(() => window.roboss.state.cameras.wishes.value.length === 0));
});

bench.test("point clouds of depth cameras and lidars lie where the world is", async (page) => {
    await page.evaluate(() => window.roboss.state.toggle("points", true));
    const clouds = () =>
        page.evaluate(() => {
            const found: number[][] = [];
            for (const one of window.roboss.stage.overlays.children) {
                const points = one as { isPoints?: boolean; visible?: boolean; geometry?: unknown };
                if (points.isPoints !== true || points.visible === false) continue;
                const place = (
                    points.geometry as { getAttribute(name: string): { array: ArrayLike<number> } | undefined }
                ).getAttribute("position");
                if (place !== undefined && place.array.length > 0) found.push(Array.from(place.array));
            }
            return found;
        });
    await until("two clouds and the lidar's points", async () => (await clouds()).length === 3);
    for (const points of await clouds()) {
        let low = Infinity,
            far = 0;
        for (let i = 0; i < points.length; i += 3) {
            low = Math.min(low, points[i + 2]);
            far = Math.max(far, Math.hypot(points[i], points[i + 1]));
        }
        assert.ok(points.length > 300 && low > -0.1 && far < 15, `${points.length / 3} points, ${low} m, ${far} m`);
    }
    await page.evaluate(() => window.roboss.state.toggle("points", false));
});

bench.test("IMU and contact force are plotted", async (page) => {
    await page.getByRole("tab", { name: "Robot" }).click();
    for (const name of ["imu specific_force z", "imu angular_velocity z", "bumper force"])
        await page.getByLabel(`Plot ${name}`, { exact: true }).click();
    await until("three curves", async () => (await page.locator(".chart-key").count()) === 3);
    await until("gravity is felt", async () => {
        const told = await page.evaluate(() =>
            window.roboss.state.report.value?.sensors.map((one) => one?.specific_force),
        );
        return (told ?? []).some((force) => Array.isArray(force) && Math.abs(Number(force[2]) - 9.8) < 0.5);
    });
    await page.getByLabel("Remove all plots").click();
});

bench.test("on a phone the panel is a sheet, and its buttons are large enough for fingers", async (page) => {
    const phone = await page
        .context()
        .browser()
        ?.newContext({
            viewport: { width: 390, height: 844 },
            hasTouch: true,
            isMobile: true,
        });
    assert.ok(phone !== undefined);
    const small = await phone.newPage();
    await small.goto(`${page.url().split("#")[0]}`);
    await small.waitForSelector("body[data-ready=true]");
    await small.getByRole("navigation", { name: "Panels" }).getByRole("button", { name: "Cameras" }).tap();
    await until(
        "pictures",
        async () => (await small.locator(".camera-thumbnail").count()) === 9 && (await waits(small)) === 0,
    );
    for (const button of await small.locator(".cameras button:visible, .sheet-bar button").all()) {
        const box = await button.boundingBox();
        assert.ok(
            box !== null && box.width >= 43.5 && box.height >= 43.5,
            `${await button.textContent()}: ${box?.width} x ${box?.height}`,
        );
    }
    const wide = await small.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);
    assert.equal(wide, false, "nothing sticks out");
    await phone.close();
});

bench.endsWithCleanConsole();
