// Accessibility by axe-core: every page in both themes, wide and narrow; and the windows over pages.
import { violations } from "../lib/axe.mjs";
import { open } from "../lib/ui.mjs";

const kPages = ["Home", "Scan", "Process", "Align", "Paint", "Feel", "Study"];
const kSizes = [[1440, 900], [390, 844]];

export default async function access({ page, step, equal }) {
  for (const theme of ["light", "dark"]) {
    await step(`no page has a violation in the ${theme} theme`, async () => {
      await page.emulateMedia({ colorScheme: theme });
      const found = [];
      for (const name of kPages) {
        await page.setViewportSize({ width: 1440, height: 900 });
        await open(page, name);
        if (name === "Process" && theme === "light") {
          await page.getByTestId("add-recording").selectOption("board");
          await page.getByTestId("plot-texture").locator("canvas").waitFor();
        }
        for (const [width, height] of kSizes) {
          await page.setViewportSize({ width, height });
          found.push(...(await violations(page)).map((one) => `${name}, ${width} x ${height}: ${one}`));
        }
      }
      equal(found, [], "violations of axe-core's rules");
    });
  }

  await step("nor have help, the palette and the dialog that adds files", async () => {
    await page.setViewportSize({ width: 1440, height: 900 });
    for (const id of ["help", "find", "add"]) {
      await page.getByTestId(id).click();
      equal(await violations(page), [], `axe-core on ${id}`);
      await page.keyboard.press("Escape");
    }
  });
}
