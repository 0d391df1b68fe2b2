import assert from "node:assert/strict";
import { test } from "node:test";
import { droppedWords, QUIET_S, type RunFacts, wordsOf } from "../src/model/run_state";

const well: RunFacts = {
    link: "open",
    probe: null,
    seen: true,
    over: null,
    world: true,
    versions: { page: 1, run: 1 },
    simulators: 3,
    quiet_s: 0.4,
    host: "127.0.0.1:8090",
};
const ended = (reason: string) => ({ reason, failed: false });
const kind = (facts: Partial<RunFacts>) => wordsOf({ ...well, ...facts })?.kind ?? null;

test("nothing is said while all is well, and while an ordinary start connects", () => {
    assert.equal(kind({}), null);
    assert.equal(kind({ link: "connecting", seen: false, world: false, simulators: null }), null);
});

test("an open connection: ended, no world, no Simulators, no news", () => {
    assert.equal(kind({ over: ended("a request ended it") }), "ended");
    assert.equal(kind({ world: false, quiet_s: 3 }), "no-world");
    assert.equal(kind({ world: false, quiet_s: 1 }), null);
    assert.equal(kind({ simulators: 0 }), "no-simulators");
    assert.equal(kind({ quiet_s: QUIET_S }), "quiet");
});

test("a failed run says what went wrong, and the remedy of the program", () => {
    const over = {
            reason: "robot 'car' has no finite state at 3 s [not-finite]\n  remedy: a shorter step",
            failed: true,
        },
        words = wordsOf({ ...well, over });
    assert.equal(words?.kind, "failed");
    assert.equal(words?.text, "The run has failed: robot 'car' has no finite state at 3 s [not-finite].");
    assert.match(words?.remedy ?? "", /^Remedy: a shorter step\. The picture shows its last moment\./);
    assert.equal(kind({ link: "gone", over }), "failed");
});

test("no connection: refused, full, ended, gone, nobody there", () => {
    const lost = { link: "gone" as const };
    assert.equal(kind({ ...lost, probe: { kind: "refused", text: "no token" } }), "refused");
    assert.equal(kind({ ...lost, probe: { kind: "full", text: "" } }), "full");
    assert.equal(kind({ ...lost, over: ended("its duration was over at 10 s") }), "ended");
    assert.equal(kind(lost), "gone");
    assert.equal(kind({ ...lost, seen: false, probe: { kind: "unreachable", text: "" } }), "nobody");
    assert.equal(kind({ ...lost, seen: false, probe: { kind: "reached", text: "" } }), "connecting");
});

test("another version is said first, whatever else is so", () => {
    assert.equal(kind({ versions: { page: 1, run: 2 }, over: ended("x") }), "version");
    assert.equal(wordsOf({ ...well, versions: { page: 1, run: 2 } })?.button, "Reload");
});

test("every state comes with a remedy, in whole sentences", () => {
    const states: Partial<RunFacts>[] = [
        { over: { reason: "it fell apart", failed: true } },
        { world: false, quiet_s: 9 },
        { simulators: 0 },
        { quiet_s: 60 },
        { link: "gone" },
        { link: "gone", probe: { kind: "full", text: "" } },
        { link: "gone", probe: { kind: "refused", text: "why" } },
        { link: "gone", seen: false, probe: { kind: "unreachable", text: "" } },
    ];
    for (const facts of states) {
        const words = wordsOf({ ...well, ...facts });
        assert.match(words?.text ?? "", /[.…]$/);
        assert.match(words?.remedy ?? "", /\.$/);
    }
});

test("a page that was too slow reads what it can do; others read the reason", () => {
    assert.match(droppedWords({ why: "it does not read its replies", code: "slow" }), /too slow.*quality=low/);
    assert.match(droppedWords({ why: "too many messages", code: "flood" }), /too many messages\.$/);
});
