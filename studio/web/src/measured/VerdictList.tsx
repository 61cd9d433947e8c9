import { verdictText, type VerdictEntry } from "./verdicts";

/** Every verdict with its severity; "Valid" if there is none. */
export function VerdictList({ verdicts }: { verdicts: readonly VerdictEntry[] }) {
  if (verdicts.length === 0) return <p>✓ Valid.</p>;
  return (
    <ul class="verdict-list">
      {verdicts.map((verdict) => (
        <li key={verdict.code + verdict.message}>
          <strong>{verdict.severity}</strong>: {verdictText(verdict)}.
        </li>
      ))}
    </ul>
  );
}
