import { Lamp } from "../ui/Lamp";
import type { Measured } from "./measured";

/** Whether the result is to be trusted, and why not, in words. */
export function Verdict({ measured }: { measured: Measured }) {
  return (
    <div class="measured-verdict" role="status" data-testid="verdict">
      <Lamp state={measured.trustworthy ? "good" : "bad"} word={measured.trustworthy ? "To be trusted" : "Not to be trusted"} />
      {!measured.trustworthy && <p>{measured.verdict}.</p>}
    </div>
  );
}
