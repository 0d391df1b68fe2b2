// What robots with on-board controllers, moving surfaces and bonds add to the protocol (docs/viewer-protocol.md): types of
// the JSON. Each part is there only where a robot has some.
import type { Triple, Visual } from "./messages";

/** A command that robots of a type take. */
export interface ChannelInfo {
    name: string;
    /** It has any number of rows of `values`. */
    list: boolean;
    values: { name: string; unit: string }[];
}

/** How a surface moves along its shape: a point p with the normal n by linear + angular x p + belt x n (m/s, rad/s). */
export interface SurfaceMotion {
    linear: Triple;
    angular: Triple;
    belt?: Triple;
}

/** Scenery whose surface moves: always as it says here, or as the state of `robot` says of `link`. */
export interface FlowInfo extends Partial<SurfaceMotion> {
    shape: Visual;
    robot?: number;
    link?: number;
    /** m, world: the point that `angular` turns about. */
    at?: Triple;
}

/** The last command of a channel. */
export interface ChannelReport {
    /** -1: there was none. */
    tick: number;
    values: (number | null)[];
}

export interface SurfaceReport extends SurfaceMotion {
    link: number;
}

/** Of a robot that holds, or (in `held_by`) that is held; then `other` is the holder. -1: the scenery. */
export interface BondReport {
    link: number;
    other: number;
    other_link: number;
    force: number | null;
    torque: number | null;
    /** null: it never lets go. */
    max_force: number | null;
    max_torque: number | null;
}

/** Between links of two robots; `robot` holds. `other` -1 is the scenery. */
export interface BondInfo {
    robot: number;
    link: number;
    other: number;
    other_link: number;
    /** m, in the holder's link: where it holds. */
    point?: Triple;
}

/** Surfaces in motion and bonds of all robots. */
export interface Extras {
    type: "extras";
    scene: number;
    tick: number;
    surfaces: (SurfaceReport & { robot: number })[];
    bonds: BondInfo[];
}

export type OnboardAction =
    | { action: "command"; name: string; values: number[] }
    | {
          action: "attach";
          link: number;
          other: number;
          other_link: number;
          reach: number;
          max_force?: number;
          max_torque?: number;
      }
    | { action: "detach"; other?: number };
