// The JSON that page and gateway exchange, as types (docs/viewer-protocol.md says what each means). SI units and
// radians; a pose is [x, y, z, qw, qx, qy, qz].
import type { BondReport, ChannelInfo, ChannelReport, Extras, FlowInfo, OnboardAction, SurfaceReport } from "./onboard";
import type { LightInfo, LookInfo } from "./look";
import type { NumbersAction, NumbersReport, NumbersWish, OwnNumbers, SurroundingsAction } from "./numbers";
import type { StepProfile } from "./profile";
import type { OverlayReport } from "./overlay";
import type { Roles } from "./roles";
import type { PreviewInfo, Timeline } from "./timeline";
import type { Visual } from "./visual";

export type { Finish, Visual } from "./visual";
export type PoseArray = [number, number, number, number, number, number, number];
export type Triple = [number, number, number];

/** Which way a body's coordinates go from one value to another; "none": the base, which has no joint coordinates. */
export type Course = "none" | "line" | "circle" | "quaternion";

export interface BodyInfo {
    parent: number;
    frame: PoseArray;
    axis: Triple;
    /** Radians about the axis and metres along it per unit of the coordinate. */
    turn: number;
    slide: number;
    course: Course;
    q: number;
    width: number;
}

export interface LinkInfo {
    name: string;
    body: number;
    frame: PoseArray;
    visuals: Visual[];
    collisions: Visual[];
    lights?: LightInfo[];
    /** kg; missing: it has none of its own. */
    mass?: number;
    /** Centre of mass, in its frame; inertia about that, kg m^2: xx, yy, zz, xy, xz, yz. */
    centre?: Triple;
    inertia?: number[];
}

export interface JointInfo {
    name: string;
    kind: string;
    body: number;
    axes: number;
    /** Of the position along each axis: "rad" or "m". */
    units: string[];
    q: number;
    lower: (number | null)[];
    upper: (number | null)[];
    max_effort: (number | null)[];
    max_velocity: (number | null)[];
}

export interface SensorInfo {
    name: string;
    kind: string;
    link: number;
    frame: PoseArray;
    /** Of its readings, by name. */
    units?: Record<string, string>;
    samples?: number;
    min_angle?: number;
    max_angle?: number;
    vertical_samples?: number;
    vertical_min_angle?: number;
    vertical_max_angle?: number;
    range_min?: number;
    range_max?: number;
    /** Of a camera, pixels. */
    width?: number;
    height?: number;
}

export interface TypeInfo {
    name: string;
    /** Equal for types whose robots a step treats alike: they differ in names, topics, sensors and looks only. */
    like: number;
    free_base: boolean;
    /** Its links are scenery: it has only sensors and controllers. */
    static?: boolean;
    mass: number;
    reach: number;
    origin: PoseArray;
    bodies: BodyInfo[];
    links: LinkInfo[];
    joints: JointInfo[];
    sensors: SensorInfo[];
    channels?: ChannelInfo[];
    ranges: number[];
}

export interface SceneInfo {
    scene: number;
    world: string;
    dt: number;
    /** m/s^2 and m/s, world axes. No wind: the air stands still. */
    gravity: Triple;
    wind?: Triple;
    seed?: number;
    types: TypeInfo[];
    robots: { name: string; type: number }[];
    statics: Visual[];
    flows?: FlowInfo[];
    look?: LookInfo;
    groups_max: number;
}

/** A second, to (in) and from (out) the Controller. */
export interface MessageRate {
    in: number;
    out: number;
    bytes_in: number;
    bytes_out: number;
}

export interface MemberStatus {
    id: number;
    name: string;
    threads: number;
    robots: number;
    islands: number;
    load: number;
    step_us: number;
    state: string;
    messages?: MessageRate;
    /** The run started it as a process, and can kill it. */
    own_process?: boolean;
}

