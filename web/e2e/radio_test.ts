// Radio links in the picture, with the real program and its relay of beacons (examples/radio).
import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import type { InstancedMesh, Object3D } from "three";
import type { Page } from "playwright-core";
import { Bench, PROGRAM, until } from "./bench";

const skip = PROGRAM === "" ? "the mock has no radios" : false;
const relay = join(dirname(PROGRAM), "../lib/roboss_relay.so");
const bench = new Bench(
    { world: "radio.sdf", single: true, more: ["--client", relay], query: "?show=radio,names" },
    skip,
);

/** Bars of the picture that lie above the ground from one rover to another. */
function bars(page: Page): Promise<number> {
    return page.evaluate(() => {
        let count = 0;
        window.roboss.stage.overlays.traverse((one: Object3D) => {
            if (one.name === "radio bars" && one.parent?.visible) count += (one as InstancedMesh).count;
        });
        return count;
    });
}

bench.test("links appear while rovers hear each other, and go when the overlay is switched off", async (page) => {
    await until("links", async () => (await bars(page)) > 0);
    const heard = await page.evaluate(
        () =>
            new Promise<{ from: number; to: number; strength: number | null; margin: number | null }>((resolve) => {
                window.roboss.state.overlayReport.follow((report) => {
                    const link = report?.radio?.links[0];
                    if (link !== undefined) resolve(link);
                });
            }),
    );
    assert.ok(heard.from !== heard.to);
    assert.ok(heard.strength !== null && heard.strength < 0 && heard.strength > -120, `${heard.strength} dBm`);
    assert.ok(heard.margin !== null && heard.margin > 0, `${heard.margin} dB above the noise floor`);
    await page.evaluate(() => window.roboss.state.toggle("radio", false));
    await until("none", async () => (await bars(page)) === 0);
});
