// What the page's tests stand on: a run to look at (the mock gateway, or the real program where ROBOSS_PROGRAM names it),
// Debian's Chromium drawing in software, and a page whose every console error is kept.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { type Browser, chromium, type Page } from "playwright-core";
import type { Hooks } from "../src/main";
import { CppClient, end, PROGRAM } from "./processes";

export { type CppClient, PROGRAM };

declare global {
    interface Window {
        roboss: Hooks;
    }
}

const TESTS = join(dirname(fileURLToPath(import.meta.url)), "..");
const WEB = process.env.ROBOSS_WEB ?? join(TESTS, "../dist");
const CHROMIUM =
    process.env.CHROMIUM ??
    ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => existsSync(path));
export const WAIT_MS = 180_000;
const LIMIT = { timeout: 5 * WAIT_MS };

export interface Run {
    url: string;
    port: number;
    /** Options that lead a member to a run of RunOptions::cluster. */
    network: string[];
    stop(signal?: NodeJS.Signals): Promise<void>;
}

export interface RunOptions {
    cars?: number;
    port?: number;
    /** Of the program: a file beside the world that ROBOSS_WORLD names. */
    world?: string;
    /** Arguments of the program for something else than a run; it may write files into the folder. */
    program?: (folder: string, world: string) => string[];
    /** More arguments of the program. */
    more?: string[];
    /** All in one process. */
    single?: boolean;
    /** A Controller and two Simulators in processes of their own, which others may join. */
    cluster?: boolean;
}

function mockArguments(options: RunOptions): string[] {
    const { port = 0, cars = 50 } = options;
    return [
        join(TESTS, "mock/server.mjs"),
        "--port",
        `${port}`,
        "--cars",
        `${cars}`,
        "--web",
        WEB,
        "--simulators",
        "3",
    ];
}

function programArguments(options: RunOptions, folder: string, network: string[]): string[] {
    const city = process.env.ROBOSS_WORLD ?? "worlds/city.sdf",
        world = options.world === undefined ? city : join(dirname(city), options.world);
    if (options.program !== undefined)
        return [...options.program(folder, world), "--view", `${options.port ?? 8190}`, "--web", WEB];
    const kind = options.cluster
            ? ["controller", world, "--simulators", "2", ...network]
            : ["run", world, ...(options.single ? [] : ["--processes", "3"])],
        journal = join(folder, "run.journal");
    return [
        ...kind,
        ...(options.more ?? []),
        "--journal",
        journal,
        "--speed",
        "1",
        "--view",
        `${options.port ?? 8190}`,
        "--web",
        WEB,
    ];
}

let clusters = 0;
function clusterNetwork(): string[] {
    const name = `page-${process.pid}-${++clusters}`;
    return ["--simulation", name];
}

/** Starts a run and waits until it says where its page is. */
export async function startRun(options: RunOptions = {}): Promise<Run> {
    const folder = mkdtempSync(join(tmpdir(), "roboss-page-")),
        network = options.cluster ? clusterNetwork() : [],
        child =
            PROGRAM === ""
                ? spawn(process.execPath, mockArguments(options))
                : spawn(PROGRAM, programArguments(options, folder, network), { cwd: folder }),
        simulators = options.cluster
            ? [1, 2].map(() => spawn(PROGRAM, ["simulator", "--quiet", ...network], { stdio: "ignore" }))
            : [];
    let said = "";
    const url = await new Promise<string>((resolve, reject) => {
        const hear = (text: Buffer) => {
            said += text.toString();
            const found = /https?:\/\/\S+/.exec(said);
            if (found !== null) resolve(found[0]);
        };
        child.stdout?.on("data", hear);
        child.stderr?.on("data", hear);
        child.once("exit", () => reject(new Error(`the run ended at once: ${said}`)));
        setTimeout(() => reject(new Error(`the run names no page: ${said}`)), WAIT_MS).unref();
    });
    return {
        url,
        port: Number(new URL(url).port),
        network,
        stop: async (signal) => {
            await Promise.all([child, ...simulators].map((one) => end(one, signal)));
            rmSync(folder, { recursive: true, force: true });
        },
    };
}

export function startBrowser(): Promise<Browser> {
    if (CHROMIUM === undefined)
        throw new Error("no Chromium: install Debian's package chromium, or name one with CHROMIUM=/path");
    return chromium.launch({
        executablePath: CHROMIUM,
        // Debian turns --enable-gpu-rasterization on: text drawn by shaders that the processor runs costs more than the scene.
        args: [
            "--disable-gpu-rasterization",
            "--use-gl=angle",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--no-sandbox",
        ],
    });
}

