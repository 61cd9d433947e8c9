// Pictures of every page: node screenshots.mjs BINARY DOCS [ALL [PAGE…]]. Those that the documentation shows go to DOCS, all sizes and
// themes to ALL.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launch, openPage } from "./lib/browser.mjs";
import { Projects } from "./lib/project.mjs";
import { scenes } from "./lib/scenes.mjs";
import { asperity, startStudio } from "./lib/studio.mjs";

const [binary, docs, all, ...only] = process.argv.slice(2);
if (!docs) {
  console.error("usage: node screenshots.mjs BINARY DOCS [ALL [PAGE…]]");
  process.exit(2);
}
const kSizes = [
  [1400, 860],
  [1024, 700],
];

async function picture(page, folder, name, holds) {
  mkdirSync(folder, { recursive: true });
  // The cursor and what is read out to the blind do not belong into pictures; two frames let plots and views follow.
  if (!holds) await page.mouse.move(0, 0);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  writeFileSync(join(folder, `${name}.png`), await page.screenshot());
}

async function looks(page, name, holds = false) {
  for (const [width, height] of all ? kSizes : kSizes.slice(0, 1)) {
    for (const theme of all ? ["light", "dark"] : ["light"]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme: theme });
      if (all) await picture(page, all, `${name}-${width}-${theme}`, holds);
      if (width === 1400 && theme === "light") await picture(page, docs, name, holds);
    }
  }
}

const browser = await launch();
const projects = new Projects(binary);
try {
  projects.prepare();
  for (const { name, prepare, file, holds } of scenes.filter((one) => only.length === 0 || only.includes(one.name))) {
    const folder = projects.copy(name);
    const { context, page, complaints } = await openPage(browser);
    if (file) {
      await page.goto(pathToFileURL(join(folder, file)).href);
      await prepare({ page, folder });
      await looks(page, name);
    } else {
      const studio = await startStudio(binary, folder);
      await page.goto(studio.address);
      await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
      await prepare({ page, folder, asperity: (...args) => asperity(binary, args, folder) });
      await looks(page, name, holds);
      await context.close();
      await studio.stop();
    }
    if (complaints.length > 0) throw new Error(`${name}: the browser complained:\n  ${complaints.join("\n  ")}`);
    console.log(`  ${name}`);
    await context.close().catch(() => {});
  }
} finally {
  await browser.close();
  projects.remove();
}
