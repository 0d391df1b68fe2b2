// Which way the camera looks in the large: the whole world, one robot, along with one robot. Written into and read from
// the page's address.
import * as THREE from "three";
import { type Address, type CameraWords, parseCamera } from "../model/address";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { CameraRig } from "./rig";

const OVERVIEW_AZIMUTH = -2.05;
/** A longer reach hardly ever shows. */
const REACH_SEEN_M = 3;
const CLEAR_MIN_M = 0.4;
/** Larger scenery is not searched each frame. */
const RAY_VERTICES_MAX = 200_000;
const OVERVIEW_ELEVATION = 0.62;

export class Director {
    private carriedYaw: number | null = null;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly rig: CameraRig,
        private readonly address: Address,
    ) {
        state.cameraMode.follow((mode, before) => {
            this.carriedYaw = null;
            if (mode !== before && (mode === "follow" || mode === "chase")) this.approach();
        });
        state.selected.follow(() => {
            this.carriedYaw = null;
            if (this.following()) this.approach();
        });
    }

    private following(): boolean {
        return this.state.cameraMode.value === "follow" || this.state.cameraMode.value === "chase";
    }

    /** Where the page starts: as its address says, else the whole world. */
    start(world: World): void {
        const words = this.address.get("camera") ?? "",
            asked = parseCamera(words);
        if (asked !== null) return this.rig.jump(asked);
        const top = words === "top",
            overview = this.overview(world, top);
        this.rig.jump(overview);
        const named =
            words.startsWith("follow:") || words.startsWith("chase:")
                ? world.fleet.find(words.slice(words.indexOf(":") + 1))
                : undefined;
        if (named === undefined) return;
        this.state.selected.set(named);
        this.state.cameraMode.set(words.startsWith("chase") ? "chase" : "follow");
        this.follow(world, 0);
        this.rig.jump(this.rig.goal);
    }

    overview(world: World, top = false): CameraWords {
        const box = (this.stage.statics?.extent ?? new THREE.Box3()).clone(),
            base = world.history.drawn.base;
        const place = new THREE.Vector3(),
            around = new THREE.Box3();
        for (let r = 0; r < world.fleet.count; ++r) {
            const reach = 2 * Math.min(REACH_SEEN_M, world.fleet.type(r).reach);
            place.set(base[r * 7], base[r * 7 + 1], base[r * 7 + 2]);
            box.union(around.setFromCenterAndSize(place, new THREE.Vector3(reach, reach, reach)));
        }
        const centre = box.isEmpty() ? new THREE.Vector3() : box.getCenter(new THREE.Vector3()),
            size = box.isEmpty() ? new THREE.Vector3(4, 4, 1) : box.getSize(new THREE.Vector3());
        const span = Math.max(1.2, Math.hypot(size.x, size.y)),
            wide = Math.min(1, this.stage.camera.aspect / 1.5);
        return {
            target: [centre.x, centre.y, Math.max(0, box.isEmpty() ? 0 : box.min.z)],
            azimuth: top ? -Math.PI / 2 : OVERVIEW_AZIMUTH,
            elevation: top ? Math.PI / 2 - 0.001 : OVERVIEW_ELEVATION,
            distance: (span * 0.62) / wide,
        };
    }

    home(): void {
        const world = this.state.world.value;
        if (world === null) return;
        this.state.cameraMode.set("orbit");
        Object.assign(this.rig.goal, this.overview(world));
    }

    focus(robot: number): void {
        this.state.selected.set(robot);
        const world = this.state.world.value;
        if (world === null) return;
        this.rig.goal.target = this.place(world, robot);
        this.rig.goal.distance = this.closeness(world, robot);
    }

    private place(world: World, robot: number): [number, number, number] {
        const base = world.history.drawn.base,
            at = robot * 7;
        return [base[at], base[at + 1], base[at + 2]];
    }

    private closeness(world: World, robot: number): number {
        const reach = world.fleet.type(robot).reach;
        return Math.max(0.8, Math.min(11 * reach, 1.9 + 3.4 * reach));
    }

    private approach(): void {
        const world = this.state.world.value,
            robot = this.state.selected.value;
        if (world === null || robot === null) return;
        const goal = this.rig.goal;
        goal.distance = Math.min(goal.distance, this.closeness(world, robot));
        goal.elevation = Math.min(goal.elevation, 0.5);
        if (this.state.cameraMode.value !== "chase") return;
        // The nearest way round to behind the robot.
        const behind = this.yaw(world, robot) + Math.PI;
        goal.azimuth += Math.atan2(Math.sin(behind - goal.azimuth), Math.cos(behind - goal.azimuth));
        goal.elevation = 0.26;
    }

    /** How far from the target the camera may be before scenery comes between. */
    private clearDistance(): number {
        const solids = (this.stage.statics?.solids ?? []).filter(
            (mesh) => mesh.name !== "planes" && mesh.geometry.getAttribute("position").count < RAY_VERTICES_MAX,
        );
        const target = new THREE.Vector3(...this.rig.now.target),
            way = new THREE.Vector3(...this.rig.eye({ ...this.rig.now, distance: 1 })).sub(target).normalize();
        const met = new THREE.Raycaster(target, way, 0, this.rig.now.distance).intersectObjects(solids, false)[0];
        return met === undefined ? this.rig.now.distance * 1.05 : Math.max(CLEAR_MIN_M, met.distance * 0.92);
    }

    private yaw(world: World, robot: number): number {
        const base = world.history.drawn.base,
            at = robot * 7,
            w = base[at + 3],
            x = base[at + 4],
            y = base[at + 5],
            z = base[at + 6];
        return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    }

    /** Each frame: the target stays on the robot; chasing, the camera turns with it. */
    follow(world: World, seconds: number): void {
        const robot = this.state.selected.value;
        this.rig.clear = Infinity;
        if (!this.following() || robot === null) return;
        this.rig.clear = this.clearDistance();
        const place = this.place(world, robot),
            far = Math.hypot(...place.map((value, k) => value - this.rig.now.target[k]));
        if (far < Math.max(2, this.rig.now.distance) || seconds === 0) this.rig.carry(place);
        else this.rig.goal.target = place;
        if (this.state.cameraMode.value !== "chase") return;
        const yaw = this.yaw(world, robot);
        if (this.carriedYaw !== null)
            this.rig.goal.azimuth += Math.atan2(Math.sin(yaw - this.carriedYaw), Math.cos(yaw - this.carriedYaw));
        this.carriedYaw = yaw;
    }
}
