// How long JavaScript works for a frame with 2000 cars that all move, without the time of the graphics processor: the
// picture is a few pixels small, and what is measured is the page's own work with three.js' preparation of the draw.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import type { Browser } from "playwright-core";
import { openPage, PROGRAM, type Run, startBrowser, startRun, WAIT_MS } from "./bench";

const CARS = 2000;
const FRAME_MS_MAX = 8;
let browser: Browser, run: Run;

before(
    async () => {
        browser = await startBrowser();
        run = await startRun({ cars: CARS });
    },
    { timeout: 2 * WAIT_MS },
);

after(async () => {
    await browser?.close();
    await run?.stop();
});

interface Summary {
    frames: number;
    update_ms: number;
    update_median_ms: number;
    update_p95_ms: number;
    draw_ms: number;
    draw_median_ms: number;
    draw_p95_ms: number;
}

const skip = PROGRAM === "" ? false : "the mock has as many cars as one likes";

test(
    `a frame with ${CARS} moving cars costs less than ${FRAME_MS_MAX} ms of JavaScript`,
    { timeout: 3 * WAIT_MS, skip },
    async () => {
        const { page, errors } = await openPage(browser, run, "?camera=top");
        const summary = (await page.evaluate(async () => {
            const { stage, times } = (
                window as unknown as {
                    roboss: {
                        stage: import("../src/view/stage").Stage;
                        times: import("../src/view/frame_times").FrameTimes;
                    };
                }
            ).roboss;
            stage.renderer.setPixelRatio(1);
            stage.renderer.setSize(8, 8, false);
            await new Promise((resolve) => setTimeout(resolve, 2000));
            times.forget();
            await new Promise((resolve) => setTimeout(resolve, 8000));
            return times.summary();
        })) as unknown as Summary;
        console.log(JSON.stringify(summary));
        assert.ok(summary.frames > 10, `${summary.frames} frames`);
        assert.ok(summary.update_median_ms + summary.draw_median_ms < FRAME_MS_MAX, JSON.stringify(summary));
        assert.deepEqual(errors, []);
    },
);
