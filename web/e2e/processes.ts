// Processes that the page's tests start: how they end, and a Client in C++ that joins a run.
import { type ChildProcess, spawn } from "node:child_process";

/** The real program, where it is tested. */
export const PROGRAM = process.env.ROBOSS_PROGRAM ?? "";

function ended(child: ChildProcess): Promise<void> {
    return new Promise((resolve) =>
        child.exitCode !== null || child.signalCode !== null ? resolve() : child.once("exit", () => resolve()),
    );
}

export async function end(child: ChildProcess, signal: NodeJS.Signals = "SIGTERM"): Promise<void> {
    child.kill(signal);
    const hard = setTimeout(() => child.kill("SIGKILL"), 5000);
    await ended(child);
    clearTimeout(hard);
}

/** What a Client in C++ (examples/watch_robot) says of a robot. */
export interface Told {
    time: number;
    robot: string;
    position: [number, number, number];
    velocity: [number, number, number];
    joints: Record<string, { position: number; velocity: number; mode: string; target: number }[]>;
}

/** A Client in C++ that joined the run: what it said last of each robot. */
export class CppClient {
    readonly told = new Map<string, Told>();
    private said = "";
    private readonly child: ChildProcess;

    /** `network`: options that lead it to the run. */
    constructor(network: string[], robots: string[]) {
        const library = process.env.ROBOSS_WATCH_ROBOT ?? "",
            env = { ...process.env, ROBOSS_WATCH: robots.join(",") };
        this.child = spawn(PROGRAM, ["client", library, "--quiet", ...network], { env });
        this.child.stdout?.on("data", (text: Buffer) => this.hear(text.toString()));
    }

    private hear(text: string): void {
        const lines = (this.said + text).split("\n");
        this.said = lines.pop() ?? "";
        for (const line of lines.filter((one) => one.startsWith("{"))) {
            const told = JSON.parse(line) as Told;
            this.told.set(told.robot, told);
        }
    }

    of(robot: string): Told {
        const told = this.told.get(robot);
        if (told === undefined) throw new Error(`the Client says nothing of ${robot}`);
        return told;
    }

    stop(): Promise<void> {
        return end(this.child);
    }
}
