import assert from "node:assert/strict";
import { test } from "node:test";
import { Address, formatCamera, parseCamera } from "../src/model/address";

test("a camera comes back from the link that was made of it", () => {
    const camera = {
            target: [1.25, -20.5, 0.5] as [number, number, number],
            azimuth: -1.1,
            elevation: 0.6,
            distance: 42.5,
        },
        back = parseCamera(formatCamera(camera));
    assert.ok(back !== null);
    assert.deepEqual(back.target, camera.target);
    for (const name of ["azimuth", "elevation"] as const) assert.ok(Math.abs(back[name] - camera[name]) < 2e-3);
    assert.equal(back.distance, 42.5);
});

test("what is no camera is taken as none", () => {
    for (const text of ["", "top", "1,2,3", "1,2,3,4,5,x", "1,2,3,4,5,0", "1,2,3,4,,6"])
        assert.equal(parseCamera(text), null, text);
});

test("words behind # win over those behind ?", () => {
    const address = new Address("?theme=light&show=rays,tracks", "#theme=dark");
    assert.equal(address.get("theme"), "dark");
    assert.deepEqual(address.list("show"), ["rays", "tracks"]);
    assert.deepEqual(address.list("nothing"), []);
});
