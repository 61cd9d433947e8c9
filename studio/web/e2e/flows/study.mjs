// A study: two textures in both orders, blind, over a reload and a restart, an answer withdrawn; the log and its results; a staircase begun.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { open, type } from "../lib/ui.mjs";

const kColumns = "event,trial,repetition,track,left,right,comparison,level,answer,correct,reversal,response_s,since_begin_s,touch_left_s,touch_right_s,force_left_N,force_right_N,date";

export default async function study({ page, studio, step, restart, folder, asperity, expectComplaints, until, equal, ok, numberIn }) {
  // Where the processor draws, a small window has more pictures a second.
  await page.setViewportSize({ width: 1024, height: 700 });
  const rows = (name = "study_p01.study.csv") => readFileSync(join(folder, name), "utf8").trim().split("\n").slice(2);
  const session = page.getByTestId("study-session");
  const progress = (words) => page.getByTestId("study-progress").filter({ hasText: words }).waitFor();
  const takeForce = page.getByRole("button", { name: "Take the force" });
  // On a busy machine a heartbeat comes late, the force is lost, and nothing can be touched until a hand takes it again.
  const ready = () =>
    until(async () => {
      if (await takeForce.isVisible()) await takeForce.click({ timeout: 1000 }).catch(() => {});
      return page.getByTestId("study-advice").filter({ hasText: /Touch both|press on|Both are/ }).isVisible();
    }, "a trial that can be touched");
  const begin = async () => {
    await page.keyboard.press("Space");
    await ready();
  };
  const kHold_ms = 600;
  // Each letter is over the middle of its tile.
  const pressBoth = () =>
    until(async () => {
      if (await takeForce.isVisible()) await takeForce.click({ timeout: 1000 }).catch(() => {});
      const box = await page.getByTestId("feel-view").locator("canvas").boundingBox();
      const middles = await page.getByTestId("feel-letters").locator("span").evaluateAll((all) => all.map((one) => one.getBoundingClientRect()).map(({ left, right }) => (left + right) / 2));
      for (const x of middles) {
        await page.mouse.move(x, box.y + box.height * 0.5);
        await page.mouse.down();
        await page.mouse.move(x + 6, box.y + box.height * 0.5, { steps: 4 });
        await page.waitForTimeout(kHold_ms);
        await page.mouse.up();
      }
      return page.getByTestId("study-answer-a").isEnabled();
    }, "both textures touched with force");
  const touch = async () => {
    await begin();
    await pressBoth();
  };

  await step("two textures are chosen, and undone and chosen again", async () => {
    for (const [index, side] of ["5mm", "15mm"].entries()) {
      asperity("texture", "synthesize", "measured/texture.json", "--length", side, "-o", `tile_${index + 1}.png`, "--quiet");
    }
    await page.keyboard.press("g");
    await page.keyboard.press("u");
    await page.getByRole("navigation", { name: "Pages" }).locator('[aria-current="page"]', { hasText: "Study" }).waitFor();
    const list = page.getByTestId("study-stimuli");
    for (const name of ["tile_1.png", "tile_2.png"]) await list.getByRole("checkbox", { name }).check();
    await page.getByTestId("undo").click();
    await until(async () => !(await list.getByRole("checkbox", { name: "tile_2.png" }).isChecked()), "the second texture undone");
    await page.getByTestId("redo").click();
    equal(await page.getByTestId("study-begin").isEnabled(), false, "begin without a participant");
    await type(page.getByTestId("study-participant"), "p01");
    await page.getByTestId("study-begin").click();
    await progress("Trial 1 of 2");
  });

  await step("a trial is touched blind, and answered", async () => {
    equal(await page.getByTestId("study-answer-a").isEnabled(), false, "an answer before the touch");
    await begin();
    equal(await page.getByTestId("study-answer-a").isEnabled(), false, "an answer before both were touched with force");
    // The scale bar states where the letters have to be: each over the middle of its tile of 30 mm, with 4 mm between.
    const scale = page.locator(".viewport-scale");
    const perPixel_mm = numberIn(await scale.textContent()) / (await scale.boundingBox()).width;
    const places = await page.getByTestId("feel-letters").locator("span").evaluateAll((all) => all.map((one) => one.getBoundingClientRect()).map(({ left, right }) => (left + right) / 2));
    const middle = await page.getByTestId("feel-view").boundingBox().then(({ x, width }) => x + width / 2);
    for (const [index, place] of places.entries()) {
      const off_mm = (place - middle) * perPixel_mm - (index === 0 ? -17 : 17);
      ok(Math.abs(off_mm) < 1, `letter ${index + 1} is ${off_mm} mm off its tile`);
    }
    // A window that becomes narrow shows both tiles whole: 64 mm.
    const before = page.viewportSize();
    await page.setViewportSize({ width: 390, height: 844 });
    await until(async () => {
      const view = await page.getByTestId("feel-view").boundingBox();
      if (!view) return false;
      return (view.width * numberIn(await scale.textContent())) / (await scale.boundingBox()).width > 64;
    }, "both tiles in a narrow window");
    await page.setViewportSize(before);
    await ready();
    const box = await page.getByTestId("feel-view").locator("canvas").boundingBox();
    const press = async () => {
      await page.mouse.move(box.x + box.width * 0.35, box.y + box.height * 0.45);
      await page.mouse.down();
      await page.mouse.move(box.x + box.width * 0.37, box.y + box.height * 0.5, { steps: 5 });
    };
    await press();
    await until(async () => {
      if (await takeForce.isVisible()) {
        await page.mouse.up();
        await takeForce.click({ timeout: 1000 }).then(press, () => {});
      }
      return numberIn(await page.getByTestId("force-now").textContent().then((words) => words.replace("on the hand", ""))) > 0.05;
    }, "a force on the hand");
    await page.mouse.up();
    await pressBoth();
    ok(!(await page.content()).includes("tile_"), "the page knows no texture's name");
    await page.keyboard.press("1");
    await progress("Trial 2 of 2");
    await until(() => rows().length === 1, "a row in the log");
    ok(rows()[0].startsWith("answer,1,1,,tile_") && rows()[0].includes(",left,"), rows()[0]);
    const [left_s, right_s, left_N, right_N] = rows()[0].split(",").slice(13, 17).map(Number);
    ok(left_s >= 0.2 && right_s >= 0.2 && left_N >= 0.1 && right_N >= 0.1, `times and forces of touch: ${rows()[0]}`);
  });

  await step("a reload and a restart find the session where it was", async () => {
    await page.reload();
    await progress("Trial 2 of 2");
    expectComplaints(/WebSocket connection/, /ERR_CONNECTION/, /40[13]/);
    await restart();
    await page.goto("about:blank");
    await page.goto(studio().address);
    await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    expectComplaints();
    await open(page, "Study");
    await session.getByText("The session continues from the same trial").waitFor();
    await page.keyboard.press("Space");
    await progress("Trial 2 of 2");
  });

  await step("the last answer is withdrawn, and given again", async () => {
    await touch();
    await page.keyboard.press("1");
    await session.getByText("That was the last one").waitFor();
    await page.keyboard.press("Backspace");
    await progress("Trial 2 of 2");
    await touch();
    await page.getByTestId("study-answer-b").click();
    await page.getByTestId("study-show").click();
    equal(rows().map((row) => row.split(",")[0]), ["answer", "answer", "taken_back", "answer"], "rows of the log");
    equal(readFileSync(join(folder, "study_p01.study.csv"), "utf8").split("\n")[1], kColumns, "columns of the log");
  });

  await step("the results are shown and written", async () => {
    await page.getByTestId("study-wins").waitFor();
    // Left in one order, right in the other: the same texture both times.
    const cells = await page.getByTestId("study-wins").locator("td").allTextContents();
    equal(cells.filter((cell) => cell === "2").length, 1, "a texture that won twice");
    await page.getByTestId("study-summary").filter({ hasText: "2 answers, complete" }).waitFor();
    await page.getByTestId("study-export").click();
    await until(() => existsSync(join(folder, "study_p01.results.json")), "the results' file");
    equal(JSON.parse(readFileSync(join(folder, "study_p01.results.json"), "utf8")).answers, 2, "answers in it");
    const note = await page.getByTestId("toast-note").boundingBox();
    for (const control of await page.locator("main").locator("button, input, select").all()) {
      const place = await control.boundingBox();
      const column = await control.evaluate((one) => one.closest(".page-side, .page-results")?.getBoundingClientRect().bottom ?? Infinity);
      const covers = place && place.x < note.x + note.width && note.x < place.x + place.width && place.y < note.y + note.height && note.y < Math.min(place.y + place.height, column);
      ok(!covers, `the message covers ${await control.textContent()}`);
    }
  });

  await step("a staircase is begun and left, and its log shown", async () => {
    await page.getByTestId("study-method").selectOption("staircase");
    await type(page.getByTestId("study-participant"), "p02");
    await page.getByTestId("study-begin").click();
    await progress("Trial 1");
    await touch();
    for (let trial = 1; trial <= 3; ++trial) {
      await progress(`Trial ${trial}`);
      await pressBoth();
      await page.keyboard.press("2");
    }
    await progress("Trial 4");
    await page.getByTestId("study-end").click();
    await page.getByTestId("study-thresholds").waitFor();
    await page.getByTestId("study-continue").waitFor();
    equal(rows("study_p02.study.csv").length, 3, "answers in the log");
    await page.getByTestId("study-write").click();
    await until(() => existsSync(join(folder, "study.study.json")), "the study's file");
    equal(JSON.parse(readFileSync(join(folder, "study.study.json"), "utf8")).method, "staircase", "method in it");
  });
}
