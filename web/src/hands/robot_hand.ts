// The hand in the picture. Select: a click chooses; with Shift, the selected robot takes hold of what is clicked. Move: a
// drag pulls the point where the robot was taken by a spring; in a paused run, with Shift, and where the base is fixed, it
// places the robot by pose orders. Push: a drag pulls an arrow, and orders that force for as long as it is held.
import * as THREE from "three";
import type { PointerHand } from "../camera/pointer";
import { composed, fromAxisAngle } from "../kinematics/pose";
import type { Bonding } from "../model/bonding";
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { throttled } from "../ui/throttle";
import { pick } from "../view/picking";
import type { Stage } from "../view/stage";
import type { PoseArray, Triple } from "../wire/messages";
import { gripOf, gripPoint, robotFrame } from "./grip";
import type { HandMark } from "./hand_mark";

const ORDER_INTERVAL_MS = 50;
/** Simulated time for which an order of a held robot lasts at real time; it is renewed far more often. */
const LEASE_S = 2;
/** Of a pull: so many N/kg at most. */
const PULL_ACCELERATION = 200;
/** For so long acts a push that was given while the run is paused. */
const LATER_S = 0.2;
const METRES_A_TURN_PX = 0.01;
/** Newton a metre of arrow and kilogram: a metre of arrow accelerates by this. */
const PUSH_ACCELERATION = 10;

interface Hold {
    robot: number;
    link: number;
    tool: "move" | "push";
    /** By pose orders, not by a spring. */
    places: boolean;
    grab: THREE.Vector3;
    /** The same point, in the link's frame. */
    grip: Triple;
    pose: PoseArray;
    moved: THREE.Vector3;
    turned: number;
    x: number;
    y: number;
    dragged: boolean;
}

