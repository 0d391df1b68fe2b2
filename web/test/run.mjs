// Runs the bundled tests: `node test/run.mjs unit`, `page` (all in a browser), or names of files without their ending.
// The page's tests start the mock gateway, or the program that ROBOSS_PROGRAM names, by themselves. They follow a run in
// real time, so a file that fails is run once more, as is usual for tests in a browser; failing twice is a failure.
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const tests = join(dirname(fileURLToPath(import.meta.url)), "../.tests");

function filesIn(folder) {
    return readdirSync(join(tests, folder))
        .filter((name) => name.endsWith("_test.mjs"))
        .map((name) => join(tests, folder, name));
}

const pass = (files) => spawnSync(process.execPath, ["--test", ...files], { stdio: "inherit" }).status === 0;

function passInBrowser(file) {
    if (pass([file])) return true;
    console.log(`# ${file} failed; running it once more`);
    return pass([file]);
}

const results = [];

for (const word of process.argv.length > 2 ? process.argv.slice(2) : ["unit", "page"]) {
    if (word === "unit") results.push(pass(filesIn("test")));
    // One after the other: each has a browser of its own.
    else
        for (const file of filesIn("e2e").filter((name) => word === "page" || name.endsWith(`/${word}.mjs`)))
            results.push(passInBrowser(file));
}
// No file of a given name is a failure, too.
process.exitCode = results.length > 0 && results.every((passed) => passed) ? 0 : 1;
