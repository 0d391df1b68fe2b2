// Cameras of robots: which pictures the page's parts want, and the latest of each. The gateway renders only what is wanted.
import type { SensorInfo } from "../wire/messages";
import { numbersOf, type PictureAbout, type PictureMessage, type Shows } from "../wire/picture";
import { Signal } from "./signal";

/** What each kind of camera shows. */
const SHOWS: Record<string, readonly Shows[]> = {
    camera: ["color"],
    "depth camera": ["depth"],
    "rgbd camera": ["color", "depth"],
    "segmentation camera": ["labels"],
    "box camera": ["boxes"],
    "thermal camera": ["temperature"],
};
export const showsOf = (sensor: SensorInfo): readonly Shows[] => SHOWS[sensor.kind] ?? [];

export interface CameraWish {
    robot: number;
    sensor: number;
    shows: Shows;
    /** At most. */
    columns: number;
}
const keyOf = (one: { robot: number; sensor: number; shows: Shows }): string =>
    `${one.robot}.${one.sensor}.${one.shows}`;

export interface CameraPicture {
    robot: number;
    sensor: number;
    tick: number;
    time: number;
    about: PictureAbout;
    /** Of colours and boxes. */
    image: ImageBitmap | null;
    /** Pixels, red green blue alpha, of colours only when they are asked for: pixelsOf(). */
    pixels: Uint8ClampedArray | null;
    /** Of depths and temperatures. */
    values: Float32Array | null;
}

function pixels(image: ImageBitmap): Uint8ClampedArray | null {
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const draw = canvas.getContext("2d", { willReadFrequently: true });
    draw?.drawImage(image, 0, 0);
    return draw?.getImageData(0, 0, image.width, image.height).data ?? null;
}

export function pixelsOf(picture: CameraPicture): Uint8ClampedArray | null {
    if (picture.pixels === null && picture.image !== null) picture.pixels = pixels(picture.image);
    return picture.pixels;
}

async function decoded({ robot, sensor, tick, time, about, file }: PictureMessage): Promise<CameraPicture> {
    const image = await createImageBitmap(file, { premultiplyAlpha: "none", colorSpaceConversion: "none" }),
        picture: CameraPicture = { robot, sensor, tick, time, about, image, pixels: null, values: null };
    if (about.shows === "color" || about.shows === "boxes") return picture;
    picture.pixels = pixels(image);
    picture.image = null;
    image.close();
    if (picture.pixels !== null && about.shows !== "labels")
        picture.values = numbersOf(picture.pixels, about.low ?? 0, about.high ?? 0);
    return picture;
}

export class Cameras {
    /** What is wanted by anyone, each once, in the largest size. */
    readonly wishes = new Signal<readonly CameraWish[]>([]);
    /** Grows with every picture. */
    readonly taken = new Signal(0);
    /** Why there are no pictures; null: there are, or nobody knows. */
    readonly trouble = new Signal<string | null>(null);
    private readonly wanted = new Map<string, readonly CameraWish[]>();
    private readonly pictures = new Map<string, CameraPicture>();
    private serial = 0;
    private readonly newest = new Map<string, number>();

    /** What one part of the page wants from now on. */
    want(part: string, wishes: readonly CameraWish[]): void {
        this.wanted.set(part, wishes);
        const merged = new Map<string, CameraWish>();
        for (const wish of [...this.wanted.values()].flat()) {
            const key = keyOf(wish),
                columns = Math.max(wish.columns, merged.get(key)?.columns ?? 0);
            merged.set(key, { ...wish, columns });
        }
        const next = [...merged.values()];
        if (JSON.stringify(next) !== JSON.stringify(this.wishes.value)) this.wishes.set(next);
    }

    picture(robot: number, sensor: number, shows: Shows): CameraPicture | null {
        return this.pictures.get(keyOf({ robot, sensor, shows })) ?? null;
    }

    async take(message: PictureMessage): Promise<void> {
        const key = keyOf({ ...message, shows: message.about.shows }),
            serial = ++this.serial;
        this.newest.set(key, serial);
        const picture = await decoded(message);
        if (this.newest.get(key) !== serial) return picture.image?.close();
        this.pictures.get(key)?.image?.close();
        this.pictures.set(key, picture);
        this.trouble.set(null);
        this.taken.set(this.taken.value + 1);
    }

    /** Another scene: robots have other numbers. */
    clear(): void {
        for (const picture of this.pictures.values()) picture.image?.close();
        this.pictures.clear();
        this.newest.clear();
        this.trouble.set(null);
        this.taken.set(this.taken.value + 1);
    }
}