export interface Status {
    type: "status";
    world: string;
    time_s: number;
    tick: number;
    paused: boolean;
    speed: string;
    simulators: number;
    windows?: number;
    islands?: number;
    window_ticks?: number;
    windows_repeated?: number;
    efficiency?: number | null;
    model_hash?: string;
    state_hash?: string;
    branch?: number | string;
    journal?: { first_s: number; last_s: number; bytes?: number; mb_per_min?: number } | null;
    /** Serial of the timeline. */
    timeline?: number;
    /** A recorded run is stepped again. */
    replay?: boolean;
    members?: MemberStatus[];
    losses?: number;
    migrations?: number;
    messages?: MessageRate;
    recoveries?: number;
    rtf?: number | null;
    viewers?: number;
    sent_bytes?: number;
}

export interface Groups {
    type: "groups";
    scene: number;
    simulator: number[];
    island: number[];
}

export interface MotorReport {
    mode: string;
    target: number;
    effort: number;
    max_effort?: number | null;
}

export interface JointReport {
    position: number[];
    velocity: number[];
    motors?: MotorReport[];
}

export interface SensorReport {
    ranges?: (number | null)[];
    position?: number[];
    velocity?: number[];
    /** GPS: where it says that it is, in the world. */
    world?: number[];
    /** Compass: the sensor's frame in the world, w x y z. */
    orientation?: number[];
    /** When it was measured, s. */
    taken?: number;
    [field: string]: unknown;
}

/** What a robot's own state remembers of a contact; `other` -1 is scenery. */
export interface RobotContact {
    other: number;
    normal_force: number;
}

export interface RobotReport {
    type: "robot";
    scene: number;
    robot: number;
    tick: number;
    time: number;
    pose: PoseArray;
    linear: Triple;
    angular: Triple;
    joints: JointReport[];
    sensors: (SensorReport | null)[];
    contacts: RobotContact[];
    /** False: of those with robots before it in the list, only those with watched ones are known. */
    all_contacts?: boolean;
    channels?: ChannelReport[];
    surfaces?: SurfaceReport[];
    bonds?: BondReport[];
    held_by?: BondReport[];
    /** Numbers that differ from the file. */
    own?: OwnNumbers;
}

export interface Hello {
    type: "hello";
    version: number;
    scene: number;
    world: string;
    journal: boolean;
    rate: number;
    program: string;
    /** Why this page was disconnected a moment ago, if it was. */
    dropped?: { why: string; code: string };
}

export interface Answer {
    type: "answer";
    id: number;
    done: boolean;
    text: string;
    code?: string; // of a refusal
    preview?: PreviewInfo; // the State of that moment follows
}

export type Incoming =
    | Hello
    | { type: "scene"; scene: number }
    | Status
    | Groups
    | RobotReport
    | NumbersReport
    | OverlayReport
    | StepProfile
    | Extras
    | Answer
    | Roles
    | { type: "over"; reason: string; failed?: boolean }
    | Timeline
    | { type: "no_pictures"; scene: number; text: string; code: string }
    | { type: "notice"; text: string };

/** A spring from a point of a link (in its frame) to a point of the world; max_force 0 lets go. */
export interface PullAction {
    action: "pull";
    link: number;
    point: Triple;
    target: Triple;
    max_force: number;
    duration: number;
}

export type OrderAction =
    | { action: "pose"; pose: PoseArray }
    | { action: "velocity"; linear: Triple; angular: Triple }
    | { action: "wrench"; link: number; force: Triple; torque: Triple; duration: number; replaces?: boolean }
    | PullAction
    | { action: "joint"; joint: number; axis: number; mode: string; target: number; max_effort?: number }
    | NumbersAction
    | SurroundingsAction
    | OnboardAction;

export interface Watch {
    robots: number[];
    overlays: string[];
    rate: number;
    cameras?: { robot: number; sensor: number; columns: number; depth: boolean }[];
    numbers?: NumbersWish;
}
