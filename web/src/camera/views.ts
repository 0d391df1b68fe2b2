// One, two or four views of the picture, each with its own camera; one of them is active: gestures, keys and the buttons
// of the bar act on it. The page's address keeps them.
import { type Address, formatCamera, parseCamera } from "../model/address";
import { Signal } from "../model/signal";
import type { CameraMode, World } from "../model/viewer_state";
import { VIEW_COUNTS, type ViewCount } from "../view/viewports";
import type { CameraRig } from "./rig";
import { ViewCamera } from "./view_camera";

const VIEWS_MAX = 4;
const MODES: readonly CameraMode[] = ["orbit", "fly", "follow", "chase"];

export class Views {
    readonly count = new Signal<ViewCount>(1);
    readonly active = new Signal(0);
    readonly cameras = Array.from({ length: VIEWS_MAX }, () => new ViewCamera());

    get camera(): ViewCamera {
        return this.cameras[this.active.value];
    }

    get rig(): CameraRig {
        return this.camera.rig;
    }

    get shown(): ViewCamera[] {
        return this.cameras.slice(0, this.count.value);
    }

    /** No camera is on its way to where it shall be. */
    get arrived(): boolean {
        return this.shown.every(({ rig }) => rig.arrived);
    }

    activate(number: number): void {
        if (number < this.count.value && number !== this.active.value) this.active.set(number);
    }

    /** New views begin as the active one is. */
    split(count: ViewCount): void {
        const from = this.camera;
        if (this.active.value >= count) {
            this.copy(from, this.cameras[0]);
            this.active.set(0);
        }
        for (let k = this.count.value; k < count; ++k) this.copy(from, this.cameras[k]);
        this.count.set(count);
    }

    private copy(from: ViewCamera, to: ViewCamera): void {
        to.rig.jump(from.rig.goal);
        to.rig.orthographic = from.rig.orthographic;
        to.mode = from.mode;
        to.robot = from.robot;
    }

    /** As words of the page's address: how many, and the camera of each but the first ("view2=x,y,z,a,e,d;mode;robot"). */
    words(world: World | null): [string, string][] {
        const first = this.cameras[0],
            words: [string, string][] = [];
        if (first.rig.orthographic) words.push(["projection", "orthographic"]);
        if (this.count.value === 1) return words;
        words.push(["views", String(this.count.value)]);
        this.shown.slice(1).forEach(({ rig, mode, robot }, k) => {
            const name = robot === null ? "" : (world?.fleet.name(robot) ?? ""),
                flat = rig.orthographic ? "orthographic" : "";
            words.push([`view${k + 2}`, [formatCamera(rig.goal), mode, name, flat].join(";").replace(/;+$/, "")]);
        });
        return words;
    }

    /** The other way round, after the first camera was placed; the numbers of views of which the address says nothing. */
    read(address: Address, world: World): number[] {
        this.cameras[0].rig.orthographic ||= address.get("projection") === "orthographic";
        const count = VIEW_COUNTS.find((number) => String(number) === address.get("views")),
            untold: number[] = [];
        if (count === undefined) return [];
        for (let k = 1; k < count; ++k) {
            this.copy(this.cameras[0], this.cameras[k]);
            const [camera, mode, name, flat] = (address.get(`view${k + 1}`) ?? "").split(";"),
                words = parseCamera(camera),
                one = this.cameras[k];
            if (words === null) {
                untold.push(k);
                continue;
            }
            one.rig.jump(words);
            one.mode = MODES.find((known) => known === mode) ?? "orbit";
            one.robot = world.fleet.find(name ?? "") ?? null;
            one.rig.orthographic = flat === "orthographic";
        }
        this.count.set(count);
        return untold;
    }
}
