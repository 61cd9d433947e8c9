// Scanning: the protoboard live on the bench, the profile growing, the cut-off tuned, segments, the recording kept.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { open, type } from "../lib/ui.mjs";

export default async function scan({ page, step, folder, until, equal, near, ok, numberIn, asperity }) {
  await open(page, "Scan");
  const stream = page.getByTestId("scan-stream");
  const rows = async () => Number(await stream.getAttribute("data-rows"));

  await step("the bench is opened, and its rows come", async () => {
    await page.getByTestId("scan-source").selectOption("bench");
    await page.getByTestId("scan-name").fill("live_board");
    await page.getByTestId("scan-name").press("Enter");
    await page.getByTestId("scan-open").click();
    await page.getByTestId("scan-close").waitFor();
    await until(async () => (await rows()) > 1000, "rows of the probe");
  });

  await step("the profile grows while the hand moves", async () => {
    await page.getByTestId("scan-start").click();
    const plot = page.getByTestId("scan-profile-plot").locator(".plot-canvas");
    await plot.waitFor();
    const words = () => plot.getAttribute("aria-label");
    const points = async () => Number(/: (\d+) points/.exec(await words())?.[1] ?? 0);
    await until(async () => (await points()) > 100, "a profile of more than 100 points");
  });

  await step("stopped, it is worked out in full", async () => {
    await until(async () => numberIn(await page.getByTestId("scan-recorded").textContent()) > 3, "three seconds of scan");
    await page.getByTestId("scan-stop").click();
    await page.getByTestId("scan-ra").waitFor();
    ok(numberIn(await page.getByTestId("scan-ra").locator("dd").textContent()) > 50, "Ra of the protoboard, µm");
    // How well the two agree hangs on when this machine let images through; on a clock that does not: tests/live.
    const agreement = numberIn(await page.getByTestId("scan-correlation").locator("dd").textContent());
    ok(Math.abs(agreement) <= 1, "what was shown live was compared with it");
  });

  await step("the cut-off is tuned on the scan that is there", async () => {
    const ra = () => page.getByTestId("scan-ra").locator("dd").textContent();
    const before = await ra();
    await type(page.getByTestId("scan-tune").getByRole("spinbutton", { name: "High-pass cut-off" }), 1);
    await until(async () => (await ra()) !== before, "another Ra");
    ok(numberIn(await ra()) < numberIn(before), "Ra falls with a higher cut-off");
  });

  await step("a segment is discarded by key", async () => {
    await page.locator("#main").focus();
    await page.keyboard.press("Space");
    await page.getByTestId("scan-record-state").filter({ hasText: /recording/i }).waitFor();
    await page.keyboard.press("Space");
    const count = () => page.getByTestId("scan-segments").locator("li").count();
    await until(async () => (await count()) === 2, "two segments");
    await page.keyboard.press("d");
    await until(async () => {
      // On a slow machine it is long enough to be asked about.
      const asked = page.getByTestId("scan-throw-away");
      if (await asked.isVisible()) await asked.click({ timeout: 1000 }).catch(() => {});
      return (await count()) === 1;
    }, "one segment again");
  });

  await step("the recording is kept, and the command line measures it", async () => {
    await page.getByTestId("scan-close").click();
    await page.getByTestId("scan-open").waitFor();
    equal(await stream.getAttribute("data-rows-lost"), "0", "rows lost on the way to the page");
    ok(existsSync(join(folder, "live_board", "recording.json")), "live_board/recording.json is there");
    asperity("process", "live_board", "-o", "live_measured", "--quiet");
    const result = JSON.parse(readFileSync(join(folder, "live_measured", "result.json"), "utf8"));
    near(result.periodicity.pitch_m * 1e3, 2.5, 0.05, "pitch of the live scan, mm");
  });
}
