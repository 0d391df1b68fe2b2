// The hand in the picture. Select: a click chooses. Move: a drag carries a robot over the ground and orders its
// pose. With Shift, the selected robot takes hold of it. Push: a drag pulls an arrow from where the robot was taken,
// and orders that force for as long as it is held.
import * as THREE from "three";
import type { PointerHand } from "../camera/pointer";
import { composed, fromAxisAngle } from "../kinematics/pose";
import { bodyAt, placeBodies } from "../kinematics/tree";
import type { Bonding } from "../model/bonding";
import type { RunLink } from "../model/run_link";
import type { ViewerState, World } from "../model/viewer_state";
import { throttled } from "../ui/throttle";
import { pick } from "../view/picking";
import type { Stage } from "../view/stage";
import type { PoseArray, Triple } from "../wire/messages";
import type { HandMark } from "./hand_mark";

const ORDER_INTERVAL_MS = 50;
const PUSH_MS = 50;
const PUSH_S = 0.1;
const METRES_A_TURN_PX = 0.01;
/** Newton a metre of arrow and kilogram: a metre of arrow accelerates by this. */
const PUSH_ACCELERATION = 10;

interface Hold {
    robot: number;
    tool: "move" | "push";
    grab: THREE.Vector3;
    pose: PoseArray;
    moved: THREE.Vector3;
    turned: number;
    x: number;
    y: number;
    dragged: boolean;
}

export class RobotHand implements PointerHand {
    private hold: Hold | null = null;
    private pushTimer = 0;
    private readonly sendPose: (robot: number, pose: PoseArray) => void;

    constructor(
        private readonly stage: Stage,
        private readonly state: ViewerState,
        private readonly run: RunLink,
        private readonly mark: HandMark,
        private readonly bonding: Bonding,
        private readonly onFocus: (robot: number) => void,
    ) {
        this.sendPose = throttled(ORDER_INTERVAL_MS, (robot, pose) => void run.order(robot, { action: "pose", pose }));
    }

    press(x: number, y: number): boolean {
        const world = this.state.world.value,
            tool = this.state.tool.value;
        if (world === null || tool === "select") return false;
        const picked = pick(this.stage, world, x, y);
        if (picked === null) return false;
        this.state.selected.set(picked.robot);
        this.hold = {
            robot: picked.robot,
            tool,
            grab: picked.point,
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
        if (hold.tool === "move" && event.shiftKey) hold.turned += (x - hold.x) * METRES_A_TURN_PX;
        else if (hold.tool === "move" && event.altKey)
            hold.moved.z -=
                ((y - hold.y) * 1.1 * this.stage.camera.position.distanceTo(hold.grab)) /
                this.stage.canvas.clientHeight;
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
        if (hold.tool === "move") {
            const target = this.target(hold);
            this.mark.move(hold.grab.clone().add(hold.moved), "");
            this.sendPose(hold.robot, target);
            return;
        }
        const force = this.force(hold);
        this.mark.move(hold.grab.clone().add(hold.moved), `${force.length().toFixed(force.length() < 10 ? 1 : 0)} N`);
        if (this.pushTimer === 0) this.pushTimer = window.setInterval(() => this.push(), PUSH_MS);
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

    private push(): void {
        const hold = this.hold;
        if (hold === null) return;
        const force = this.force(hold).toArray() as Triple;
        void this.run.order(hold.robot, { action: "wrench", link: 0, force, torque: [0, 0, 0], duration: PUSH_S });
    }

    release(cancelled: boolean): void {
        const hold = this.hold;
        clearInterval(this.pushTimer);
        this.pushTimer = 0;
        this.hold = null;
        this.mark.end();
        if (hold !== null && !cancelled && hold.dragged && hold.tool === "move")
            this.sendPose(hold.robot, this.target(hold));
    }

    click(x: number, y: number, event: PointerEvent): void {
        const world = this.state.world.value;
        if (world === null) return;
        const picked = pick(this.stage, world, x, y);
        if (picked !== null && this.bonding.take(picked.robot, picked.link)) return;
        if (picked !== null && event.shiftKey && this.bonding.takeBySelected(picked.robot, picked.link)) return;
        this.state.selected.set(picked?.robot ?? null);
    }

    doubleClick(x: number, y: number): void {
        const world = this.state.world.value,
            picked = world === null ? null : pick(this.stage, world, x, y);
        if (picked !== null) this.onFocus(picked.robot);
    }
}

/** Where the robot's own frame (its SDF model frame) is now: what a pose order moves. */
export function robotFrame(world: World, robot: number): PoseArray {
    const type = world.fleet.type(robot),
        { drawn } = world.history,
        bodies = new Float64Array((type.bodies.length + 1) * 7);
    placeBodies(type, drawn.base, robot * 7, drawn.joints, world.fleet.firstCoordinate[robot], bodies);
    const at = bodyAt(type.links[0]?.body ?? -1);
    return composed(Array.from(bodies.subarray(at, at + 7)), type.origin) as PoseArray;
}
