// Own numbers of robots, in the protocol (docs/viewer-protocol.md): damping, limits and gains of joint axes, masses and
// friction of links, gravity and wind. Types of the JSON. null is no bound.

import type { Triple } from "./messages";

/** By name. */
export type NumberValues = Record<string, number | null>;

/** One axis of a joint, or a link. */
export type NumbersPlace = { joint: number; axis: number } | { link: number };

export type NumbersWish = { robot: number } & NumbersPlace;

/** The numbers that differ from the file, of a robot and all its joints and links. */
export interface OwnNumbers {
    joints?: { joint: number; axis: number; values: NumberValues }[];
    links?: { link: number; values: NumberValues }[];
    /** m/s^2 and m/s, world axes, in place of the world's. */
    gravity?: Triple;
    wind?: Triple;
}

export interface NumberRow {
    name: string;
    unit: string;
    value: number | null;
    /** The number of the file, where it differs. */
    file?: number | null;
    /** It may have no bound. */
    endless?: boolean;
}

/** All numbers of the place that this page wants. */
export type NumbersReport = {
    type: "numbers";
    scene: number;
    robot: number;
    tick: number;
    numbers: NumberRow[];
} & NumbersPlace;

/** Gravity and wind at a robot. `reset`: what is not named becomes that of the file. */
export type SurroundingsAction = { action: "surroundings"; gravity?: Triple; wind?: Triple; reset?: boolean };

/** `reset`: all that are not named become those of the file. */
export type NumbersAction = { values?: NumberValues; reset?: boolean } & (
    { action: "joint_parameters"; joint: number; axis: number } | { action: "link_parameters"; link: number }
);
