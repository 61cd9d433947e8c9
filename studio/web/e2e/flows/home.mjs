// The first hour: the guided scan, the sample project, recent projects, the palette, help, a studio that was killed in a scan.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { startStudio } from "../lib/studio.mjs";
import { open } from "../lib/ui.mjs";

export default async function home({ browser, openPage, binary, step, equal, ok, until }) {
  const empty = mkdtempSync(join(tmpdir(), "asperity-first-"));
  const other = mkdtempSync(join(tmpdir(), "asperity-second-"));
  const state = `${empty}-state`;
  let studio = await startStudio(binary, empty, [], { state });
  const first = await openPage(browser);
  const mine = first.page;
  try {
    await mine.goto(studio.address);
    await mine.getByTestId("link").filter({ hasText: "connected" }).waitFor();

    await step("a newcomer sees three ways to begin", async () => {
      for (const id of ["home-bench", "home-sample", "home-add"]) await mine.getByTestId(id).waitFor();
      await mine.getByText("The folder is empty").waitFor();
    });

    await step("the sample project is made and opened", async () => {
      await mine.getByTestId("home-sample").click();
      await mine.getByTestId("result").getByTestId("verdict").filter({ hasText: "Valid" }).waitFor();
      for (const file of ["README.txt", "stylus/profile.csv", "stylus/LICENSE", "results/sandpaper/texture.json"]) ok(existsSync(join(empty, "sample", file)), file);
    });

    await step("two cursors measure, linked plots zoom and reset together", async () => {
      await mine.getByTestId("plot-height-measure").click();
      const words = await mine.getByTestId("plot-height-measured").textContent();
      ok(/Δx .*mm, Δz .*µm/.test(words), words);
      const other = await mine.getByTestId("plot-texture-measured").textContent();
      equal(/Δx [^,]*/.exec(other)[0], /Δx [^,]*/.exec(words)[0], "the cursors of linked plots");
      await mine.getByTestId("plot-height").getByRole("img").focus();
      await mine.keyboard.press("b");
      for (let k = 0; k < 10; ++k) await mine.keyboard.press("Shift+ArrowRight");
      ok((await mine.getByTestId("plot-height-measured").textContent()) !== words, "a key moves a cursor");
      await mine.keyboard.press("m");
      await mine.getByTestId("plot-height-measured").waitFor({ state: "detached" });
    });

    await step("the palette finds pages, files and documents", async () => {
      await mine.keyboard.press("Control+k");
      await mine.getByTestId("palette-input").fill("go to home");
      await mine.keyboard.press("Enter");
      await mine.getByTestId("home-bench").waitFor();
      await mine.keyboard.press("Control+k");
      await mine.getByTestId("palette-input").fill("file sandpaper");
      await mine.keyboard.press("Enter");
      await mine.locator('[aria-current="page"]', { hasText: "Process" }).waitFor();
    });

    await step("help opens the page of the documents, or states how to get them", async () => {
      await mine.getByTestId("help").click();
      const [opened] = await Promise.all([first.context.waitForEvent("page"), mine.getByTestId("help-document").click()]);
      await opened.waitForLoadState();
      ok(/Process page|not installed/.test(await opened.textContent("body")), "a page of the documents");
      await opened.close();
      await mine.keyboard.press("Escape");
    });

    await step("the guide leads through the first scan", async () => {
      await open(mine, "Home");
      await mine.getByTestId("home-bench").click();
      const next = mine.getByTestId("scan-guide-next");
      for (const words of ["Open", "Start", "Stop"]) {
        await next.filter({ hasText: words }).waitFor();
        if (words === "Stop") await until(async () => (await mine.getByTestId("scan-recorded").textContent()) > "2", "two seconds of scan");
        await next.click({ timeout: 5000 }).catch(() => {});
      }
      await next.filter({ hasText: "Open in Process" }).waitFor();
    });

    await step("a studio that is killed in a scan offers what was saved, at the same port", async () => {
      await mine.getByTestId("scan-start").click();
      await until(async () => (await mine.getByTestId("scan-stop").isEnabled()) && (await mine.getByTestId("scan-recorded").textContent()) !== "0", "a scan");
      await mine.waitForTimeout(2000);
      const port = studio.port;
      first.expectComplaints(/./);
      await studio.stop("SIGKILL");
      studio = await startStudio(binary, empty, [], { state });
      equal(studio.port, port, "the port");
      await mine.goto(studio.address);
      await mine.getByTestId("rescued").filter({ hasText: "were saved in the recording" }).waitFor();
      await mine.getByTestId("rescued-open").click();
      await mine.locator('[aria-current="page"]', { hasText: "Process" }).waitFor();
      await mine.getByTestId("rescued").waitFor({ state: "detached" });
    });

    await step("another project lists this one as recent", async () => {
      await studio.stop();
      studio = await startStudio(binary, other, [], { state });
      await mine.goto(studio.address);
      await mine.getByTestId("link").filter({ hasText: "connected" }).waitFor();
      await open(mine, "Home");
      await mine.getByTestId("home-recent").getByText(empty).waitFor();
    });
  } finally {
    await first.context.close();
    await studio.stop();
    for (const path of [empty, other, state]) rmSync(path, { recursive: true, force: true });
  }
}
