// The scene tree's rows, what is hidden and locked, the selection, and the undo stack.
import assert from "node:assert/strict";
import { test } from "node:test";
import { allIn, modelOf, sceneryModels, treeRows } from "../src/model/scene_tree";
import { Selection } from "../src/model/selection";
import { linkKey, robotKey, sceneryKey, Sight } from "../src/model/sight";
import { type Step, UndoStack } from "../src/model/undo";
import { ViewerState } from "../src/model/viewer_state";
import type { SceneInfo, Visual } from "../src/wire/messages";

const shape = (name: string): Visual => ({ name, shape: "box", frame: [0, 0, 0, 1, 0, 0, 0], size: [1, 1, 1] });

function scene(robots: number): SceneInfo {
    const link = (name: string) => ({ name, body: 0, frame: shape("").frame, visuals: [], collisions: [] });
    const type = (name: string, like: number) => ({
        name,
        like,
        links: [link("base"), link("arm")],
        joints: [{ name: "hinge" }],
        sensors: [],
    });
    return {
        world: "w",
        types: [type("car", 0), type("tree", 1)],
        robots: Array.from({ length: robots }, (_, k) => ({ name: `car_${k}`, type: k % 2 })),
        statics: ["wall::link::a", "wall::link::b", "a::post::link::c"].map(shape),
    } as unknown as SceneInfo;
}

const none: ReadonlySet<string> = new Set<string>();
const keys = (rows: { key: string }[]) => rows.map((row) => row.key);

test("robots stand under their types, scenery by its models; what is folded makes no rows", () => {
    const rows = treeRows(scene(4), "", none, none);
    assert.deepEqual(keys(rows), [
        "robots",
        "type:car",
        "robot:car_0",
        "robot:car_2",
        "type:tree",
        "robot:car_1",
        "robot:car_3",
        "scenery",
        "scenery:wall",
        "scenery:a::post",
    ]);
    assert.deepEqual(keys(treeRows(scene(4), "", new Set(["robots", "scenery"]), none)), ["robots", "scenery"]);
    const open = treeRows(scene(1), "", none, new Set(["robot:car_0"]));
    assert.deepEqual(
        open.slice(2, 5).map(({ kind, text, level }) => [kind, text, level]),
        [
            ["link", "base", 3],
            ["link", "arm", 3],
            ["joint", "hinge", 3],
        ],
    );
});

test("a type that is called after a robot is headed by what the names of its own robots share", () => {
    const teams = scene(6);
    teams.types = teams.types.map((type) => ({ ...type, name: "blue_0" }));
    teams.types[1].links = [];
    teams.robots = ["blue_0", "blue_1", "yellow_0", "yellow_1"].map((name, k) => ({ name, type: k < 2 ? 0 : 1 }));
    const headings = treeRows(teams, "", none, none).filter((row) => row.kind === "type");
    assert.deepEqual(
        headings.map(({ text }) => text),
        ["blue", "yellow"],
    );
});

test("robots that move alike are one type, whatever their parts, topics and colours are called", () => {
    const swarm = scene(0),
        drone = swarm.types[0];
    swarm.types = [1, 2, 3].map((k) => ({
        ...drone,
        name: `X${k}`,
        joints: [{ ...drone.joints[0], name: `X${k}_hinge` }],
    }));
    swarm.types.push({ ...drone, name: "X4", like: 7 }, { ...drone, name: "rover" });
    swarm.robots = [0, 1, 2, 3, 3, 4, 4].map((type, k) => ({ name: type < 4 ? `X${k + 1}` : `rover_${k}`, type }));
    const headings = treeRows(swarm, "", none, none).filter((row) => row.kind === "type");
    assert.deepEqual(
        headings.map(({ text, count }) => [text, count]),
        [
            ["X", 3],
            ["X", 2],
            ["rover", 2],
        ],
    );
});

test("a search finds robots and scenery by a part of their names, in folded branches, too", () => {
    const found = treeRows(scene(40), "car_3", new Set(["robots", "type:car"]), none).filter(
        (row) => row.kind === "robot",
    );
    assert.equal(found.length, 11);
    assert.deepEqual(keys(treeRows(scene(4), "wal", none, none)), ["scenery", "scenery:wall"]);
});

