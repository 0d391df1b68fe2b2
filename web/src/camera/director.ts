// What the camera does in the large: the whole world, views with names, one robot, along with one robot. It acts on the
// active view.
import { type Address, type CameraWords, parseCamera } from "../model/address";
import type { ViewerState, World } from "../model/viewer_state";
import { type ViewCount, viewports } from "../view/viewports";
import type { Stage } from "../view/stage";
import { ballsOf } from "./extent";
import { fitted, type FreePart } from "./fit";
import { freePart } from "./free_part";
import { angleBetween, type Direction, DIRECTIONS, type NamedView, wordsOfCamera } from "./named_views";
import { closeness, placeOf } from "./view_camera";
import type { Views } from "./views";

/** What new views show: the first of these that no other view shows. */
const SIDES = ["top", "front", "side", "isometric"] as const;
/** rad: views whose directions are nearer to each other look alike. */
const ALIKE = 0.35;
/** From the side, over the ground. */
const FOLLOWED_ELEVATION_MIN = 0.12;
const OVERVIEW = { azimuth: -2.05, elevation: 0.62 };
/** Of a picture as high as wide, or higher: from farther above, so that a flat world fills it. */
const TALL_ELEVATION = 1.15;
const WIDE_ASPECT = 1.4;
/** A page that begins with a robot shows where it is, too. */
const START_FACTOR = 1.8;

/** Where the whole world is seen from in a picture of this shape. */
function overviewOf({ width, height, left, right, top, bottom }: FreePart): Direction {
    const aspect = (width - left - right) / Math.max(1, height - top - bottom),
        tall = Math.max(0, Math.min(1, (WIDE_ASPECT - aspect) / (WIDE_ASPECT - 0.7)));
    return { ...OVERVIEW, elevation: OVERVIEW.elevation + tall * (TALL_ELEVATION - OVERVIEW.elevation) };
}

