// What depth and RGB-D cameras of the selected robot measure, as points of the world. A cloud is placed where the camera was
// at the tick of its picture, and stays there until the next one.
import * as THREE from "three";
import { transform } from "../kinematics/pose";
import { type CameraPicture, type Cameras, type CameraWish, pixelsOf, showsOf } from "../model/cameras";
import { colourAt } from "../model/colour_maps";
import { cloudOf, pixelRays } from "../model/pixel_rays";
import type { ViewerState, World } from "../model/viewer_state";
import type { Stage } from "../view/stage";

/** A cloud of 200 columns is dense enough to see shapes. */
export const CLOUD_COLUMNS = 200;

interface Cloud {
    points: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
    tick: number;
    lens: string;
    rays: Float32Array;
}

export class PointClouds {
    private readonly clouds = new Map<string, Cloud>();

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly cameras: Cameras,
    ) {
        for (const signal of [state.selected, state.overlays, state.world] as { follow(act: () => void): unknown }[])
            signal.follow(() => this.ask());
    }

    private ask(): void {
        const world = this.state.world.value,
            robot = this.state.selected.value,
            wishes: CameraWish[] = [];
        if (world !== null && robot !== null && this.state.overlays.value.has("points"))
            world.fleet.type(robot).sensors.forEach((sensor, k) => {
                if (!showsOf(sensor).includes("depth")) return;
                for (const shows of showsOf(sensor)) wishes.push({ robot, sensor: k, shows, columns: CLOUD_COLUMNS });
            });
        this.cameras.want("clouds", wishes);
    }

    update(world: World | null): void {
        const robot = this.state.selected.value,
            on = world !== null && robot !== null && this.state.overlays.value.has("points"),
            shown = new Set<string>();
        if (on)
            world.fleet.type(robot).sensors.forEach((_, k) => {
                const depth = this.cameras.picture(robot, k, "depth");
                if (depth === null) return;
                const key = `${robot}.${k}`;
                shown.add(key);
                const colour = this.cameras.picture(robot, k, "color");
                this.show(key, depth, colour?.tick === depth.tick ? colour : null);
            });
        for (const [key, cloud] of this.clouds)
            if (!shown.has(key)) {
                this.stage.overlays.remove(cloud.points);
                cloud.points.geometry.dispose();
                this.clouds.delete(key);
            }
    }

    private cloud(key: string): Cloud {
        let cloud = this.clouds.get(key);
        if (cloud !== undefined) return cloud;
        const material = new THREE.PointsMaterial({
            size: 3,
            sizeAttenuation: false,
            vertexColors: true,
            toneMapped: false,
        });
        cloud = {
            points: new THREE.Points(new THREE.BufferGeometry(), material),
            tick: -1,
            lens: "",
            rays: new Float32Array(0),
        };
        cloud.points.frustumCulled = false;
        this.stage.overlays.add(cloud.points);
        this.clouds.set(key, cloud);
        return cloud;
    }

    private show(key: string, depth: CameraPicture, colour: CameraPicture | null): void {
        const cloud = this.cloud(key),
            { columns, rows, intrinsics, distortion, low = 0, high = 0 } = depth.about,
            lens = JSON.stringify([columns, rows, intrinsics, distortion]);
        if (cloud.tick === depth.tick || depth.values === null) return;
        if (cloud.lens !== lens) {
            cloud.lens = lens;
            cloud.rays = pixelRays(columns, rows, intrinsics, distortion);
        }
        cloud.tick = depth.tick;
        const { points, pixels } = cloudOf(depth.values, cloud.rays),
            colours = new Float32Array(points.length),
            painted = colour === null ? null : pixelsOf(colour),
            across = (colour?.about.columns ?? 0) / columns,
            down = (colour?.about.rows ?? 0) / rows;
        for (let i = 0; i < pixels.length; ++i) {
            points.set(transform(depth.about.pose, [points[3 * i], points[3 * i + 1], points[3 * i + 2]]), 3 * i);
            const at = pixels[i],
                [r, g, b] =
                    painted === null
                        ? colourAt("depth", (depth.values[at] - low) / Math.max(1e-9, high - low))
                        : painted.subarray(
                              ...place(
                                  at % columns,
                                  Math.floor(at / columns),
                                  across,
                                  down,
                                  colour?.about.columns ?? 0,
                              ),
                          );
            colours.set([LINEAR[r], LINEAR[g], LINEAR[b]], 3 * i);
        }
        const { geometry } = cloud.points;
        geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
        geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
    }
}

/** Where the pixel of another size begins, and ends. */
function place(column: number, row: number, across: number, down: number, columns: number): [number, number] {
    const at = 4 * (Math.floor((row + 0.5) * down) * columns + Math.floor((column + 0.5) * across));
    return [at, at + 3];
}

/** Colours are linear in the picture of the world. */
const LINEAR = Float32Array.from(
    { length: 256 },
    (_, value) => new THREE.Color().setRGB(value / 255, 0, 0, THREE.SRGBColorSpace).r,
);