export interface Watched {
    page: Page;
    errors: string[];
}

/** Opens the page and waits until the first State is drawn, with little effort. */
export async function openPage(
    browser: Browser,
    run: Run,
    query = "",
    { size = { width: 1100, height: 640 } } = {},
): Promise<Watched> {
    const context = await browser.newContext({ viewport: size, acceptDownloads: true }),
        page = await context.newPage(),
        errors: string[] = [];
    page.setDefaultTimeout(WAIT_MS);
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(error.message));
    const url = new URL(run.url);
    for (const [name, value] of new URLSearchParams(`quality=low&${query.replace(/^[?]/, "")}`))
        url.searchParams.set(name, value);
    await page.goto(url.toString());
    await page.waitForSelector("body[data-ready=true]");
    return { page, errors };
}

/** Draws with a hundredth of the pixels from now on, until the window changes: for tests that judge no picture. */
export function fewPixels(page: Page): Promise<void> {
    return page.evaluate(() => {
        const { renderer, canvas } = window.roboss.stage;
        renderer.setPixelRatio(0.05);
        renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    });
}

/** Presses a button of the top bar, which stands in its menu where the bar is too narrow. */
export async function pressInBar(page: Page, label: string): Promise<void> {
    const button = page.getByLabel(label, { exact: true });
    if (!(await button.isVisible())) await page.getByRole("button", { name: "More", exact: true }).first().click();
    await button.click();
}

/** Waits until `ask` says yes; fails with `what` otherwise. */
export async function until(what: string, ask: () => Promise<boolean>, wait_ms = WAIT_MS): Promise<void> {
    const end = Date.now() + wait_ms;
    while (!(await ask())) {
        if (Date.now() > end) throw new Error(`in vain: ${what}`);
        await new Promise((resolve) => setTimeout(resolve, 100));
    }
}

export async function time(page: Page): Promise<number> {
    return page.evaluate(() => window.roboss.state.status.value?.time_s ?? -1);
}

export const paused = (page: Page) => page.evaluate(() => window.roboss.state.status.value?.paused === true);

/** What the page says against something, as long as it stands there. */
export const notice = async (page: Page) => (await page.locator(".notice.bad").allTextContents()).join(" | ");

/** Waits until `ask` has given the same text for a second, and returns it; undefined: not yet. */
export async function settled(what: string, ask: () => Promise<string | undefined>): Promise<string> {
    let before: string | undefined,
        since = Date.now();
    await until(what, async () => {
        const now = await ask();
        if (now === undefined || now !== before) since = Date.now();
        before = now;
        return Date.now() - since > 1000;
    });
    return before ?? "";
}

/** Selects a robot by its name, through the list. */
export async function choose(page: Page, name: string): Promise<void> {
    await page.getByLabel("Find a robot").fill(name);
    await page.locator(".row.robot", { hasText: new RegExp(`^${name}$`) }).click();
    await page.getByLabel("Find a robot").fill("");
}

/** A run with a browser that shows its page, for all tests of a file. `told`: robots that a Client tells of. */
export class Bench {
    browser!: Browser;
    run!: Run;
    page!: Page;
    client: CppClient | null = null;
    errors: string[] = [];

    constructor(
        private readonly options: RunOptions & { query?: string; told?: string[] } = {},
        private readonly skip: string | false = false,
    ) {
        if (skip !== false) return;
        before(() => this.open(), LIMIT);
        after(async () => {
            await this.browser?.close();
            await this.client?.stop();
            await this.run?.stop();
        });
    }

    /** `skip`: why it is left out here. */
    test(name: string, work: (page: Page) => Promise<unknown>, skip: string | false = this.skip): void {
        test(name, { ...LIMIT, skip }, () => work(this.page));
    }

    endsWithCleanConsole(): void {
        this.test("all this time the console stayed clean", async () => assert.deepEqual(this.errors, []));
    }

    private async open(): Promise<void> {
        this.browser = await startBrowser();
        this.run = await startRun(this.options);
        if (this.options.told !== undefined) this.client = new CppClient(this.run.network, this.options.told);
        ({ page: this.page, errors: this.errors } = await openPage(this.browser, this.run, this.options.query));
    }
}
