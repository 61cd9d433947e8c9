// What flows do again and again.

/** Opens a page by its name and waits until it is there. */
export async function open(page, name) {
  const nav = page.getByRole("navigation", { name: "Pages" });
  await nav.getByRole("link", { name, exact: true }).click();
  await nav.locator('[aria-current="page"]', { hasText: name }).waitFor();
  await page.locator(".page-wait").waitFor({ state: "detached" });
}

/** Types a number into a field as a user does. */
export async function type(field, value) {
  await field.fill(String(value));
  await field.press("Enter");
}

/** The value of a result, by its label. */
export async function figure(place, label) {
  const row = place.locator(".figure", { has: place.page().locator("dt", { hasText: label }) }).first();
  return (await row.locator("dd").textContent()) ?? "";
}
