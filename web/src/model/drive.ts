// How a robot is driven by hand: by the command of its own drive where it has one, else by velocity orders.
import type { TypeInfo } from "../wire/messages";
import type { ChannelInfo } from "../wire/onboard";

export interface Drive {
    channel: ChannelInfo;
    /** Places of the values: forwards in m/s, turning left in rad/s. */
    forwards: number;
    turning: number;
}

function placeOf(channel: ChannelInfo, names: readonly string[]): number {
    return channel.values.findIndex((value) => names.includes(value.name));
}

function driveBy(channel: ChannelInfo): Drive | null {
    const forwards = placeOf(channel, ["linear_x", "linear"]),
        turning = placeOf(channel, ["angular_z", "angular"]);
    return channel.list || forwards < 0 || turning < 0 ? null : { channel, forwards, turning };
}

/** The drive of robots of this type; null: they have none. */
export function driveOf(type: TypeInfo): Drive | null {
    const drives = (type.channels ?? []).map(driveBy).filter((drive) => drive !== null);
    return drives.find((drive) => /(^|\/)cmd_vel$/.test(drive.channel.name)) ?? drives[0] ?? null;
}

/** The values of the drive's command; those that it does not steer are 0. */
export function driveValues(drive: Drive, speed: number, turn: number): number[] {
    const values = new Array<number>(drive.channel.values.length).fill(0);
    values[drive.forwards] = speed;
    values[drive.turning] = turn;
    return values;
}
