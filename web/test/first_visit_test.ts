import assert from "node:assert/strict";
import { test } from "node:test";
import { Address } from "../src/model/address";
import { dismissHints, hintsWanted } from "../src/model/first_visit";

/** A browser that was never here; `keeps`: it keeps choices. */
function browser(keeps: boolean): void {
    const values = new Map<string, string>();
    const localStorage = {
        getItem: (name: string) => values.get(name) ?? null,
        setItem: (name: string, value: string) => {
            if (!keeps) throw new DOMException("full", "QuotaExceededError");
            values.set(name, value);
        },
    };
    Object.defineProperty(globalThis, "window", { configurable: true, value: { localStorage } });
}

const wanted = (search: string) => hintsWanted(new Address(search, ""));

test("first steps are shown until they are dismissed", () => {
    browser(true);
    assert.ok(wanted(""));
    assert.ok(wanted(""));
    dismissHints();
    assert.ok(!wanted(""));
});

test("pictures show no first steps, and a browser that keeps nothing is spared them", () => {
    browser(true);
    for (const search of ["?hide=panels", "?quality=low", "?panel=view"]) assert.ok(!wanted(search), search);
    browser(false);
    assert.ok(!wanted(""));
});

test("an address that asks for first steps gets them, dismissed or not", () => {
    for (const keeps of [true, false]) {
        browser(keeps);
        dismissHints();
        assert.ok(wanted("?hints"));
        assert.ok(wanted("?quality=low&hints"));
    }
});
