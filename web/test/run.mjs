// Builds the tests and runs them: node test/run.mjs [unit] [page]; without words, both. The page's tests start the mock
// gateway, or the program named by ROBOSS_PROGRAM, by themselves.
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = join(dirname(fileURLToPath(import.meta.url)), "..");
const words = process.argv.slice(2), folders = words.length === 0 ? ["unit", "page"] : words;

function run(command, args) {
    const done = spawnSync(command, args, { cwd: here, stdio: "inherit" });
    if (done.status !== 0) process.exit(done.status ?? 1);
}

run(process.execPath, ["build.mjs", "dist", "--tests"]);
for (const word of folders) {
    const folder = join(".tests", word === "unit" ? "test" : "e2e");
    const files = readdirSync(join(here, folder)).filter((name) => name.endsWith("_test.mjs")).map((name) => join(folder, name));
    // The page's tests one after the other: each has a browser of its own.
    if (word === "page") for (const file of files) run(process.execPath, ["--test", file]);
    else run(process.execPath, ["--test", ...files]);
}
