// Where robots are seen in the picture, and what the hand does there.
import type { Page } from "playwright-core";
import { until, WAIT_MS } from "./bench";

/** Numbers that the page has of a robot, and where it is seen. */
export interface Seen {
    x: number;
    y: number;
    z: number;
    left: number;
    top: number;
}

export function seen(page: Page, robot: number): Promise<Seen> {
    return page.evaluate((r) => {
        const { state, stage } = window.roboss;
        const base = state.world.value?.history.drawn.base ?? new Float32Array(7),
            at = r * 7,
            box = stage.canvas.getBoundingClientRect();
        const place = stage.camera.position
            .clone()
            .set(base[at], base[at + 1], base[at + 2])
            .project(stage.camera);
        return {
            x: base[at],
            y: base[at + 1],
            z: base[at + 2],
            left: box.left + ((place.x + 1) / 2) * box.width,
            top: box.top + ((1 - place.y) / 2) * box.height,
        };
    }, robot);
}

/** Waits until the camera has arrived and the robot is seen at the same place for some frames. */
export async function resting(page: Page, robot: number): Promise<Seen> {
    let before = await seen(page, robot),
        same = 0;
    await until(
        "the picture rests",
        async () => {
            const arrived = await page.evaluate(() => {
                const { goal, now } = window.roboss.views.rig,
                    off = Math.hypot(...goal.target.map((value, k) => value - now.target[k]));
                return off < 0.002 * goal.distance && Math.abs(goal.distance / now.distance - 1) < 0.002;
            });
            const is = await seen(page, robot);
            same = arrived && Math.hypot(is.left - before.left, is.top - before.top) < 0.5 ? same + 1 : 0;
            before = is;
            return same >= 4;
        },
        WAIT_MS,
    );
    return before;
}

/** Where a click meets this robot, searched around its base; null: others hide it. */
export function visiblePoint(page: Page, robot: number, around: Seen): Promise<{ left: number; top: number } | null> {
    return page.evaluate(
        ([wanted, left, top]) => {
            for (let ring = 0; ring <= 6; ++ring)
                for (let k = 0; k < 8; ++k) {
                    const at = {
                        left: left + 6 * ring * Math.cos((k * Math.PI) / 4),
                        top: top + 6 * ring * Math.sin((k * Math.PI) / 4),
                    };
                    if (window.roboss.robotAt(at.left, at.top) === wanted) return at;
                }
            return null;
        },
        [robot, around.left, around.top],
    );
}

/** Takes a robot with the hand and drops it some pixels away; where it was before. */
export async function drag(page: Page, robot: number, right: number, down: number): Promise<Seen> {
    await page.getByRole("button", { name: "Follow", exact: true }).last().click();
    await page.waitForTimeout(1500);
    await page.getByRole("button", { name: "Orbit" }).click();
    await page.getByLabel("Move a robot").click();
    const from = await seen(page, robot);
    await page.mouse.move(from.left, from.top);
    await page.mouse.down();
    await page.mouse.move(from.left + right / 2, from.top + down / 2, { steps: 6 });
    await page.mouse.move(from.left + right, from.top + down, { steps: 6 });
    const there = async () => {
        const at = await seen(page, robot);
        return Math.hypot(at.left - from.left - right, at.top - from.top - down) < 25;
    };
    await until("it follows the hand", there, 5000).catch(() => null); // a spring pulls it: wheels may hold it back
    await page.mouse.up();
    await page.getByLabel("Select", { exact: true }).click();
    return from;
}
