// What the page says when the run ends, is killed, refuses it or falls silent: each with its remedy (model/run_state.ts).
// The mock gateway makes the trouble; the real program ends by its duration, by a request and by a signal.
import assert from "node:assert/strict";
import { Bench, openPage, PROGRAM, startRun, until, WAIT_MS } from "./bench";

const MOCK_ONLY = PROGRAM === "" ? false : "only the mock gateway makes this trouble",
    REAL_ONLY = PROGRAM === "" ? "the mock gateway ends otherwise" : false;
const bench = new Bench({ cars: 8 });
const trouble = (words: string) => fetch(new URL(`/mock/trouble?${words}`, bench.run.url)).then((one) => one.text());
const shown = (kind: string) =>
    until(`the banner says ${kind}`, () => bench.page.locator(`.banner[data-kind="${kind}"]`).isVisible(), WAIT_MS);
const well = () => until("no banner", async () => !(await bench.page.locator(".banner").isVisible()), WAIT_MS);
const words = async () => (await bench.page.locator(".banner").textContent()) ?? "";

bench.test(
    "a Controller that falls silent is noticed, and one that speaks again, too",
    async () => {
        await trouble("mute=1");
        await shown("quiet");
        assert.match(await words(), /killed/);
        await trouble("");
        await well();
        await trouble("empty=1");
        await shown("no-simulators");
        await trouble("");
        await well();
    },
    MOCK_ONLY,
);

bench.test(
    "a page that was dropped for slowness comes back and reads why",
    async (page) => {
        await trouble("drop=slow");
        await until("the notice", () => page.locator(".notice.bad", { hasText: "too slow" }).isVisible());
        assert.match((await page.locator(".notice.bad").last().textContent()) ?? "", /quality=low/);
        await well();
    },
    MOCK_ONLY,
);

bench.test(
    "a refused page, a full run, an ended run and another version are told apart",
    async (page) => {
        await trouble("refuse=403&drop=broken");
        await shown("refused");
        assert.match(await words(), /token.*address that the run printed/);
        await trouble("refuse=503");
        await page.evaluate(() => window.roboss.run.retryNow());
        await shown("full");
        await trouble("");
        await page.evaluate(() => window.roboss.run.retryNow());
        await well();
        await trouble("over=its duration was over at 10.000 s&refuse=503");
        await until("it has ended", async () => (await words()).includes("duration was over"));
        await trouble("");
        await page.evaluate(() => window.roboss.run.retryNow());
        await well();
        await trouble("version=2&drop=broken");
        await shown("version");
        await trouble("drop=broken");
        await well();
    },
    MOCK_ONLY,
);

bench.test(
    "the page says that a request ended the run, and that a killed run took no leave",
    async (page) => {
        await page.evaluate(() => window.roboss.run.control("quit"));
        await shown("ended");
        assert.match(await words(), /a request ended it/);
        const { port } = bench.run;
        await bench.run.stop();
        bench.run = await startRun({ port });
        await well();
        await bench.run.stop("SIGKILL");
        await shown("gone");
        assert.match(await words(), /killed/);
    },
    REAL_ONLY,
);

bench.test(
    "a page that finds no run says where it looked",
    async () => {
        const run = await startRun({ cars: 4 }),
            { page } = await openPage(bench.browser, run);
        await page.route(/\/scene|\/ws/, (route) => route.abort());
        await page.routeWebSocket(/\/ws/, (socket) => socket.close());
        await page.reload();
        await until("nobody", () => page.locator('.banner[data-kind="nobody"]').isVisible(), WAIT_MS);
        assert.match((await page.locator(".banner").textContent()) ?? "", new RegExp(`at 127.0.0.1:${run.port}`));
        await page.context().close();
        await run.stop();
    },
    MOCK_ONLY,
);
