import assert from "node:assert/strict";
import { test } from "node:test";
import { keep, kept } from "../src/model/kept";

function inBrowserThat(storage: () => unknown, then: () => void): void {
    Object.defineProperty(globalThis, "window", {
        configurable: true,
        value: Object.defineProperty({}, "localStorage", { get: storage }),
    });
    then();
}

test("a page in a frame of another site, where the browser refuses to keep anything, goes on", () => {
    inBrowserThat(
        () => {
            throw new DOMException("denied", "SecurityError");
        },
        () => {
            assert.equal(kept("roboss.theme"), null);
            assert.equal(keep("roboss.theme", "dark"), false);
        },
    );
});

test("what is kept is there again", () => {
    const values = new Map<string, string>();
    const storage = {
        getItem: (name: string) => values.get(name) ?? null,
        setItem: (name: string, value: string) => values.set(name, value),
    };
    inBrowserThat(
        () => storage,
        () => {
            assert.equal(kept("roboss.theme"), null);
            assert.ok(keep("roboss.theme", "dark"));
            assert.equal(kept("roboss.theme"), "dark");
        },
    );
});
