// Where the camera is, as numbers: a target, the direction from it, and a distance; z is up. Motion is damped: what the
// person asks for is the goal, what is drawn runs after it.
import type { CameraWords } from "../model/address";

export const ELEVATION_MIN = -0.2;
export const ELEVATION_MAX = Math.PI / 2 - 0.001;
const DISTANCE_MIN = 0.15;
const DISTANCE_MAX = 4000;

export class CameraRig {
    readonly goal: CameraWords = { target: [0, 0, 0], azimuth: -1.1, elevation: 0.6, distance: 40 };
    /** At most so far from the target: what stands between would hide it. */
    clear = Infinity;
    private squeezed = Infinity;
    orthographic = false;
    readonly now: CameraWords = { target: [0, 0, 0], azimuth: -1.1, elevation: 0.6, distance: 40 };

    /** What is drawn is what was asked for, as far as one sees. */
    get arrived(): boolean {
        const { goal, now } = this,
            off = Math.hypot(...goal.target.map((value, k) => value - now.target[k])),
            turn = Math.hypot(goal.azimuth - now.azimuth, goal.elevation - now.elevation);
        return off < 0.003 * goal.distance && turn < 0.003 && Math.abs(goal.distance / now.distance - 1) < 0.003;
    }

    /** Goes there at once. */
    jump(words: CameraWords): void {
        for (const place of [this.goal, this.now]) {
            place.target = [...words.target];
            place.azimuth = words.azimuth;
            place.elevation = words.elevation;
            place.distance = words.distance;
        }
    }

    turn(azimuth: number, elevation: number): void {
        this.goal.azimuth += azimuth;
        this.goal.elevation = Math.max(ELEVATION_MIN, Math.min(ELEVATION_MAX, this.goal.elevation + elevation));
    }

    zoom(factor: number): void {
        this.goal.distance = Math.max(DISTANCE_MIN, Math.min(DISTANCE_MAX, this.goal.distance * factor));
    }

    /** Moves the target along the ground: right and forwards as the camera sees them, in metres. */
    pan(right: number, forwards: number, up = 0): void {
        const s = Math.sin(this.goal.azimuth),
            c = Math.cos(this.goal.azimuth);
        this.goal.target[0] += -s * right - c * forwards;
        this.goal.target[1] += c * right - s * forwards;
        this.goal.target[2] = Math.max(-5, this.goal.target[2] + up);
    }

    /** Turns the eye about itself, as one looks around while flying. */
    look(azimuth: number, elevation: number): void {
        const eye = this.eye(this.goal);
        this.turn(azimuth, elevation);
        const after = this.eye(this.goal);
        for (let k = 0; k < 3; ++k) this.goal.target[k] += eye[k] - after[k];
    }

    /** Carries target and drawn target along with something that moves, without lag. */
    carry(target: readonly number[]): void {
        for (let k = 0; k < 3; ++k) {
            this.now.target[k] += target[k] - this.goal.target[k];
            this.goal.target[k] = target[k];
        }
    }

    advance(seconds: number): void {
        const f = 1 - Math.exp(-14 * seconds);
        for (let k = 0; k < 3; ++k) this.now.target[k] += f * (this.goal.target[k] - this.now.target[k]);
        this.now.azimuth += f * (this.goal.azimuth - this.now.azimuth);
        this.now.elevation += f * (this.goal.elevation - this.now.elevation);
        const free = Math.min(this.clear, this.now.distance * 1.05);
        if (this.squeezed === Infinity || this.clear === Infinity) this.squeezed = this.clear;
        else
            this.squeezed +=
                (free < this.squeezed ? 1 - Math.exp(-30 * seconds) : 1 - Math.exp(-3 * seconds)) *
                (free - this.squeezed);
        this.now.distance *= Math.pow(this.goal.distance / this.now.distance, f);
    }

    eye(place: CameraWords = this.now): [number, number, number] {
        const distance = Math.min(place.distance, this.squeezed),
            flat = Math.cos(place.elevation) * distance;
        return [
            place.target[0] + Math.cos(place.azimuth) * flat,
            place.target[1] + Math.sin(place.azimuth) * flat,
            place.target[2] + Math.sin(place.elevation) * distance,
        ];
    }
}
