// What all pages have in common: going back and forth, keys, themes, a server that ends and returns, strangers.
const kPages = ["Home", "Scan", "Process", "Align", "Paint", "Feel", "Study"];

export default async function shell({ page, step, restart, studio, expectComplaints, openPage, browser, equal, ok, until }) {
  const nav = page.getByRole("navigation", { name: "Pages" });

  await step("the token leaves the address", async () => {
    equal(new URL(page.url()).hash.includes("token"), false, "token in the address");
  });

  await step("every page opens, by click and by keyboard", async () => {
    for (const name of kPages) {
      await nav.getByRole("link", { name }).click();
      await nav.locator('[aria-current="page"]', { hasText: name }).waitFor();
      await page.locator(".page-wait").waitFor({ state: "detached" });
      equal(await page.locator('[role="alert"]').count(), 0, `alerts on ${name}`);
    }
    await page.locator("#main").focus();
    for (const [key, name] of [["s", "Scan"], ["p", "Process"], ["f", "Feel"]]) {
      await page.keyboard.press("g");
      await page.keyboard.press(key);
      await nav.locator('[aria-current="page"]', { hasText: name }).waitFor();
    }
  });

  await step("the keys are explained", async () => {
    await page.getByTestId("help").click();
    const dialog = page.getByRole("dialog");
    await dialog.getByText("undo", { exact: false }).first().waitFor();
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "hidden" });
  });

  await step("the theme changes and stays over a reload", async () => {
    const themes = new Set();
    for (let i = 0; i < 3; ++i) {
      themes.add(await page.getByTestId("theme").getAttribute("aria-label"));
      await page.getByTestId("theme").click();
    }
    equal(themes.size, 3, "themes");
    await until(async () => {
      await page.getByTestId("theme").click();
      return (await page.getByTestId("theme").getAttribute("aria-label"))?.includes("dark");
    }, "the dark theme");
    equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark", "theme");
    await page.reload();
    await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark", "theme after a reload");
  });

  await step("nothing scrolls at four sizes, and Stop is in sight", async () => {
    for (const [width, height] of [[1440, 900], [1024, 700], [768, 1024], [390, 844]]) {
      await page.setViewportSize({ width, height });
      for (const name of kPages) {
        await nav.getByRole("link", { name }).click();
        await nav.locator('[aria-current="page"]', { hasText: name }).waitFor();
        await page.locator(".page-wait").waitFor({ state: "detached" });
        const over = await page.evaluate(() => [document.documentElement.scrollWidth - innerWidth, document.documentElement.scrollHeight - innerHeight]);
        ok(over[0] <= 0 && over[1] <= 0, `${name} fits ${width} x ${height}; it is ${over} too large`);
        const stop = await page.getByTestId("force-stop").boundingBox();
        ok(stop && stop.x >= 0 && stop.y >= 0 && stop.x + stop.width <= width && stop.y + stop.height <= height, `${name}: Stop is in sight at ${width} x ${height}`);
      }
    }
    await page.setViewportSize({ width: 1400, height: 860 });
  });

  await step("a wrong token is turned away", async () => {
    const stranger = await openPage(browser);
    stranger.expectComplaints(/403/, /401/, /WebSocket connection/);
    await stranger.page.goto(`${studio().origin}/#token=00000000000000000000000000000000`);
    await stranger.page.locator('[role="alert"]').filter({ hasText: "Open the address" }).waitFor();
    equal(stranger.complaints, [], "other complaints of the stranger's browser");
    await stranger.context.close();
  });

  await step("another session is listed, and closed", async () => {
    const other = await openPage(browser);
    await other.page.goto(studio().address);
    await other.page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    await page.getByTestId("show-sessions").click();
    const rows = page.getByTestId("sessions").locator("tbody tr");
    await rows.nth(1).waitFor();
    await rows.filter({ hasText: "this browser" }).waitFor();
    await rows.getByRole("button", { name: "Close session" }).click();
    await until(async () => (await rows.count()) === 1, "one session");
    await other.page.locator('[role="alert"]').filter({ hasText: "Open the address" }).waitFor();
    equal(other.complaints, [], "complaints of the other browser");
    await other.context.close();
    await page.keyboard.press("Escape");
    equal(await page.getByTestId("link").textContent().then((text) => text.includes("connected")), true, "this browser is connected");
  });

  await step("the page waits for a server that starts again, and says what to do", async () => {
    expectComplaints(/WebSocket connection/, /ERR_CONNECTION/, /40[13]/);
    await restart();
    await page.locator('[role="alert"]').waitFor();
    await page.goto("about:blank");
    await page.goto(studio().address);
    await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    expectComplaints();
  });
}
