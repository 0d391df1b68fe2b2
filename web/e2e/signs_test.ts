// What the page says at a glance is so: views differ, colours and buttons tell the state of the run, equal times are as long,
// and a run that failed says why. With the mock gateway.
import assert from "node:assert/strict";
import { Bench, fewPixels, openPage, PROGRAM, until } from "./bench";

const skip = PROGRAM === "" ? false : "the mock gateway shows it, too";
const bench = new Bench({ cars: 24 }, skip);
const trouble = (words: string) => fetch(new URL(`/mock/trouble?${words}`, bench.run.url)).then((one) => one.text());

bench.test("four views are four different views, from wherever one begins", async () => {
    // A run that stands is drawn seldom: two pages that draw at once in software starve each other.
    await bench.page.evaluate(() => window.roboss.run.control("pause"));
    await fewPixels(bench.page);
    const { page } = await openPage(bench.browser, bench.run, "views=4");
    await fewPixels(page);
    const differ = async (told: string) => {
        const views = await page.evaluate(() =>
            window.roboss.views.shown.map(({ rig: { goal }, mode, robot }) => {
                const flat = Math.cos(goal.elevation),
                    way = [flat * Math.cos(goal.azimuth), flat * Math.sin(goal.azimuth), Math.sin(goal.elevation)];
                return { way, mode, robot };
            }),
        );
        assert.equal(views.length, 4, told);
        views.forEach((a, k) =>
            views.slice(k + 1).forEach((b, j) => {
                const angle = Math.acos(
                    Math.min(
                        1,
                        a.way.reduce((sum, value, c) => sum + value * b.way[c], 0),
                    ),
                );
                assert.ok(angle > 0.3, `${told}: views ${k + 1} and ${k + j + 2} look the same way`);
            }),
        );
    };
    await differ("the address names no cameras");
    const split = (count: 1 | 2 | 4) => page.evaluate((n) => window.roboss.director.split(n), count);
    await split(1);
    await split(4);
    await differ("from the whole world");
    await split(2);
    await split(4);
    await differ("from two");
    await split(1);
    await page.evaluate(() => window.roboss.director.view("top"));
    await split(4);
    await differ("from the top");
    for (const mode of ["follow", "chase"] as const) {
        await split(1);
        await page.evaluate((how) => {
            window.roboss.director.followRobot(5);
            window.roboss.state.cameraMode.set(how);
        }, mode);
        await split(4);
        await differ(mode);
        const robots = await page.evaluate(() => window.roboss.views.shown.map(({ robot }) => robot));
        assert.deepEqual(robots, [5, 5, 5, 5], "all stay with the robot");
    }
    await page.context().close();
    await bench.page.evaluate(() => window.roboss.run.control("resume"));
});

bench.test("a run below real time is said in amber, slow motion that was asked for is not", async (page) => {
    const colour = (rtf: number, speed: string, paused = false) =>
        page.evaluate(
            ([factor, asked, rests]) => {
                const { status } = window.roboss.state,
                    output = document.querySelector(".rtf") as HTMLElement,
                    probe = document.createElement("i");
                document.body.append(probe);
                if (status.value !== null) status.set({ ...status.value, rtf: factor, speed: asked, paused: rests });
                const names = ["good", "warn"].filter((name) => {
                    probe.style.color = `var(--${name})`;
                    return getComputedStyle(probe).color === getComputedStyle(output).color;
                });
                probe.remove();
                return names.join();
            },
            [rtf, speed, paused] as const,
        );
    assert.equal(await colour(1.0, "1"), "good");
    assert.equal(await colour(0.97, "1"), "good");
    assert.equal(await colour(0.67, "1"), "warn");
    assert.equal(await colour(0.67, "max"), "warn");
    assert.equal(await colour(0.5, "0.5"), "good");
    assert.equal(await colour(0.3, "0.5"), "warn");
    assert.equal(await colour(1.6, "2"), "good");
    assert.equal(await colour(0, "1", true), "warn");
});

bench.test("Kill is offered only where the run can kill", async (page) => {
    await page.getByRole("tab", { name: "Cluster" }).dispatchEvent("click");
    const kill = page.getByRole("button", { name: /^Kill Simulator/ });
    await until("three", async () => (await kill.count()) === 3);
    await trouble("foreign=1");
    await until("none", async () => (await kill.count()) === 0);
    await page.getByText("start it with --processes").waitFor();
    await trouble("");
    await until("three again", async () => (await kill.count()) === 3);
    await page.getByRole("tab", { name: "Robot" }).dispatchEvent("click");
});

bench.test("equal times are as long on the tracks of all branches, and lie below each other", async (page) => {
    await page.keyboard.press("k");
    const ends = await page.evaluate(() => {
        const { state } = window.roboss,
            branch = (id: number, first: number, end: number) => ({
                id,
                parent: id - 1,
                begin_s: first,
                first_s: first,
                end_s: end,
                reason: "",
            }),
            status = state.status.value;
        if (status === null) return [];
        const now = { ...status, time_s: 60, journal: { first_s: 0, last_s: 60 } } as typeof status;
        state.timeline.set({
            type: "timeline",
            serial: 99,
            branch: 4,
            branches: [branch(1, 0, 60), branch(2, 20, 24), branch(3, 24, 28), branch(4, 50, 60)],
            bookmarks: [],
        });
        state.status.set(now);
        return [...document.querySelectorAll(".branch .track")].map((track) => {
            const { left, right } = track.getBoundingClientRect();
            return [left, right];
        });
    });
    await page.keyboard.press("k");
    const THUMB = 13,
        length = ends.map(([left, right]) => right - left - THUMB),
        scale = length[0] / 60;
    assert.equal(ends.length, 4);
    assert.ok(scale > 5, `${scale} pixels a second`);
    [60, 4, 4, 10].forEach((seconds, k) =>
        assert.ok(Math.abs(length[k] - seconds * scale) < 1, `branch ${k + 1}: ${length[k]} px for ${seconds} s`),
    );
    [0, 20, 24, 50].forEach((first, k) =>
        assert.ok(Math.abs(ends[k][0] - ends[0][0] - first * scale) < 1, `branch ${k + 1} begins elsewhere`),
    );
});

bench.test("the timeline keeps its length whatever the clocks say", async (page) => {
    const widths = await page.evaluate(() => {
        const { status } = window.roboss.state,
            is = status.value;
        if (is === null) return [];
        return [
            { paused: true },
            { paused: false, rtf: 0.98 },
            { paused: false, rtf: 11.4 },
            { paused: false, rtf: 0.98, tick: 1e6 },
        ].map((change) => {
            status.set({ ...is, ...change });
            return (document.querySelector(".timeline") as HTMLElement).getBoundingClientRect().width;
        });
    });
    assert.equal(new Set(widths).size, 1, widths.join(", "));
});

bench.test("a run that failed says why, and what helps", async (page) => {
    const why = "robot 'dust' has no finite state at tick 50 [not-finite]%0A  remedy: a shorter step";
    await trouble(`over=${why}&failed=1&refuse=503`);
    const banner = page.locator('.banner[data-kind="failed"]');
    await banner.waitFor();
    const text = (await banner.textContent()) ?? "";
    for (const word of ["The run has failed", "'dust'", "tick 50", "Remedy: a shorter step"])
        assert.ok(text.includes(word), text);
    await trouble("");
    await page.evaluate(() => window.roboss.run.retryNow());
    await until("well again", async () => !(await banner.isVisible()));
});

bench.endsWithCleanConsole();
