// The picture: renderer, sky, light, and the layers of the scene of the moment. One draw() a frame, of all its views; the
// times that JavaScript took for it are kept (`?measure` shows them).
import * as THREE from "three";
import type { Views } from "../camera/views";
import type { CameraRig } from "../camera/rig";
import type { Theme, World } from "../model/viewer_state";
import { Atmosphere } from "./atmosphere";
import type { Visual } from "../wire/messages";
import { Finishes } from "./finishes";
import { type Lens, Lenses } from "./lens";
import { PALETTES, type ScenePalette } from "./palette";
import { type Part, RobotsLayer } from "./robots_layer";
import { StaticsLayer } from "./statics_layer";
import { viewAt, type ViewCount, type Viewport, viewports } from "./viewports";

/** auto: as good as the machine draws smoothly. low: for machines that draw in software. */
export type Quality = "low" | "high" | "auto";

const VIEWS_MAX = 4;

export class Stage {
    readonly scene = new THREE.Scene();
    /** What overlays draw; they add to it and take away what they added. */
    readonly overlays = new THREE.Group();
    readonly renderer: THREE.WebGLRenderer;
    /** The robot whose mark is near this place of the canvas (overlays/far_marks.ts); null: none. */
    markAt: (x: number, y: number) => number | null = () => null;
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
    private theme: Theme = "dark";
    private readonly atmosphere: Atmosphere;
    private readonly lenses = Array.from({ length: VIEWS_MAX }, () => new Lenses());
    private rigs: CameraRig[] = [];
    private active = 0;
    private size = { width: 1, height: 1 };
    ports: Viewport[] = viewports(1, 1, 1);

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
        this.atmosphere = new Atmosphere(this.scene, quality === "low" ? 0 : 2048);
        this.scene.add(this.overlays);
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
        this.resize();
    }

    /** The camera of the active view. */
    get camera(): Lens {
        return this.lenses[this.active].lens;
    }

    /** Where the active view is on the canvas. */
    get viewport(): Viewport {
        return this.ports[Math.min(this.active, this.ports.length - 1)];
    }

    get palette(): ScenePalette {
        return PALETTES[this.theme];
    }

    /** Draws with less effort (view/effort.ts). */
    lower(level: number): void {
        this.renderer.setPixelRatio(level === 1 ? 1 : 0.75);
        this.resize();
        if (level > 1) this.atmosphere.endShadows();
    }

    paint(theme: Theme): void {
        this.theme = theme;
        this.atmosphere.paint(this.palette);
    }

    show(world: World | null): void {
        for (const layer of [this.robots, this.statics, this.collisions, ...this.partly]) {
            if (layer === null) continue;
            this.scene.remove(layer.group);
            layer.dispose();
        }
        this.finishes.dispose();
        this.robots = this.statics = this.collisions = null;
        this.atmosphere.show(world);
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

    /** Lets only these lights of the world shine. */
    showLights(world: World | null, shown: (light: string) => boolean): void {
        this.atmosphere.shines = shown;
        this.atmosphere.show(world);
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
        this.atmosphere.place(world);
        for (const layer of this.partly) layer.update(world.history);
        if (this.collisions?.group.visible === true) this.collisions.update(world.history);
    }

    /** Divides the canvas: clicks find their view before the next frame is drawn, too. */
    layOut(count: ViewCount): void {
        this.ports = viewports(count, this.size.width, this.size.height);
    }

    aim(views: Views): void {
        this.rigs = views.shown.map(({ rig }) => rig);
        this.active = views.active.value;
        this.layOut(views.count.value);
        this.rigs.forEach((rig, k) => this.lenses[k].aim(rig, this.ports[k].width / this.ports[k].height));
    }

    draw(): void {
        const single = this.ports.length === 1;
        this.renderer.setScissorTest(!single);
        this.rigs.forEach((rig, k) => {
            const { left, top, width, height } = this.ports[k],
                bottom = this.size.height - top - height;
            this.renderer.setViewport(left, bottom, width, height);
            if (!single) this.renderer.setScissor(left, bottom, width, height);
            this.atmosphere.follow(this.lenses[k].lens, rig);
            this.renderer.render(this.scene, this.lenses[k].lens);
        });
    }

    /** The ray through a point of the active view, in CSS pixels of the canvas. */
    ray(x: number, y: number): THREE.Raycaster {
        const caster = new THREE.Raycaster(),
            { left, top, width, height } = this.viewport;
        caster.setFromCamera(
            new THREE.Vector2(((x - left) / width) * 2 - 1, 1 - ((y - top) / height) * 2),
            this.camera,
        );
        return caster;
    }

    viewAt(x: number, y: number): number {
        return viewAt(this.ports, x, y);
    }

    private resize(): void {
        const box = (this.canvas.parentElement as HTMLElement).getBoundingClientRect();
        if (box.width < 1 || box.height < 1) return;
        this.size = { width: box.width, height: box.height };
        this.renderer.setSize(box.width, box.height, false);
        this.ports = viewports(this.ports.length as 1 | 2 | 4, box.width, box.height);
    }
}
