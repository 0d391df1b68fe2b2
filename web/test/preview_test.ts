import assert from "node:assert/strict";
import { test } from "node:test";
import { Preview } from "../src/model/preview";
import { ViewerState, World } from "../src/model/viewer_state";
import type { Answer } from "../src/wire/messages";
import type { PreviewInfo } from "../src/wire/timeline";
import { body, sceneOf, stateBytes, typeOf } from "./support";

const FLAG_PREVIEW = 4;

/** A gateway that answers when it is told to. */
class Desk {
    readonly asked: string[] = [];
    private settle: ((answer: Answer) => void) | null = null;

    preview(moment: string): Promise<Answer> {
        this.asked.push(moment);
        return new Promise((resolve) => (this.settle = resolve));
    }

    async answer(answer: Partial<Answer>): Promise<void> {
        this.settle?.({ type: "answer", id: 1, done: true, text: "", ...answer });
        await new Promise((resolve) => setTimeout(resolve));
    }
}

function bench() {
    const state = new ViewerState(),
        desk = new Desk(),
        refusals: string[] = [];
    state.link.set({ state: "open", probe: null });
    const preview = new Preview(state, desk, (text) => refusals.push(text));
    const scene = sceneOf([typeOf([body("free", -1, 0)], [])], [0, 0]),
        world = new World({ scene, meshes: new Map(), unreadable: 0 } as never);
    return { state, desk, refusals, preview, world };
}

function info(time_s: number, exact = true): PreviewInfo {
    return { branch: 1, tick: time_s / 0.002, time_s, exact, gone: 0, absent: 1 };
}

test("of moments that are wanted while one is under way only the newest is asked for", async () => {
    const { desk, preview } = bench();
    preview.show({ branch: 0, time: 1 }, true);
    preview.show({ branch: 0, time: 2 }, true);
    preview.show({ branch: 2, time: 3 }, true);
    assert.deepEqual(desk.asked, ["1.000000000"]);
    await desk.answer({ preview: info(1) });
    assert.deepEqual(desk.asked, ["1.000000000", "#2@3.000000000"]);
    await desk.answer({ preview: info(3) });
    assert.equal(desk.asked.length, 2, "the exact moment is not asked for again");
});

test("a moment that was not reached yet is asked for again", async () => {
    const { desk, preview } = bench();
    preview.show({ branch: 0, time: 2 }, true);
    await desk.answer({ preview: info(1.4, false) });
    assert.equal(desk.asked.length, 2);
    await desk.answer({ preview: info(2) });
    assert.equal(desk.asked.length, 2);
});

test("robots that the moment does not have are hidden, and leaving shows the present", async () => {
    const { state, desk, preview, world } = bench();
    preview.show({ branch: 0, time: 2 }, true);
    preview.heard(info(2));
    const entry = { robot: 1, place: [3, 0, 0], turn: [1, 0, 0, 0], coordinates: [] } as never;
    preview.take(stateBytes(2, [entry], FLAG_PREVIEW), world);
    await desk.answer({ preview: info(2) });
    assert.deepEqual([...(state.shown.value?.hidden ?? [])], [1, 0]);
    assert.equal(state.shown.value?.snapshot.base[7], 3);
    preview.leave();
    assert.equal(state.shown.value, null);
    preview.take(stateBytes(2, [entry], FLAG_PREVIEW), world);
    assert.equal(state.shown.value, null, "one that comes late shows nothing");
});

test("a refusal is told, and the present is shown", async () => {
    const { desk, preview, refusals } = bench();
    preview.show({ branch: 0, time: 2 }, true);
    await desk.answer({ done: false, text: "the run has no journal", code: "no-journal" });
    assert.deepEqual(refusals, ["the run has no journal"]);
    assert.equal(preview.wanted.value, null);
});
