// What is about the world: sky, ground, grid, fog and light. A world that says nothing of them has the page's own; one that
// has lights is lit by them alone, and its <scene> replaces sky, ambient light, grid and fog.
import * as THREE from "three";
import type { CameraRig } from "../camera/rig";
import type { World } from "../model/viewer_state";
import type { LookInfo } from "../wire/look";
import { Ground } from "./ground";
import type { Lens } from "./lens";
import { PALETTES, type ScenePalette } from "./palette";
import { skyLight } from "./sky_light";
import { Sunlight, TOWARDS_SUN } from "./sunlight";
import { colourOf, UNIT, WorldLights } from "./world_lights";

/** Of the page's sky, where the file says how bright the light from everywhere is: reflections only. */
const REFLECTIONS = 0.25;

export class Atmosphere {
    private readonly ground = new Ground();
    private readonly sunlight: Sunlight;
    private readonly ambient = new THREE.AmbientLight(0xffffff, 0);
    /** Whether this light of the world shines. */
    shines: (light: string) => boolean = () => true;
    private lights: WorldLights | null = null;
    private look: LookInfo = {};
    private palette: ScenePalette = PALETTES.dark;

    constructor(
        private readonly scene: THREE.Scene,
        private readonly resolution: number,
    ) {
        this.sunlight = new Sunlight(resolution);
        scene.add(this.ground.group, this.sunlight.group, this.ambient);
    }

    paint(palette: ScenePalette): void {
        this.palette = palette;
        this.scene.environment?.dispose();
        this.scene.environment = skyLight(palette);
        this.apply();
    }

    show(world: World | null): void {
        if (this.lights !== null) this.scene.remove(this.lights.group);
        this.lights?.dispose();
        this.lights = null;
        this.look = world?.loaded.scene.look ?? {};
        if (world !== null) {
            this.lights = new WorldLights(
                world,
                this.look.scene?.shadows !== false && this.resolution > 0,
                this.shines,
            );
            this.scene.add(this.lights.group);
        }
        this.apply();
    }

    private apply(): void {
        const { scene } = this.look,
            sun = this.lights?.sun ?? null;
        this.ground.paint(this.palette, scene);
        this.sunlight.paint(this.palette);
        if (sun !== null) this.sunlight.become(sun);
        else this.sunlight.direct(TOWARDS_SUN);
        this.sunlight.shine(
            sun !== null || this.lights?.any !== true,
            scene?.shadows !== false && sun?.shadows !== false,
        );
        const ambient = scene?.ambient;
        this.ambient.color = colourOf(ambient ?? [1, 1, 1]);
        this.ambient.intensity = ambient === undefined ? 0 : UNIT;
        this.scene.environmentIntensity = this.palette.skyStrength * (ambient === undefined ? 1 : REFLECTIONS);
        const fog = scene?.fog;
        this.scene.fog = new THREE.Fog(fog === undefined ? this.ground.horizon : colourOf(fog.rgb), 100, 600);
    }

    place(world: World): void {
        this.lights?.place(world);
    }

    /** Before a view is drawn. */
    follow(lens: Lens, rig: CameraRig): void {
        const target = new THREE.Vector3(...rig.now.target);
        this.ground.follow(lens, target);
        this.sunlight.follow(target, rig.now.distance);
        const fog = this.scene.fog as THREE.Fog,
            own = this.look.scene?.fog,
            far = rig.now.distance * (rig.orthographic ? 40 : 9);
        fog.near = own?.start ?? Math.max(80, rig.orthographic ? far * 0.9 : rig.now.distance * 2);
        fog.far =
            own === undefined ? Math.max(500, far) : Math.max(own.end, own.start + 1e-3) / Math.max(0.05, own.density);
    }

    endShadows(): void {
        this.sunlight.endShadows();
        this.lights?.endShadows();
    }
}
