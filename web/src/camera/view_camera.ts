// The camera of one view: its rig, its mode, and the robot that it follows.
import * as THREE from "three";
import type { CameraMode, World } from "../model/viewer_state";
import { CameraRig } from "./rig";

const CLEAR_MIN_M = 0.4;
const DIRECTIONS_TRIED = 8;
/** Larger scenery is not searched each frame. */
const RAY_VERTICES_MAX = 200_000;

export function placeOf(world: World, robot: number): [number, number, number] {
    const base = world.history.drawn.base,
        at = robot * 7;
    return [base[at], base[at + 1], base[at + 2]];
}

function yawOf(world: World, robot: number): number {
    const base = world.history.drawn.base,
        at = robot * 7,
        [w, x, y, z] = [base[at + 3], base[at + 4], base[at + 5], base[at + 6]];
    return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

/** The angle from a to b, the nearest way round. */
function turnBetween(a: number, b: number): number {
    return Math.atan2(Math.sin(b - a), Math.cos(b - a));
}

export function closeness(world: World, robot: number): number {
    const reach = world.fleet.type(robot).reach;
    return Math.max(0.8, Math.min(11 * reach, 1.9 + 3.4 * reach));
}

export class ViewCamera {
    readonly rig = new CameraRig();
    mode: CameraMode = "orbit";
    robot: number | null = null;
    private carriedYaw: number | null = null;

    following(): boolean {
        return this.mode === "follow" || this.mode === "chase";
    }

    /** Comes near the robot that it follows from now on. */
    approach(world: World): void {
        this.carriedYaw = null;
        if (this.robot === null || !this.following()) return;
        const goal = this.rig.goal;
        goal.distance = Math.min(goal.distance, closeness(world, this.robot));
        if (this.mode !== "chase") {
            goal.elevation = Math.min(goal.elevation, 0.5);
            return;
        }
        goal.azimuth += turnBetween(goal.azimuth, yawOf(world, this.robot) + Math.PI);
        goal.elevation = 0.26;
    }

    /** How far from the target the camera may be before scenery comes between. */
    private clearDistance(solids: readonly THREE.Mesh[]): number {
        const searched = solids.filter(
            (mesh) => mesh.name !== "planes" && mesh.geometry.getAttribute("position").count < RAY_VERTICES_MAX,
        );
        const target = new THREE.Vector3(...this.rig.now.target),
            way = new THREE.Vector3(...this.rig.eye({ ...this.rig.now, distance: 1 })).sub(target).normalize();
        const met = new THREE.Raycaster(target, way, 0, this.rig.now.distance).intersectObjects(searched, false)[0];
        return met === undefined ? this.rig.now.distance * 1.05 : Math.max(CLEAR_MIN_M, met.distance * 0.92);
    }

    /** Turns to where scenery leaves the most room; the direction that it has counts first. */
    findRoom(solids: readonly THREE.Mesh[]): void {
        const { now, goal } = this.rig,
            from = now.azimuth;
        let best = { azimuth: from, clear: 0 };
        for (let k = 0; k < DIRECTIONS_TRIED; ++k) {
            now.azimuth = from + (k * 2 * Math.PI) / DIRECTIONS_TRIED;
            const clear = this.clearDistance(solids);
            if (clear > best.clear * 1.05) best = { azimuth: now.azimuth, clear };
        }
        now.azimuth = goal.azimuth = best.azimuth;
    }

    /** Each frame: the target stays on the robot; chasing, the camera turns with it. */
    follow(world: World, seconds: number, solids: readonly THREE.Mesh[]): void {
        this.rig.clear = Infinity;
        if (!this.following() || this.robot === null || this.robot >= world.fleet.count) return;
        if (!this.rig.orthographic) this.rig.clear = this.clearDistance(solids);
        const place = placeOf(world, this.robot),
            far = Math.hypot(...place.map((value, k) => value - this.rig.now.target[k]));
        if (far < Math.max(2, this.rig.now.distance) || seconds === 0) this.rig.carry(place);
        else this.rig.goal.target = place;
        if (this.mode !== "chase") return;
        const yaw = yawOf(world, this.robot);
        if (this.carriedYaw !== null) this.rig.goal.azimuth += turnBetween(this.carriedYaw, yaw);
        this.carriedYaw = yaw;
    }
}
