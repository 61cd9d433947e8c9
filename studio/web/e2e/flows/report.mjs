// report.html: made by the command line, opened from the disk without a network.
import { existsSync, statSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { figure } from "../lib/ui.mjs";

export default async function report({ browser, openPage, step, folder, asperity, equal, near, ok, numberIn }) {
  const look = async (file, work, options = {}) => {
    const seen = await openPage(browser, { offline: true, ...options });
    await seen.page.goto(pathToFileURL(join(folder, file)).href);
    await seen.page.locator(".uplot").first().waitFor();
    await work(seen.page);
    equal(seen.complaints, [], "complaints of the browser");
    await seen.context.close();
  };

  await step("of one result, with its figures", async () => {
    ok(existsSync(join(folder, "measured", "report.html")), "process has written a report");
    await look("measured/report.html", async (page) => {
      await page.getByRole("heading", { name: "board", level: 1 }).waitFor();
      near(numberIn(await figure(page.locator("body"), "Pitch")), 2.5, 0.05, "pitch, mm");
      ok(numberIn(await figure(page.locator("body"), "Rq")) > 100, "Rq in µm");
      await page.getByText("Settings", { exact: true }).click();
      await page.getByText("profile.cutoff_cycles_per_mm", { exact: true }).waitFor();
      equal(await page.locator("canvas").count() >= 5, true, "plots and path are drawn");
    });
  });

  await step("a plot zooms by keyboard", async () => {
    await look("measured/report.html", async (page) => {
      const plot = page.locator(".plot-canvas").first();
      await plot.focus();
      const before = await plot.screenshot();
      for (let i = 0; i < 5; ++i) await page.keyboard.press("+");
      await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
      ok(!before.equals(await plot.screenshot()), "the plot shows another range");
    });
  });

  await step("of two results side by side, dark, on a small screen", async () => {
    asperity("process", "board_again", "-o", "measured_again", "--quiet");
    asperity("report", "measured", "measured_again", "-o", "both.html", "--quiet");
    ok(statSync(join(folder, "both.html")).size < 4e6, "the page is small");
    await look(
      "both.html",
      async (page) => {
        await page.getByRole("heading", { name: "2 results" }).waitFor();
        await page.getByRole("region", { name: "Metrics of all results" }).waitFor();
        equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark", "theme");
        ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing sticks out to the right");
      },
      { colorScheme: "dark", width: 800, height: 700 },
    );
  });
}
