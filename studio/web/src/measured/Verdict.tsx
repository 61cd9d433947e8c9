import { Lamp } from "../ui/Lamp";
import type { Measured } from "./measured";
import { VerdictList } from "./VerdictList";
import { verdictWord } from "./verdicts";

const kLamps = {
  valid: { state: "good", word: "Valid" },
  limited: { state: "warn", word: "Limited" },
  invalid: { state: "bad", word: "Invalid" },
} as const;

/** Whether the result is valid, limited or invalid, and why. */
export function Verdict({ measured }: { measured: Measured }) {
  const lamp = kLamps[verdictWord(measured.verdicts)];
  return (
    <div class="measured-verdict" role="status" data-testid="verdict">
      <Lamp state={lamp.state} word={lamp.word} />
      {measured.verdicts.length > 0 && <VerdictList verdicts={measured.verdicts} />}
    </div>
  );
}
