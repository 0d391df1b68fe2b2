// How long JavaScript works for a frame with 2000 cars that all move, without the time of the graphics processor: the
// picture is a few pixels small, and what is measured is the page's own work with three.js' preparation of the draw. All
// frames do the same work, so the quickest tenth tells what it costs where other programs keep the processor busy, too.
import assert from "node:assert/strict";
import { Bench, PROGRAM } from "./bench";

const CARS = 2000;
const FRAME_MS_MAX = 8;
const skip = PROGRAM === "" ? false : "the mock has as many cars as one likes";
const bench = new Bench({ cars: CARS, query: "?camera=top" }, skip);

bench.test(`a frame with ${CARS} moving cars costs less than ${FRAME_MS_MAX} ms of JavaScript`, async (page) => {
    const summary = await page.evaluate(async () => {
        const { stage, times } = window.roboss;
        stage.renderer.setPixelRatio(1);
        stage.renderer.setSize(8, 8, false);
        await new Promise((resolve) => setTimeout(resolve, 2000));
        times.forget();
        await new Promise((resolve) => setTimeout(resolve, 8000));
        return times.summary();
    });
    console.log(JSON.stringify(summary));
    assert.ok(summary.frames > 10, `${summary.frames} frames`);
    assert.ok(summary.update_quick_ms + summary.draw_quick_ms < FRAME_MS_MAX, JSON.stringify(summary));
});

bench.endsWithCleanConsole();
