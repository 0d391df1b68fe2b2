// Undo and redo keep the selection: what was selected before the step comes back, and what a person selected since stays.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Editing } from "../src/model/editing";
import type { Placing } from "../src/model/placing";
import type { RunLink } from "../src/model/run_link";
import { Selection } from "../src/model/selection";
import { ViewerState, World } from "../src/model/viewer_state";
import { IDENTITY, sceneOf, typeOf } from "./support";

Object.assign(globalThis, { window: { localStorage: null } });

/** A run of boxes that removes, restores and copies at once. */
function desk() {
    const state = new ViewerState(),
        selection = new Selection(state),
        show = (names: readonly string[]) => {
            const scene = { ...sceneOf([typeOf([], [])], []), robots: names.map((name) => ({ name, type: 0 })) },
                chosen = selection.robots.map((robot) => state.world.value?.fleet.name(robot) ?? "");
            // As RunLink.load() does: robots have other numbers now.
            state.selected.set(null);
            state.world.set(new World({ scene } as unknown as World["loaded"]));
            const found = chosen.map((name) => state.world.value?.fleet.find(name)).filter((one) => one !== undefined);
            state.selected.set(found[0] ?? null);
            state.others.set(found.slice(1));
        },
        names = () => state.world.value?.fleet.scene.robots.map(({ name }) => name) ?? [];
    const control = (verb: string, ...words: string[]) => {
        const copies = words.filter((_, k) => k % 3 === 1),
            left = names().filter((name) => !words.includes(name));
        const next = verb === "remove" ? left : [...names(), ...(verb === "copy" ? copies : words)];
        queueMicrotask(() => show(next));
        return Promise.resolve({ done: true, text: "" });
    };
    const run = { control, notice: { set: () => undefined } } as unknown as RunLink,
        placing = { frame: () => IDENTITY } as unknown as Placing,
        editing = new Editing(state, run, selection, placing);
    show(["a", "b", "c", "d"]);
    const select = (...wanted: string[]) =>
        selection.set(wanted.map((name) => state.world.value?.fleet.find(name) ?? -1));
    const selected = () => selection.robots.map((robot) => state.world.value?.fleet.name(robot)).join(" ");
    return { editing, select, selected, names };
}

test("robots that come back are selected again, the primary one first, and removed again they are not", async () => {
    const { editing, select, selected, names } = desk();
    select("c", "a");
    await editing.remove();
    assert.equal(selected(), "");
    await editing.undo.undo();
    assert.equal(names().join(" "), "b d c a");
    assert.equal(selected(), "c a");
    await editing.undo.redo();
    assert.equal(selected(), "");
});

test("a copy that is taken back leaves its original selected", async () => {
    const { editing, select, selected } = desk();
    select("b");
    await editing.duplicate();
    assert.equal(selected(), "b_1");
    await editing.undo.undo();
    assert.equal(selected(), "b");
    await editing.undo.redo();
    assert.equal(selected(), "b_1");
});

test("what was selected since the step stays selected", async () => {
    const { editing, select, selected } = desk();
    select("a");
    await editing.remove();
    select("d", "b");
    await editing.undo.undo();
    assert.equal(selected(), "d b");
    await editing.undo.redo();
    assert.equal(selected(), "d b");
});
