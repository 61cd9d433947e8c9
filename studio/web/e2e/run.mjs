// The studio in a browser, as a user goes through it: node run.mjs BINARY [FLOW…]. One line a step; ends with 1 if any failed.
import { readdirSync } from "node:fs";
import { basename } from "node:path";
import { launch, openPage } from "./lib/browser.mjs";
import * as check from "./lib/check.mjs";
import { Projects } from "./lib/project.mjs";
import { asperity, startStudio } from "./lib/studio.mjs";

const [binary, ...chosen] = process.argv.slice(2);
if (!binary) {
  console.error("usage: node run.mjs BINARY [FLOW…]");
  process.exit(2);
}
const kOrder = ["shell", "home", "scan", "process", "align", "paint", "feel", "study", "report"];
const there = readdirSync(new URL("./flows", import.meta.url)).map((file) => basename(file, ".mjs"));
const names = chosen.length > 0 ? chosen : [...kOrder.filter((name) => there.includes(name)), ...there.filter((name) => !kOrder.includes(name)).sort()];

/** A page with the studio in a fresh copy of the project. What it starts ends with it. */
async function withStudio(browser, projects, name, flow, steps) {
  const folder = projects.copy(name);
  let studio = await startStudio(binary, folder);
  const { context, page, complaints, expectComplaints } = await openPage(browser);
  const step = async (words, work) => {
    const start = Date.now();
    try {
      await work();
      if (complaints.length > 0) throw new Error(`the browser complained:\n  ${complaints.splice(0).join("\n  ")}`);
    } catch (error) {
      if (process.env.ASPERITY_E2E_PICTURES) await page.screenshot({ path: `${process.env.ASPERITY_E2E_PICTURES}/${name}-failed.png` }).catch(() => {});
      throw new Error(`${name}: ${words}\n  ${error.stack ?? error}`);
    }
    steps.push(words);
    console.log(`  ${name}: ${words}  ${((Date.now() - start) / 1000).toFixed(1)} s`);
  };
  const restart = async () => {
    await studio.stop();
    studio = await startStudio(binary, folder, ["--port", String(studio.port)]);
    return studio;
  };
  try {
    await page.goto(studio.address);
    await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    await flow({ page, context, browser, folder, binary, step, restart, expectComplaints, studio: () => studio, openPage, asperity: (...args) => asperity(binary, args, folder), ...check });
  } finally {
    await context.close();
    const code = await studio.stop();
    if (code !== 0 || studio.faults()) steps.fault = `the studio ended with ${code}: ${studio.faults()}`;
  }
  if (steps.fault) throw new Error(steps.fault);
}

async function main() {
  const browser = await launch();
  const projects = new Projects(binary);
  const failed = [];
  const start = Date.now();
  try {
    projects.prepare();
    console.log(`  project made in ${((Date.now() - start) / 1000).toFixed(1)} s`);
    for (const name of names) {
      const { default: flow } = await import(`./flows/${name}.mjs`);
      try {
        await withStudio(browser, projects, name, flow, []);
      } catch (error) {
        failed.push(name);
        console.log(`FAILED ${error.message ?? error}`);
      }
    }
  } finally {
    await browser.close();
    projects.remove();
  }
  console.log(`${names.length - failed.length} of ${names.length} flows passed in ${((Date.now() - start) / 1000).toFixed(0)} s`);
  return failed.length === 0 ? 0 : 1;
}

main().then(
  (code) => process.exit(code),
  (error) => {
    console.error(`e2e: ${error.message ?? error}`);
    process.exit(1);
  },
);
