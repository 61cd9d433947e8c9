import { expect, test } from "vitest";
import { found, type Command } from "../src/app/palette";

const command = (title: string, kind = "Action"): Command => ({ title, kind, run: () => undefined });
const commands = [command("Process", "Page"), command("Scan", "Page"), command("Rescan"), command("sample/scan_2", "File"), command("undo")];
const titles = (typed: string) => found(commands, typed).map(({ title }) => title);

test("nothing typed shows all in their order", () => expect(titles("")).toEqual(commands.map(({ title }) => title)));
test("those that begin with what was typed come first, then words, then the rest", () => expect(titles("scan")).toEqual(["Scan", "sample/scan_2", "Rescan"]));
test("all words must be there, of title or kind, in any order", () => {
  expect(titles("file scan")).toEqual(["sample/scan_2"]);
  expect(titles("page proc")).toEqual(["Process"]);
  expect(titles("scan mesh")).toEqual([]);
});
