// Which robot is under the pointer: first the spheres of their reach, then the triangles of the few that the ray meets;
// scenery in front hides them.
import * as THREE from "three";
import type { World } from "../model/viewer_state";
import type { Visual } from "../wire/messages";
import { visualAt } from "./geometry";
import type { Stage } from "./stage";

export interface Picked {
    robot: number;
    /** Of the robot: the first one of the body that was met. */
    link: number;
    point: THREE.Vector3;
    distance: number;
}

const REACH_MIN_M = 0.05;
/** Above everything. */
const HIGH_M = 1e4;

/** What of the scenery is under the pointer, robots aside: its shape, and where. */
export function pickScenery(
    stage: Stage,
    x: number,
    y: number,
): { visual: Visual | null; point: THREE.Vector3 } | null {
    const hit = stage.ray(x, y).intersectObjects(stage.statics?.solids ?? [], false)[0];
    if (hit === undefined) return null;
    const geometry = (hit.object as THREE.Mesh).geometry;
    return { visual: visualAt(geometry, hit.faceIndex ?? 0), point: hit.point };
}

/** The point under the pointer: of a robot, of the scenery, or of the plane z = 0; null: the sky. */
export function pickPoint(stage: Stage, world: World, x: number, y: number): THREE.Vector3 | null {
    const found = pick(stage, world, x, y)?.point ?? pickScenery(stage, x, y)?.point;
    if (found !== undefined) return found;
    const ground = new THREE.Plane(new THREE.Vector3(0, 0, 1), 0);
    return stage.ray(x, y).ray.intersectPlane(ground, new THREE.Vector3());
}

/** Height of the highest scenery at a place; of the plane z = 0 where there is none. */
export function surfaceBelow(stage: Stage, x: number, y: number): number {
    const down = new THREE.Raycaster(new THREE.Vector3(x, y, HIGH_M), new THREE.Vector3(0, 0, -1)),
        hit = down.intersectObjects(stage.statics?.solids ?? [], false)[0];
    return hit?.point.z ?? 0;
}

export function pick(stage: Stage, world: World, x: number, y: number): Picked | null {
    if (stage.robots === null) return null;
    const caster = stage.ray(x, y),
        ray = caster.ray,
        base = world.history.drawn.base;
    const hidden = caster.intersectObjects(stage.statics?.solids ?? [], false)[0]?.distance ?? Infinity;
    const centre = new THREE.Vector3();
    let best: Picked | null = null;
    for (let r = 0; r < world.fleet.count; ++r) {
        centre.set(base[r * 7], base[r * 7 + 1], base[r * 7 + 2]);
        const reach = Math.max(REACH_MIN_M, world.fleet.type(r).reach);
        if (ray.distanceSqToPoint(centre) > reach * reach || !stage.pickable(r)) continue;
        const hit = stage.hit(caster, r);
        if (hit === null || hit.distance > hidden + 1e-3 || (best !== null && hit.distance >= best.distance)) continue;
        const link = world.fleet.type(r).links.findIndex(({ body }) => body === hit.body);
        best = { robot: r, link: Math.max(0, link), point: hit.point.clone(), distance: hit.distance };
    }
    return best;
}
