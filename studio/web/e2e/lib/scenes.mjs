// What the pictures of the documentation show.
import { open, type } from "./ui.mjs";

async function scan({ page }) {
  await open(page, "Scan");
  await page.getByTestId("scan-source").selectOption("bench");
  await page.getByTestId("scan-open").click();
  await page.getByTestId("scan-close").waitFor();
  await page.getByTestId("scan-start").click();
  await page.getByTestId("scan-recorded").filter({ hasText: /^[3-9]/ }).waitFor();
}

async function process_({ page }) {
  await open(page, "Process");
  await page.getByTestId("add-recording").selectOption("board");
  await page.getByTestId("plot-texture").locator("canvas").waitFor();
}

async function align({ page }) {
  await open(page, "Align");
  await page.getByTestId("align-mesh").selectOption("pebble.obj");
  await page.getByTestId("align-unit").selectOption("mm");
  await page.getByTestId("align-files").getByRole("checkbox", { name: /^stroke / }).check();
  await page.getByTestId("align-opened").waitFor();
  await page.getByTestId("align-run-anywhere").click();
  await page.getByTestId("align-verdict").waitFor({ timeout: 120_000 });
}

async function paint({ page }) {
  await open(page, "Paint");
  await page.getByTestId("paint-object").selectOption("pebble.obj");
  await page.getByTestId("paint-unit").selectOption("0.001");
  await page.getByTestId("paint-texture").selectOption("measured/texture.json");
  for (const point of [[-30, -8, 20], [0, 12, 24], [30, -4, 20]]) {
    for (const [at, axis] of ["x", "y", "z"].entries()) await type(page.getByTestId(`paint-${axis}`), point[at]);
    await page.getByTestId("paint-add").click();
  }
  await page.getByTestId("paint-result-1").waitFor();
}

export const scenes = [
  { name: "scan", prepare: scan },
  { name: "process", prepare: process_ },
  { name: "align", prepare: align },
  { name: "paint", prepare: paint },
  { name: "report", file: "measured/report.html", prepare: ({ page }) => page.locator(".uplot").first().waitFor() },
];
