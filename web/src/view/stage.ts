// The picture: renderer, sky, light, and the layers of the scene of the moment. One draw() a frame; the times that
// JavaScript took for it are kept (`?measure` shows them).
import * as THREE from "three";
import type { CameraRig } from "../camera/rig";
import type { Theme, World } from "../model/viewer_state";
import type { Visual } from "../wire/messages";
import { Finishes } from "./finishes";
import { Ground } from "./ground";
import { PALETTES, type ScenePalette } from "./palette";
import { skyLight } from "./sky_light";
import { type Part, RobotsLayer } from "./robots_layer";
import { StaticsLayer } from "./statics_layer";
import { Sunlight } from "./sunlight";

/** auto: as good as the machine draws smoothly. low: for machines that draw in software. */
export type Quality = "low" | "high" | "auto";

export class Stage {
    readonly scene = new THREE.Scene();
    readonly camera = new THREE.PerspectiveCamera(46, 1, 0.1, 1000);
    /** What overlays draw; they add to it and take away what they added. */
    readonly overlays = new THREE.Group();
    readonly renderer: THREE.WebGLRenderer;
    robots: RobotsLayer | null = null;
    collisions: RobotsLayer | null = null;
    statics: StaticsLayer | null = null;
    /** Robots that are drawn otherwise than the layer `robots` does; it leaves them out. */
    partly: RobotsLayer[] = [];
    /** Whether a click may meet this robot. */
    pickable: (robot: number) => boolean = () => true;
    /** Whether this shape of the scenery is drawn. */
    private sceneryShown: (visual: Visual) => boolean = () => true;
    private finishes = new Finishes(new Map());
    palette: ScenePalette = PALETTES.dark;
    private readonly ground = new Ground();
    private readonly sunlight: Sunlight;

    constructor(
        readonly canvas: HTMLCanvasElement,
        quality: Quality,
    ) {
        this.renderer = new THREE.WebGLRenderer({
            canvas,
            antialias: quality !== "low",
            powerPreference: "high-performance",
        });
        this.renderer.setPixelRatio(quality === "low" ? 0.5 : Math.min(2, window.devicePixelRatio));
        this.renderer.toneMapping = THREE.NeutralToneMapping;
        this.renderer.toneMappingExposure = 1.0;
        this.renderer.shadowMap.enabled = quality !== "low";
        this.renderer.shadowMap.type = THREE.PCFShadowMap;
        this.sunlight = new Sunlight(quality === "low" ? 0 : 2048);
        this.scene.add(this.ground.group, this.sunlight.group, this.overlays);
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
        this.resize();
    }

    /** Draws with less effort (view/effort.ts). */
    lower(level: number): void {
        this.renderer.setPixelRatio(level === 1 ? 1 : 0.75);
        this.resize();
        if (level > 1) this.sunlight.endShadows();
    }

    paint(theme: Theme): void {
        this.palette = PALETTES[theme];
        this.ground.paint(this.palette);
        this.sunlight.paint(this.palette);
        this.scene.environment?.dispose();
        this.scene.environment = skyLight(this.renderer, this.palette);
        this.scene.environmentIntensity = this.palette.skyStrength;
        this.scene.fog = new THREE.Fog(this.palette.skyHorizon, 100, 600);
    }

    show(world: World | null): void {
        for (const layer of [this.robots, this.statics, this.collisions, ...this.partly]) {
            if (layer === null) continue;
            this.scene.remove(layer.group);
            layer.dispose();
        }
        this.finishes.dispose();
        this.robots = this.statics = this.collisions = null;
        this.partly = [];
        if (world === null) return;
        const { scene, meshes, pictures } = world.loaded;
        this.finishes = new Finishes(pictures);
        const statics = scene.statics.filter(this.sceneryShown);
        this.statics = new StaticsLayer({ ...scene, statics }, meshes, this.finishes);
        this.robots = new RobotsLayer(world.fleet, meshes, this.finishes);
        this.scene.add(this.statics.group, this.robots.group);
    }

    /** Draws only these shapes of the scenery. */
    showScenery(world: World | null, shown: (visual: Visual) => boolean): void {
        this.sceneryShown = shown;
        if (world === null || this.statics === null) return;
        this.scene.remove(this.statics.group);
        this.statics.dispose();
        const { scene, meshes } = world.loaded,
            statics = scene.statics.filter(shown);
        this.statics = new StaticsLayer({ ...scene, statics }, meshes, this.finishes);
        this.scene.add(this.statics.group);
    }

    /** Draws robots by parts; `away`: these and those that are hidden. */
    showParts(world: World, parts: readonly Part[], away: Iterable<number>): void {
        for (const layer of this.partly) {
            this.scene.remove(layer.group);
            layer.dispose();
        }
        this.partly = parts.map((part) => {
            const layer = new RobotsLayer(world.fleet, world.loaded.meshes, this.finishes, "visuals", part);
            this.scene.add(layer.group);
            for (const robot of part.robots) world.history.changed[robot] = 1;
            return layer;
        });
        this.robots?.leaveOut(away, world.history);
        this.place(world);
    }

    /** What the ray meets of the robot first. */
    hit(caster: THREE.Raycaster, robot: number): ReturnType<RobotsLayer["hit"]> {
        let nearest: ReturnType<RobotsLayer["hit"]> = null;
        for (const layer of [this.robots, ...this.partly]) {
            const hit = layer?.hit(caster, robot) ?? null;
            if (hit !== null && (nearest === null || hit.distance < nearest.distance)) nearest = hit;
        }
        return nearest;
    }

    /** Collision shapes instead of what robots look like, made when first asked for. */
    showCollisions(world: World, on: boolean): void {
        if (on && this.collisions === null) {
            this.collisions = new RobotsLayer(world.fleet, world.loaded.meshes, this.finishes, "collisions");
            this.scene.add(this.collisions.group);
            world.history.changed.fill(1);
            this.collisions.update(world.history);
        }
        if (this.collisions !== null) this.collisions.group.visible = on;
    }

    place(world: World): void {
        this.robots?.update(world.history);
        for (const layer of this.partly) layer.update(world.history);
        if (this.collisions?.group.visible === true) this.collisions.update(world.history);
    }

    aim(rig: CameraRig): void {
        rig.apply(this.camera);
        const target = new THREE.Vector3(...rig.now.target);
        this.ground.follow(this.camera, target);
        this.sunlight.follow(target, rig.now.distance);
        const fog = this.scene.fog as THREE.Fog;
        fog.near = Math.max(80, rig.now.distance * 2);
        fog.far = Math.max(500, rig.now.distance * 9);
    }

    draw(): void {
        this.renderer.render(this.scene, this.camera);
    }

    /** The ray through a point of the canvas, in CSS pixels. */
    ray(x: number, y: number): THREE.Raycaster {
        const caster = new THREE.Raycaster();
        const at = new THREE.Vector2((x / this.canvas.clientWidth) * 2 - 1, 1 - (y / this.canvas.clientHeight) * 2);
        caster.setFromCamera(at, this.camera);
        return caster;
    }

    private resize(): void {
        const box = (this.canvas.parentElement as HTMLElement).getBoundingClientRect();
        if (box.width < 1 || box.height < 1) return;
        this.renderer.setSize(box.width, box.height, false);
        this.camera.aspect = box.width / box.height;
        this.camera.updateProjectionMatrix();
    }
}
