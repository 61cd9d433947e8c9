import { expect, test } from "vitest";
import { findKey, keyName, type KeyGroup } from "../src/ui/keys";

const pressed = (key: string, more: Partial<KeyboardEvent> = {}) =>
  keyName({ key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...more });
const group = (title: string, ...keys: string[]): KeyGroup => ({
  title,
  keys: keys.map((key) => ({ key, label: `${title} ${key}`, run: () => undefined })),
});

test("keys have one name whatever the layout", () => {
  expect(pressed("s")).toBe("s");
  expect(pressed("S", { shiftKey: true })).toBe("shift+s");
  expect(pressed("?", { shiftKey: true })).toBe("?");
  expect(pressed("+", { shiftKey: true })).toBe("+");
  expect(pressed(" ")).toBe("space");
  expect(pressed(" ", { shiftKey: true })).toBe("shift+space");
  expect(pressed("ArrowUp", { shiftKey: true })).toBe("shift+arrowup");
  expect(pressed("Z", { ctrlKey: true, shiftKey: true })).toBe("ctrl+shift+z");
  expect(pressed("z", { metaKey: true })).toBe("ctrl+z");
});

test("the newest group comes first", () => {
  const groups = [group("page", "s"), group("app", "s", "?")];
  expect(findKey(groups, "s", "", false)?.label).toBe("page s");
  expect(findKey(groups, "?", "", false)?.label).toBe("app ?");
  expect(findKey(groups, "x", "", false)).toBeUndefined();
});

test("one key after another goes before the key alone", () => {
  const groups = [group("page", "s"), group("app", "g s")];
  expect(findKey(groups, "s", "g", false)?.label).toBe("app g s");
  expect(findKey(groups, "s", "x", false)?.label).toBe("page s");
});

test("keys rest while one types, but for those that never rest", () => {
  const groups = [group("page", "s", "escape")];
  groups[0]!.keys[1]!.always = true;
  expect(findKey(groups, "s", "", true)).toBeUndefined();
  expect(findKey(groups, "escape", "", true)?.label).toBe("page escape");
});
