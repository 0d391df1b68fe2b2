import assert from "node:assert/strict";
import { test } from "node:test";
import { Actions, keyText, pressed } from "../src/model/actions";

const press = (key: string, more: { ctrlKey?: boolean; metaKey?: boolean; shiftKey?: boolean } = {}) =>
    pressed({ key, ctrlKey: false, metaKey: false, shiftKey: false, ...more });
const nothing = () => undefined;

test("a key press is named by its character, with Ctrl or Cmd before it", () => {
    assert.equal(press("k"), "k");
    assert.equal(press("K", { shiftKey: true }), "k");
    assert.equal(press("?", { shiftKey: true }), "?");
    assert.equal(press("k", { ctrlKey: true }), "mod+k");
    assert.equal(press("k", { metaKey: true }), "mod+k");
    assert.equal(press("Z", { ctrlKey: true, shiftKey: true }), "mod+shift+z");
    assert.equal(press("ArrowLeft", { shiftKey: true }), "shift+arrowleft");
    assert.deepEqual([" ", "Mod+K", "Mod+Shift+Z"].map(keyText), ["Space", "Ctrl K", "Ctrl Shift Z"]);
});

test("an id and a key belong to one action", () => {
    const actions = new Actions();
    actions.add({ id: "a", title: "A", group: "G", keys: ["K"], run: nothing });
    assert.throws(() => actions.add({ id: "a", title: "B", group: "G", run: nothing }), /exists already/);
    assert.throws(() => actions.add({ id: "b", title: "B", group: "G", keys: ["k"], run: nothing }), /taken/);
    assert.equal(actions.all().length, 1);
});

test("what a source makes is found, and made anew each time", () => {
    const actions = new Actions();
    let robots = ["car_1"];
    actions.addSource(() => robots.map((name) => ({ id: name, title: name, group: "Robots", run: nothing })));
    assert.deepEqual(
        actions.found().map((one) => one.title),
        ["car_1"],
    );
    robots = ["car_2", "car_3"];
    assert.deepEqual(
        actions.found().map((one) => one.title),
        ["car_2", "car_3"],
    );
    assert.equal(actions.all().length, 0);
});
