import assert from "node:assert/strict";
import { test } from "node:test";
import { emptyWords, solverFacts, stageRows } from "../src/model/step_shares";
import type { StepProfile } from "../src/wire/profile";

const profile: StepProfile = {
    type: "profile",
    ticks: 500,
    stages: [
        { name: "orders", seconds: 0 },
        { name: "narrow phase", seconds: 0.025 },
        { name: "solve velocities", seconds: 0.075 },
    ],
    largest_island_robots: 40,
    most_contacts: 312,
    largest_part_robots: 30,
    iterations_per_island_mean: 3.25,
    iterations_per_island_most: 17,
    residual_worst: 2.5e-9,
    friction_solves: 1000,
    friction_missed_share: 0.02,
    friction_error_worst: 0.015,
};

test("stages have shares of all stages and times per tick, those without time are left out", () => {
    const rows = stageRows(profile),
        near = (value: number, expected: number) => assert.ok(Math.abs(value - expected) < 1e-9, `${value}`);
    assert.deepEqual(
        rows.map((row) => row.name),
        ["narrow phase", "solve velocities"],
    );
    near(rows[0].share, 0.25);
    near(rows[1].share, 0.75);
    near(rows[0].us, 50);
    near(rows[1].us, 150);
});

test("what was not measured has no rows and says why", () => {
    assert.deepEqual(stageRows({ type: "profile", ticks: 0 }), []);
    assert.deepEqual(stageRows({ ...profile, ticks: 0 }), []);
    assert.match(emptyWords(null), /Measuring/);
    assert.match(emptyWords({ type: "profile", ticks: 0 }), /Measuring/);
    assert.equal(
        emptyWords({ type: "profile", ticks: 0, why: "a program steps this world" }),
        "a program steps this world",
    );
    assert.equal(emptyWords(profile), "");
});

test("the solver's figures are words", () => {
    const facts = solverFacts(profile);
    assert.equal(facts["Largest island"], "40 robots");
    assert.equal(facts["Most contacts"], "312");
    assert.equal(facts["Solved together"], "30 robots");
    assert.equal(facts.Iterations, "3.3 mean, 17 most");
    assert.equal(facts.Residual, "2.5e-9");
    assert.equal(facts["Friction off by"], "1.5e-2");
    assert.equal(facts["Friction missed"], "2 %");
    assert.equal(facts["A tick"], "200 µs");
    const alone = solverFacts({ ...profile, largest_island_robots: 1, most_contacts: 0, residual_worst: null });
    assert.equal(alone["Largest island"], "1 robot");
    assert.equal(alone.Residual, "–", "not a number");
});