export class Director {
    private activating = false;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly views: Views,
        private readonly address: Address,
    ) {
        state.cameraMode.follow((mode, before) => {
            if (this.activating) return;
            const camera = views.camera;
            camera.mode = mode;
            camera.robot = state.selected.value;
            if (mode !== before) this.approach();
        });
        state.selected.follow((robot) => {
            views.camera.robot = robot;
            this.approach();
            // A new scene selects the same robot again at once, if it is still there.
            if (robot === null) queueMicrotask(() => state.selected.value === null && this.letGo());
        });
        views.count.follow((count) => stage.layOut(count));
        views.active.follow(() => {
            this.activating = true;
            state.cameraMode.set(views.camera.mode);
            this.activating = false;
        });
    }

    private approach(): void {
        if (this.state.world.value !== null) this.views.camera.approach(this.state.world.value);
    }

    private free(viewport = this.stage.viewport): FreePart {
        return freePart(this.stage.canvas, viewport);
    }

    /** Where the page starts: as its address says, else as the file says, else the whole world. */
    start(world: World): void {
        const words = this.address.get("camera") ?? "",
            asked = parseCamera(words),
            rig = this.views.rig,
            named = (["top", "front", "side", "isometric"] as const).find((name) => name === words),
            followed = /^(follow|chase):(.*)$/.exec(words);
        if (asked !== null) rig.jump(asked);
        else if (named !== undefined) rig.jump(this.overview(world, DIRECTIONS[named]));
        else if (words === "file" || (words === "" && world.loaded.scene.look?.camera !== undefined))
            this.startAtFile(world);
        else rig.jump(this.overview(world));
        const robot = followed === null ? undefined : world.fleet.find(followed[2]);
        if (followed !== null && robot !== undefined) this.startWith(world, robot, followed[1] as "follow" | "chase");
        for (const number of this.views.read(this.address, world)) this.turnAway(world, number);
    }

    private startWith(world: World, robot: number, mode: "follow" | "chase"): void {
        this.state.selected.set(robot);
        this.state.cameraMode.set(mode);
        const { camera, rig } = this.views;
        camera.follow(world, 0, []);
        rig.goal.distance *= START_FACTOR;
        rig.jump(rig.goal);
        if (mode === "follow") camera.findRoom(this.stage.statics?.solids ?? []);
    }

    private startAtFile(world: World): void {
        this.fileView();
        this.views.rig.jump(this.views.rig.goal);
        const track = world.loaded.scene.look?.camera?.track,
            robot = track === undefined ? undefined : world.fleet.find(track);
        if (robot === undefined) return;
        this.state.selected.set(robot);
        this.state.cameraMode.set("follow");
    }

    overview(world: World, from?: Direction, free = this.free()): CameraWords {
        const orthographic = this.views.rig.orthographic;
        return fitted(ballsOf(world), { ...(from ?? overviewOf(free)), orthographic }, free);
    }

    private goTo(words: CameraWords): void {
        this.state.cameraMode.set("orbit");
        const goal = this.views.rig.goal,
            turn = words.azimuth - goal.azimuth;
        Object.assign(goal, words, { azimuth: goal.azimuth + Math.atan2(Math.sin(turn), Math.cos(turn)) });
    }

    /** The whole world, from where the first sight is. */
    home(): void {
        const world = this.state.world.value;
        if (world !== null) this.goTo(this.overview(world));
    }

    view(name: NamedView): void {
        const world = this.state.world.value;
        if (world !== null) this.goTo(this.overview(world, DIRECTIONS[name]));
    }

    /** New views show the world, or the robot that the active one follows, from other sides, as in CAD programs. */
    split(count: ViewCount): void {
        const world = this.state.world.value,
            before = this.views.count.value;
        this.views.split(count);
        for (let number = before; number < count && world !== null; ++number) this.turnAway(world, number);
    }

    /** Gives a view a direction that no view before it has. */
    private turnAway(world: World, number: number): void {
        const camera = this.views.cameras[number],
            others = this.views.cameras.slice(0, number),
            side =
                SIDES.find((one) => others.every(({ rig }) => angleBetween(DIRECTIONS[one], rig.goal) > ALIKE)) ??
                "top";
        if (!camera.following() || camera.robot === null) {
            const { clientWidth, clientHeight } = this.stage.canvas,
                place = viewports(this.views.count.value, clientWidth, clientHeight)[number];
            return camera.rig.jump(this.overview(world, DIRECTIONS[side], this.free(place)));
        }
        camera.mode = "follow";
        const { azimuth, elevation } = DIRECTIONS[side];
        camera.rig.jump({
            ...camera.rig.goal,
            target: placeOf(world, camera.robot),
            azimuth,
            elevation: Math.max(FOLLOWED_ELEVATION_MIN, elevation),
        });
    }

    /** Where the file puts the camera; nothing where it does not. */
    fileView(): void {
        const world = this.state.world.value,
            camera = world?.loaded.scene.look?.camera;
        if (world === null || camera === undefined) return;
        this.views.rig.orthographic = camera.orthographic;
        this.goTo(wordsOfCamera(camera, this.overview(world).distance));
        if (camera.view === "fps") this.state.cameraMode.set("fly");
    }

    /** With or without perspective. */
    flatten(): void {
        this.views.rig.orthographic = !this.views.rig.orthographic;
    }

    focus(robot: number): void {
        this.state.selected.set(robot);
        const world = this.state.world.value;
        if (world === null) return;
        this.views.rig.goal.target = placeOf(world, robot);
        this.views.rig.goal.distance = closeness(world, robot);
    }

    focusSelected(): void {
        if (this.state.selected.value !== null) this.focus(this.state.selected.value);
    }

    /** Follows no longer: the camera was moved away. */
    letGo(): void {
        if (this.views.camera.following()) this.state.cameraMode.set("orbit");
    }

    /** The camera stays on this robot from now on. */
    followRobot(robot: number): void {
        this.state.selected.set(robot);
        this.state.cameraMode.set("follow");
        this.approach();
    }

    /** Each frame, all views. */
    follow(world: World, seconds: number): void {
        for (const camera of this.views.shown) camera.follow(world, seconds, this.stage.statics?.solids ?? []);
    }
}