test("lights are listed where the scene has some", () => {
    const lit = { ...scene(0), look: { lights: [{ name: "sun" }] } } as unknown as SceneInfo;
    assert.deepEqual(keys(treeRows(lit, "", none, none)).slice(-2), ["lights", "light:sun"]);
});

test("shapes of the scenery belong to the model before link and shape", () => {
    assert.equal(modelOf("house::room::link::wall"), "house::room");
    assert.equal(modelOf("ground"), "ground");
    assert.deepEqual(sceneryModels(scene(0)).get("wall"), [0, 1]);
});

test("ten thousand robots make rows in a moment", () => {
    const large = scene(10_000),
        from = process.cpuUsage().user;
    assert.equal(treeRows(large, "", none, none).filter((row) => row.kind === "robot").length, 10_000);
    assert.ok(process.cpuUsage().user - from < 2_000_000, "two seconds of CPU time");
});

test("what is hidden and locked is kept for each world, and rubbish is ignored", () => {
    const kept = new Map<string, string>();
    const store = {
        getItem: (key: string) => kept.get(key) ?? null,
        setItem: (key: string, value: string) => void kept.set(key, value),
        removeItem: (key: string) => void kept.delete(key),
    };
    const sight = new Sight(store);
    sight.begin("city");
    sight.hide([robotKey("car"), linkKey("arm", "a/b")], true);
    sight.lock([sceneryKey("wall")], true);
    sight.begin("other");
    assert.equal(sight.hidden.value.size, 0);
    const again = new Sight(store);
    again.begin("city");
    assert.deepEqual([...again.hidden.value], [robotKey("car"), linkKey("arm", "a/b")]);
    assert.deepEqual([...again.locked.value], [sceneryKey("wall")]);
    again.hide([...again.hidden.value], false);
    again.lock([...again.locked.value], false);
    assert.equal(kept.size, 0, "nothing is kept of nothing");
    kept.set("roboss.sight.bad", '{"hidden": 7');
    again.begin("bad");
    assert.equal(again.hidden.value.size, 0);
    const row = treeRows(scene(2), "", none, none)[0];
    assert.ok(allIn(row, new Set(["robot:car_0", "robot:car_1"])) && !allIn(row, new Set(["robot:car_0"])));
});

test("one robot of those selected is the primary one, and choosing one alone deselects the others", () => {
    const state = new ViewerState(),
        selection = new Selection(state);
    selection.only(3);
    selection.toggle(5);
    assert.deepEqual([state.selected.value, state.others.value], [5, [3]]);
    selection.add([3, 7]);
    assert.deepEqual(selection.robots, [5, 3, 7]);
    selection.toggle(5);
    assert.deepEqual(selection.robots, [3, 7]);
    state.selected.set(9);
    assert.deepEqual(selection.robots, [9]);
    selection.scenery("wall");
    assert.deepEqual([selection.robots, state.scenery.value], [[], "wall"]);
    selection.set([1, 2]);
    assert.equal(state.scenery.value, null);
});

test("steps are taken back and done again in order; a new step forgets what was taken back", async () => {
    const stack = new UndoStack(),
        log: string[] = [];
    const step = (name: string, works = true): Step => ({
        name,
        undo: () => Promise.resolve(log.push(`undo ${name}`) > 0 && works),
        redo: () => Promise.resolve(log.push(`redo ${name}`) > 0),
    });
    stack.push(step("a"));
    stack.push(step("b"));
    assert.equal(await stack.undo(), "b");
    assert.deepEqual(stack.next.value, { undo: "a", redo: "b" });
    assert.equal(await stack.redo(), "b");
    assert.equal(await stack.undo(), "b");
    stack.push(step("c", false));
    assert.equal(stack.next.value.redo, "");
    assert.equal(await stack.undo(), null, "it was refused");
    assert.equal(await stack.undo(), "a", "and is gone");
    assert.equal(await stack.undo(), null);
    assert.deepEqual(log, ["undo b", "redo b", "undo b", "undo c", "undo a"]);
});

test("a type is called after its robots, and copies stand among them", () => {
    const world = scene(4);
    world.types.forEach((type, k) => (type.name = k === 0 ? "car_0" : "tree"));
    world.types.push({ ...world.types[0], name: "car_4" });
    world.robots.push({ name: "car_4", type: 2 });
    const rows = treeRows(world, "", none, none);
    assert.deepEqual(
        rows.slice(1, 5).map(({ text }) => text),
        ["car", "car_0", "car_2", "car_4"],
    );
});
