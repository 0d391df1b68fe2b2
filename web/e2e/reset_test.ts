// Reset, with the program: to the last save, and to the beginning.
import assert from "node:assert/strict";
import { Bench, notice, paused, PROGRAM, settled, time, until } from "./bench";

const skip = PROGRAM === "" ? "the mock has no beginning to return to" : false;
const bench = new Bench({ world: "../web/e2e/acting.sdf", port: 8330, single: true }, skip);

bench.test("the run returns to its last save, and is started over", async (page) => {
    const reset = async (to: string) => {
        await page.getByLabel(/^Reset: /).click();
        await page.getByRole("dialog").getByRole("button", { name: to }).click();
    };
    await reset("To the last save");
    await until("a refusal", async () => (await notice(page)).includes("nothing has been saved"));
    const hash = () => page.evaluate(() => window.roboss.state.status.value?.state_hash);
    const rests = () => settled("it stands", async () => ((await paused(page)) ? hash() : undefined));
    await page.evaluate(() => window.roboss.run.control("pause"));
    const saved = await rests();
    const answer = await page.evaluate(() => window.roboss.run.control("save", `reset-${Date.now()}.roboss`));
    assert.ok(answer.done, answer.text);
    await page.evaluate(() => window.roboss.run.control("step", "500"));
    await until("later", async () => (await hash()) !== saved);
    await rests();
    await reset("To the last save");
    await until("the state that was saved", async () => (await hash()) === saved);
    await page.evaluate(() => window.roboss.run.control("resume"));
    await until("some time to go back over", async () => (await time(page)) > 4);
    await reset("To the beginning");
    await until("an early time", async () => (await time(page)) < 4);
    const then = await time(page);
    await until("time that passes", async () => (await time(page)) > then + 0.3);
});

bench.endsWithCleanConsole();
