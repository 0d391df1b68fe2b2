// Which robot is under the pointer: first the spheres of their reach, then the triangles of the few that the ray meets;
// scenery in front hides them.
import * as THREE from "three";
import type { World } from "../model/viewer_state";
import type { Stage } from "./stage";

export interface Picked {
    robot: number;
    /** Of the robot: the first one of the body that was met. */
    link: number;
    point: THREE.Vector3;
    distance: number;
}

const REACH_MIN_M = 0.05;

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
        if (ray.distanceSqToPoint(centre) > reach * reach) continue;
        const hit = stage.robots.hit(caster, r);
        if (hit === null || hit.distance > hidden + 1e-3 || (best !== null && hit.distance >= best.distance)) continue;
        const link = world.fleet.type(r).links.findIndex(({ body }) => body === hit.body);
        best = { robot: r, link: Math.max(0, link), point: hit.point.clone(), distance: hit.distance };
    }
    return best;
}
