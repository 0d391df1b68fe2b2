import assert from "node:assert/strict";
import { test } from "node:test";
import { fuzzyBest, fuzzyScore } from "../src/model/fuzzy";

const names = ["car_1", "car_12", "Whole world", "Look at the selected robot", "Colour by Simulator", "Laser rays"];
const best = (query: string) => fuzzyBest(query, names, (name) => name, 10);

test("letters in order are found, the best place first", () => {
    assert.equal(best("car_1")[0], "car_1");
    assert.deepEqual(best("c12"), ["car_12"]);
    assert.equal(best("whole")[0], "Whole world");
    assert.equal(best("lr")[0], "Laser rays");
    assert.deepEqual(best("xyz"), []);
});

test("words come in any order, in any case", () => {
    assert.equal(best("simulator colour")[0], "Colour by Simulator");
    assert.equal(best("ROBOT look")[0], "Look at the selected robot");
});

test("an empty query leaves all in their order", () => {
    assert.deepEqual(best("  "), names);
    assert.equal(fuzzyScore("", "abc") !== null, true);
});
