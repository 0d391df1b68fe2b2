// The binary messages between gateway and page (docs/viewer-protocol.md): places of fields in bytes, limits, names.
// Made by tools/viewer_protocol from src/gateway/protocol.json: change that and run the tool.

export const VERSION = 1;
export const SUBPROTOCOL = 'roboss.1';
export const MESSAGE_BYTES_MAX = 65536;
export const ADDITION_BYTES_MAX = 4194304;
export const MESSAGES_A_SECOND_MAX = 200;
export const WATCHED_ROBOTS_MAX = 8;
export const WATCHED_CAMERAS_MAX = 16;
export const PICTURE_COLUMNS_MAX = 1280;
export const RATE_MAX = 60;
export const FLAG_WHOLE = 1;
export const FLAG_REST = 2;
export const FLAG_PREVIEW = 4;

export const STATE_KIND = 1;
export const STATE_BYTES = 28;
/** Of an entry, without its coordinates (two bytes each). */
export const STATE_ENTRY_BYTES = 24;
export const STATE_ENTRY_ROBOT_AT = 0;
export const STATE_ENTRY_POSITION_AT = 4;
export const STATE_ENTRY_ORIENTATION_AT = 16;
export const STATE_ENTRY_COORDINATES_AT = 24;
export const STATE_ORIENTATION_SCALE = 32767;
export const STATE_COORDINATE_SCALE = 32767;

export interface StateHeader {
    kind: number;
    flags: number;
    reserved: number;
    scene: number;
    tick: number;
    time: number;
    robots: number;
}

export function readStateHeader(view: DataView): StateHeader {
    return {
        kind: view.getUint8(0),
        flags: view.getUint8(1),
        reserved: view.getUint16(2, true),
        scene: view.getUint32(4, true),
        tick: view.getFloat64(8, true),
        time: view.getFloat64(16, true),
        robots: view.getUint32(24, true),
    };
}

export const PICTURE_KIND = 2;
export const PICTURE_BYTES = 36;

export interface PictureHeader {
    kind: number;
    reserved: number;
    reserved2: number;
    scene: number;
    tick: number;
    time: number;
    robot: number;
    sensor: number;
    about_bytes: number;
}

export function readPictureHeader(view: DataView): PictureHeader {
    return {
        kind: view.getUint8(0),
        reserved: view.getUint8(1),
        reserved2: view.getUint16(2, true),
        scene: view.getUint32(4, true),
        tick: view.getFloat64(8, true),
        time: view.getFloat64(16, true),
        robot: view.getUint32(24, true),
        sensor: view.getUint32(28, true),
        about_bytes: view.getUint32(32, true),
    };
}

/** What a page can draw beside robots and scenery. */
export const PAGE_OVERLAYS = [
    'rays',
    'points',
    'tracks',
    'compass',
    'contacts',
    'radio',
    'bounds',
    'spheres',
    'islands',
    'names',
    'collisions',
    'frames',
    'masses',
    'inertia',
    'axes',
    'labels',
    'wireframe',
    'transparent',
] as const;

export type Overlay = 'contacts' | 'radio' | 'bounds' | 'groups';

export type OrderAction = 'pose' | 'velocity' | 'wrench' | 'joint' | 'joint_parameters' | 'link_parameters' |
    'surroundings' | 'command' | 'attach' | 'detach';

export type MotorMode = 'passive' | 'velocity' | 'position' | 'effort';