export class RobotHand implements PointerHand {
    private hold: Hold | null = null;
    private timer = 0;
    private readonly sendForce: (hold: Hold) => void;
    private readonly sendPose: (robot: number, pose: PoseArray) => void;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly run: RunLink,
        private readonly mark: HandMark,
        private readonly bonding: Bonding,
        private readonly onFollow: (robot: number) => void,
        private readonly onOpen: (robot: number) => void,
    ) {
        this.sendForce = throttled(ORDER_INTERVAL_MS, (hold) => hold === this.hold && this.give(hold));
        this.sendPose = throttled(ORDER_INTERVAL_MS, (robot, pose) => void run.order(robot, { action: "pose", pose }));
    }

    press(x: number, y: number): boolean {
        const world = this.state.world.value,
            tool = this.state.tool.value;
        if (world === null || (tool !== "move" && tool !== "push")) return false;
        if (this.state.shown.value !== null) {
            this.run.notice.set({ text: "This is an earlier moment. Go back to now to move robots.", bad: false });
            return true;
        }
        const picked = pick(this.stage, world, x, y);
        if (picked === null) return false;
        this.state.selected.set(picked.robot);
        const type = world.fleet.type(picked.robot);
        this.hold = {
            robot: picked.robot,
            link: picked.link,
            tool,
            places: this.state.status.value?.paused === true || (type.links[picked.link]?.body ?? -1) < 0,
            grab: picked.point,
            grip: gripOf(world, picked.robot, picked.link, picked.point.toArray() as Triple),
            pose: robotFrame(world, picked.robot),
            moved: new THREE.Vector3(),
            turned: 0,
            x,
            y,
            dragged: false,
        };
        this.mark.begin(tool, picked.point);
        return true;
    }

    move(x: number, y: number, event: PointerEvent): void {
        const hold = this.hold;
        if (hold === null) return;
        hold.dragged ||= Math.hypot(x - hold.x, y - hold.y) > 3;
        if (!hold.dragged) return;
        if (hold.tool === "move" && event.shiftKey) this.placeInstead(hold);
        if (hold.tool === "move" && event.shiftKey) hold.turned += (x - hold.x) * METRES_A_TURN_PX;
        else if (hold.tool === "move" && event.altKey)
            hold.moved.z -=
                ((y - hold.y) * 1.1 * this.stage.camera.position.distanceTo(hold.grab)) / this.stage.viewport.height;
        else this.slide(hold, x, y);
        hold.x = x;
        hold.y = y;
        this.act(hold);
    }

    /** Over the horizontal plane through the point where the robot was taken. */
    private slide(hold: Hold, x: number, y: number): void {
        const plane = new THREE.Plane(new THREE.Vector3(0, 0, 1), -(hold.grab.z + hold.moved.z)),
            at = new THREE.Vector3();
        if (this.stage.ray(x, y).ray.intersectPlane(plane, at) === null || at.distanceTo(hold.grab) > 500) return;
        hold.moved.set(at.x - hold.grab.x, at.y - hold.grab.y, hold.moved.z);
    }

    private act(hold: Hold): void {
        const force = this.force(hold).length(),
            words = hold.tool === "push" ? `${force.toFixed(force < 10 ? 1 : 0)} N` : "";
        this.mark.move(hold.grab.clone().add(hold.moved), words);
        if (hold.tool === "move" && hold.places) return this.sendPose(hold.robot, this.target(hold));
        this.sendForce(hold);
        if (this.timer === 0) this.timer = window.setInterval(() => this.renew(), ORDER_INTERVAL_MS);
    }

    /** A hand at rest holds on; and the mark begins where the robot is held now. */
    private renew(): void {
        const hold = this.hold,
            world = this.state.world.value;
        if (hold === null || world === null) return this.stopTimer();
        this.sendForce(hold);
        if (hold.tool === "push") return;
        this.mark.begin(hold.tool, new THREE.Vector3(...gripPoint(world, hold.robot, hold.link, hold.grip)));
        this.mark.move(hold.grab.clone().add(hold.moved), "");
    }

    private stopTimer(): void {
        clearInterval(this.timer);
        this.timer = 0;
    }

    /** From a pull to pose orders, from where the robot is now. */
    private placeInstead(hold: Hold): void {
        const world = this.state.world.value;
        if (hold.places || world === null) return;
        if (this.timer !== 0) this.give(hold, true);
        this.stopTimer();
        hold.places = true;
        hold.pose = robotFrame(world, hold.robot);
        hold.grab = new THREE.Vector3(...gripPoint(world, hold.robot, hold.link, hold.grip));
        hold.moved.set(0, 0, 0);
    }

    /** The order of the force or the pull, which replaces the last one; `over`: that ends it. */
    private give(hold: Hold, over = false): void {
        const rtf = this.state.status.value?.rtf ?? 1,
            duration = LEASE_S * Math.max(1, rtf);
        if (hold.tool === "push") {
            const force = over ? ([0, 0, 0] as Triple) : (this.force(hold).toArray() as Triple);
            void this.run.order(hold.robot, {
                action: "wrench",
                link: hold.link,
                force,
                torque: [0, 0, 0],
                duration: over ? 1e-6 : duration,
                replaces: true,
            });
            return;
        }
        const mass = this.state.world.value?.fleet.type(hold.robot).mass ?? 1;
        void this.run.order(hold.robot, {
            action: "pull",
            link: hold.link,
            point: hold.grip,
            target: hold.grab.clone().add(hold.moved).toArray() as Triple,
            max_force: over ? 0 : PULL_ACCELERATION * mass,
            duration,
        });
    }

    /** In a paused run nothing would come of a push that ends when the hand lets go. */
    private pushLater(hold: Hold): void {
        const force = this.force(hold);
        void this.run.order(hold.robot, {
            action: "wrench",
            link: hold.link,
            force: force.toArray() as Triple,
            torque: [0, 0, 0],
            duration: LATER_S,
            replaces: true,
        });
        this.say(`${force.length().toFixed(1)} N push it for ${LATER_S} s from the next tick on.`);
    }

    private say(text: string): void {
        this.run.notice.set({ text: `The run is paused: ${text}`, bad: false });
    }

    private target(hold: Hold): PoseArray {
        const turned = composed(fromAxisAngle([0, 0, 1], hold.turned), [0, 0, 0, ...hold.pose.slice(3)]);
        return [
            hold.pose[0] + hold.moved.x,
            hold.pose[1] + hold.moved.y,
            hold.pose[2] + hold.moved.z,
            turned[3],
            turned[4],
            turned[5],
            turned[6],
        ];
    }

    private force(hold: Hold): THREE.Vector3 {
        const mass = this.state.world.value?.fleet.type(hold.robot).mass ?? 1;
        return new THREE.Vector3(hold.moved.x, hold.moved.y, 0).multiplyScalar(mass * PUSH_ACCELERATION);
    }

    release(cancelled: boolean): void {
        const hold = this.hold;
        const acts = this.timer !== 0;
        this.stopTimer();
        this.hold = null;
        this.mark.end();
        if (hold === null) return;
        const paused = this.state.status.value?.paused === true,
            places = hold.dragged && hold.tool === "move" && hold.places;
        if (acts && paused && !cancelled && hold.tool === "push") this.pushLater(hold);
        else if (acts) this.give(hold, true);
        else if (!cancelled && places) {
            this.sendPose(hold.robot, this.target(hold));
            if (paused) this.say("it will be there with the next tick.");
        }
    }

    click(x: number, y: number, event: PointerEvent): void {
        const world = this.state.world.value;
        if (world === null) return;
        const picked = pick(this.stage, world, x, y);
        if (picked !== null && this.bonding.take(picked.robot, picked.link)) return;
        if (picked !== null && event.shiftKey && this.bonding.takeBySelected(picked.robot, picked.link)) return;
        this.state.selected.set(picked?.robot ?? this.stage.markAt(x, y));
    }

    doubleClick(x: number, y: number): void {
        const robot = this.robotAt(x, y);
        if (robot !== null) this.onFollow(robot);
    }

    longPress(x: number, y: number): void {
        const robot = this.robotAt(x, y);
        if (robot !== null) this.onOpen(robot);
    }

    /** The robot that is drawn there, or whose mark is. */
    private robotAt(x: number, y: number): number | null {
        const world = this.state.world.value;
        return world === null ? null : (pick(this.stage, world, x, y)?.robot ?? this.stage.markAt(x, y));
    }
}
