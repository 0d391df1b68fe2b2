// Names of the robots nearest to the camera, when asked for; the rest would only cover the picture.
import * as THREE from "three";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";
import type { LabelLayer } from "./labels";

const NAMED_MAX = 40;

export class Names {
    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly labels: LabelLayer,
    ) {}

    update(world: World | null): void {
        const wanted = new Set<string>();
        if (world !== null && this.state.overlays.value.has("names")) {
            const base = world.history.drawn.base,
                eye = this.stage.camera.position,
                place = new THREE.Vector3();
            const near = Array.from({ length: world.fleet.count }, (_, robot) => ({
                robot,
                away: eye.distanceToSquared(place.set(base[robot * 7], base[robot * 7 + 1], base[robot * 7 + 2])),
            }));
            near.sort((a, b) => a.away - b.away);
            for (const { robot } of near.slice(0, NAMED_MAX)) {
                if (robot === this.state.selected.value) continue;
                const key = `name ${robot}`;
                wanted.add(key);
                place.set(
                    base[robot * 7],
                    base[robot * 7 + 1],
                    base[robot * 7 + 2] + world.fleet.type(robot).reach * 1.1,
                );
                this.labels.put(key, place, world.fleet.name(robot));
            }
        }
        for (const key of this.labels.keysStarting("name ")) if (!wanted.has(key)) this.labels.put(key, null, "");
    }
}
