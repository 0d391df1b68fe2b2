import assert from "node:assert/strict";
import { test } from "node:test";
import { beginsWords, fuzzyBest, fuzzyScore } from "../src/model/fuzzy";

const names = ["car_1", "car_12", "Whole world", "Look at the selected robot", "Colour by Simulator", "Laser rays"];
const best = (query: string) => fuzzyBest(query, names, (name) => name, 10);

test("letters together or at beginnings of words are found, the best place first", () => {
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

test("the beginning of a word comes before its inside, and scattered letters find nothing", () => {
    assert.deepEqual(fuzzyBest("mov", ["Remove it", "Move it"], String, 9), ["Move it", "Remove it"]);
    assert.deepEqual(fuzzyBest("rew", ["Rain everywhere", "Four wide", "Rewind: look"], String, 9), ["Rewind: look"]);
    assert.equal(fuzzyScore("clr", "Colour by speed"), null);
    assert.equal(beginsWords("re w", "Remove what is selected"), true);
    assert.equal(beginsWords("move", "Remove what is selected"), false);
});

test("an empty query leaves all in their order", () => {
    assert.deepEqual(best("  "), names);
    assert.equal(fuzzyScore("", "abc") !== null, true);
});
