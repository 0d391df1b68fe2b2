// The colour that a robot has by its model: that of its first visual, with the mean of its picture.
import type { World } from "../model/viewer_state";
import { meanColour } from "./finishes";

/** Red, green and blue, 0 to 1, sRGB. */
export function ownColour(world: World, robot: number): [number, number, number] {
    const visual = world.fleet.type(robot).links.find((link) => link.visuals.length > 0)?.visuals[0],
        rgb = visual?.rgb ?? [0.6, 0.6, 0.6],
        picture = world.loaded.pictures.get(visual?.finish?.colour ?? ""),
        over = picture === undefined ? [1, 1, 1] : meanColour(picture);
    return [rgb[0] * over[0], rgb[1] * over[1], rgb[2] * over[2]];
}

export function ownCss(world: World, robot: number): string {
    return `rgb(${ownColour(world, robot)
        .map((part) => Math.round(part * 255))
        .join(" ")})`;
}
