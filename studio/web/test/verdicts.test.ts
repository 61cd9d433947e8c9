import { describe, expect, it } from "vitest";
import { verdictsOf, verdictText, verdictWord, type VerdictEntry } from "../src/measured/verdicts";

const clipped: VerdictEntry = { code: "clipped", severity: "invalid", message: "4 % are clipped", remedy: "scan slower" };
const noisy: VerdictEntry = { code: "noisy_texture", severity: "limited", message: "much noise", remedy: "" };

describe("verdicts", () => {
  it("are as bad as the worst", () => {
    expect(verdictWord([])).toBe("valid");
    expect(verdictWord([{ ...noisy, severity: "note" }])).toBe("valid");
    expect(verdictWord([noisy])).toBe("limited");
    expect(verdictWord([noisy, clipped])).toBe("invalid");
  });
  it("have their remedy in the text", () => {
    expect(verdictText(clipped)).toBe("4 % are clipped; scan slower");
    expect(verdictText(noisy)).toBe("much noise");
  });
  it("of a result without a list are its sentence", () => {
    expect(verdictsOf({ trustworthy: true, verdict: "" })).toEqual([]);
    expect(verdictWord(verdictsOf({ trustworthy: false, verdict: "few poses" }))).toBe("invalid");
    expect(verdictsOf({ trustworthy: false, verdict: "x", verdicts: [clipped] })).toEqual([clipped]);
  });
});
