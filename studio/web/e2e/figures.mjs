// How long the studio takes: node figures.mjs BINARY [SECONDS]. From the program's start to the first picture, and, while the bench
// scans, from the sensor and from the tip's motion to the screen. Prints one line a value.
import { launch, openPage } from "./lib/browser.mjs";
import { numberIn } from "./lib/check.mjs";
import { Projects } from "./lib/project.mjs";
import { startStudio } from "./lib/studio.mjs";
import { open } from "./lib/ui.mjs";

const [binary, seconds = "10"] = process.argv.slice(2);
if (!binary) {
  console.error("usage: node figures.mjs BINARY [SECONDS]");
  process.exit(2);
}

async function firstPicture(browser, folder) {
  const began = Date.now();
  const studio = await startStudio(binary, folder);
  const served_ms = Date.now() - began;
  const { context, page } = await openPage(browser);
  const opened = Date.now();
  await page.goto(studio.address);
  await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
  await page.locator("#main canvas").first().waitFor();
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  const drawn_ms = Date.now() - opened;
  await context.close();
  await studio.stop();
  return { served_ms, drawn_ms };
}

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

async function scan(browser, folder, size) {
  const studio = await startStudio(binary, folder);
  const { context, page } = await openPage(browser, size);
  await page.goto(studio.address);
  await open(page, "Scan");
  await page.getByTestId("scan-source").selectOption("bench");
  await page.getByTestId("scan-open").click();
  await page.getByTestId("scan-close").waitFor();
  await page.getByTestId("scan-start").click();
  const stream = page.getByTestId("scan-stream");
  const figures = [];
  const end = Date.now() + 1000 * Number(seconds);
  while (Date.now() < end) {
    await new Promise((resolve) => setTimeout(resolve, 250));
    const state = await page.getByTestId("scan-record-state").textContent();
    if (!/recording/i.test(state)) break;
    const read = async (name) => Number((await stream.getAttribute(name)) || NaN);
    figures.push({
      rows: await read("data-latency-ms"), rows95: await read("data-latency-p95-ms"),
      profile: await read("data-profile-ms"), profile95: await read("data-profile-p95-ms"),
      poses: numberIn((await page.getByTestId("scan-pose-rate").textContent()).replace("–", "0")),
    });
  }
  const lost = await stream.getAttribute("data-rows-lost");
  await context.close();
  await studio.stop();
  const last = figures.filter((one) => Number.isFinite(one.profile)).at(-1) ?? figures.at(-1);
  return { ...last, lost, poses: median(figures.map((one) => one.poses)) };
}

const browser = await launch();
const projects = new Projects(binary);
try {
  projects.prepare();
  const starts = [];
  for (let i = 0; i < 5; ++i) starts.push(await firstPicture(browser, projects.copy(`start_${i}`)));
  console.log(`start to the address   ${median(starts.map((one) => one.served_ms))} ms`);
  console.log(`page to first picture  ${median(starts.map((one) => one.drawn_ms))} ms`);
  for (const [width, height] of [[1024, 700], [1400, 860]]) {
    const one = await scan(browser, projects.copy(`scan_${width}`), { width, height });
    console.log(`${width} x ${height}  sensor to screen ${one.rows} ms (median), ${one.rows95} ms (95 %); motion to profile ${one.profile} ms, ${one.profile95} ms; ${one.poses} poses/s, ${one.lost} rows lost`);
  }
} finally {
  await browser.close();
  projects.remove();
}
