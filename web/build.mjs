// Bundles the page into the folder given: `node build.mjs FOLDER`. With --tests, the mock gateway and the tests are
// bundled too, into FOLDER/../web-tests, where Debian's node runs them as they are.
import { build } from "esbuild";
import { cp, mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [out = join(here, "dist"), ...flags] = process.argv.slice(2);
const folder = resolve(out);

async function buildPage() {
    await mkdir(folder, { recursive: true });
    await build({
        entryPoints: { page: join(here, "src/main.ts"), style: join(here, "style/page.css") },
        outdir: folder,
        bundle: true,
        minify: true,
        sourcemap: flags.includes("--map"),
        format: "esm",
        target: ["es2021", "chrome100", "firefox102", "safari15"],
        legalComments: "linked",
        logLevel: "warning",
    });
    await cp(join(here, "index.html"), join(folder, "index.html"));
    await cp(join(here, "icon.svg"), join(folder, "icon.svg"));
}

// The licences of the packages whose code is in the page.
async function writeLicences() {
    const { dependencies } = JSON.parse(await readFile(join(here, "package.json"), "utf8"));
    const licence = async (name) => `${name}\n\n${await readFile(join(here, "node_modules", name, "LICENSE"), "utf8")}`;
    const all = await Promise.all(Object.keys(dependencies).map(licence));
    await writeFile(join(folder, "licences.txt"), all.join("\n"));
}

async function bundleFor(node, names, target) {
    await rm(target, { recursive: true, force: true });
    await build({
        entryPoints: names.map((name) => join(here, node, name)),
        outdir: target,
        bundle: true,
        platform: "node",
        format: "esm",
        target: "node18",
        outExtension: { ".js": ".mjs" },
        logLevel: "warning",
        sourcemap: "inline",
        external: ["playwright-core", "axe-core", "bufferutil", "utf-8-validate"],
        banner: {
            js: 'import { createRequire as requireFrom } from "node:module"; const require = requireFrom(import.meta.url);',
        },
    });
}

async function named(folder, ending) {
    return (await readdir(join(here, folder))).filter((name) => name.endsWith(ending));
}

await buildPage();
await writeLicences();
if (flags.includes("--tests")) {
    // Beside node_modules, so that the bundles find what is left out of them.
    const tests = join(here, ".tests");
    await bundleFor("mock", ["server.ts"], join(tests, "mock"));
    await bundleFor("test", await named("test", "_test.ts"), join(tests, "test"));
    await bundleFor("e2e", await named("e2e", "_test.ts"), join(tests, "e2e"));
}
