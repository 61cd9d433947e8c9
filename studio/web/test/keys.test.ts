import { expect, test } from "vitest";
import { findKey, keyName, meaningOf, type KeyGroup } from "../src/ui/keys";

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

test("the first of two keys waits for the second, however long that takes", () => {
  const groups = [group("page", "a", "escape"), group("app", "g a", "ctrl+z")];
  expect(meaningOf(groups, "g", "", false)).toEqual({ leader: "g", taken: true });
  expect(meaningOf(groups, "a", "g", false)).toMatchObject({ key: { label: "app g a" }, leader: "" });
  // Held down, it keeps waiting; a field takes it as a letter.
  expect(meaningOf(groups, "g", "g", false)).toEqual({ leader: "g", taken: true });
  expect(meaningOf(groups, "g", "", true)).toEqual({ leader: "", taken: false });
});

test("a second key that leads nowhere does nothing, and ends the wait", () => {
  const groups = [group("page", "a", "d", "escape"), group("app", "g s", "ctrl+z")];
  for (const name of ["a", "d", "escape"]) expect(meaningOf(groups, name, "g", false)).toEqual({ leader: "", taken: true });
  // What no key of ours is goes its own way: Tab, F5.
  expect(meaningOf(groups, "tab", "g", false)).toEqual({ leader: "", taken: false });
  expect(meaningOf(groups, "ctrl+z", "g", false).key?.label).toBe("app ctrl+z");
  expect(meaningOf(groups, "a", "", false).key?.label).toBe("page a");
});
