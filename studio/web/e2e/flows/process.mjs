// Processing: two recordings, the cut-off tuned, every view, repeatability, results written.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { figure, open, type } from "../lib/ui.mjs";

const kTabs = ["Path", "Spectrum", "Compliance", "Accuracy", "Quality", "Settings", "Profile"];

export default async function process_({ page, step, folder, asperity, until, equal, near, ok, numberIn }) {
  await open(page, "Process");
  const result = page.getByTestId("result");

  await step("a recording is measured", async () => {
    await page.getByTestId("add-recording").selectOption("board");
    await result.getByTestId("verdict").filter({ hasText: "Valid" }).waitFor();
    near(numberIn(await figure(result, "Pitch")), 2.5, 0.05, "pitch, mm");
  });

  await step("another cut-off gives another texture, and undo the one of before", async () => {
    const rq = () => figure(result, "Rq");
    const before = await rq();
    const cutoff = page.getByTestId("tune").getByRole("spinbutton", { name: /cut-off/i }).first();
    const was = await cutoff.inputValue();
    await type(cutoff, 1);
    await until(async () => (await rq()) !== before && /\d/.test(await rq()), "another Rq");
    ok(numberIn(await rq()) < numberIn(before), "Rq falls with a higher cut-off");
    await page.locator("#main").focus();
    await page.keyboard.press("Control+z");
    await until(async () => (await rq()) === before, "the Rq of before");
    await until(async () => (await cutoff.inputValue()) === was, "the cut-off of before");
  });

  await step("every view is drawn", async () => {
    for (const name of kTabs) {
      await page.getByRole("tab", { name, exact: true }).click();
      // A plot, a table, or the words for a value that is not determined.
      await page.getByRole("tabpanel").locator("canvas, table, p").first().waitFor();
    }
    await page.getByTestId("plot-height").waitFor();
    await page.getByTestId("plot-texture").waitFor();
  });

  await step("a second recording is laid over it", async () => {
    await page.getByTestId("add-recording").selectOption("board_again");
    await page.getByRole("tab", { name: "Repeatability" }).click();
    await page.getByRole("tabpanel").locator("canvas").first().waitFor();
    ok(/0\.9\d/.test(await page.getByRole("tabpanel").textContent()), "the two agree");
  });

  await step("strokes over one line are merged", async () => {
    await page.getByRole("tab", { name: "Merge", exact: true }).click();
    const strokes = page.getByTestId("merge-strokes");
    for (const name of ["guided_11", "guided_12", "board"]) await strokes.getByRole("checkbox", { name: new RegExp(`^${name} `) }).check();
    await page.getByTestId("merge-run").click();
    const result = page.getByTestId("merge-result");
    await result.getByTestId("verdict").filter({ hasText: "Limited" }).waitFor({ timeout: 120_000 });
    ok(/board/.test(await result.getByTestId("verdict").textContent()), "the stroke of another surface is named");
    await strokes.getByRole("checkbox", { name: /^board / }).uncheck();
    await page.getByRole("tabpanel").filter({ hasText: "Merge again" }).waitFor();
    await page.getByTestId("merge-run").click();
    await page.getByTestId("merge-gain").filter({ hasText: "2 equal strokes" }).waitFor({ timeout: 120_000 });
    ok(numberIn(await page.getByTestId("merge-gain").locator("dd").textContent()) < 0.95, "less noise than one stroke");
    await page.getByTestId("plot-merge").locator("canvas").first().waitFor();
    await page.getByTestId("merge-write-button").click();
    await page.getByTestId("merge-written").filter({ hasText: "Written to merged" }).waitFor({ timeout: 120_000 });
    asperity("merge", "guided_11", "guided_12", "-o", "merged_by_hand", "--quiet");
    equal(readFileSync(join(folder, "merged", "result.json"), "utf8"), readFileSync(join(folder, "merged_by_hand", "result.json"), "utf8"), "result.json of studio and command line");
  });

  await step("the results are written as the command line writes them", async () => {
    await page.getByRole("tab", { name: "Profile", exact: true }).click();
    await page.getByTestId("write").getByLabel("Folder", { exact: true }).fill("by_studio");
    await page.getByTestId("write-results").click();
    await page.getByTestId("written").filter({ hasText: "by_studio" }).waitFor();
    for (const name of ["board", "board_again"]) {
      for (const file of ["trajectory.csv", "profile.csv", "texture.json", "result.json"]) ok(existsSync(join(folder, "by_studio", name, file)), `by_studio/${name}/${file}`);
    }
    equal(readFileSync(join(folder, "by_studio", "board", "profile.csv"), "utf8"), readFileSync(join(folder, "measured", "profile.csv"), "utf8"), "profile.csv of studio and command line");
  });

  await step("the report is saved as a page", async () => {
    const saved = page.waitForEvent("download");
    await page.getByTestId("save-report").click();
    const download = await saved;
    equal(download.suggestedFilename(), "by_studio_report.html", "name of the report");
    equal(readFileSync(await download.path(), "utf8"), readFileSync(join(folder, "by_studio", "report.html"), "utf8"), "the report");
  });
}
