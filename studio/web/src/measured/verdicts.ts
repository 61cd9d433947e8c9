/** One judgement of a result, as result.json has it (docs/verdicts.md). */
export interface VerdictEntry {
  code: string;
  severity: "invalid" | "limited" | "note";
  message: string;
  remedy: string;
}

interface Judged {
  trustworthy?: boolean;
  verdict?: string;
  verdicts?: VerdictEntry[];
}

/** The list of a result. One written before there were lists has its sentence as the only entry. */
export function verdictsOf({ trustworthy, verdict, verdicts }: Judged): VerdictEntry[] {
  if (verdicts) return verdicts;
  return trustworthy ? [] : [{ code: "", severity: "invalid", message: verdict ?? "", remedy: "" }];
}

/** The worst of the list decides; notes change nothing. */
export function verdictWord(verdicts: readonly VerdictEntry[]): "valid" | "limited" | "invalid" {
  if (verdicts.some(({ severity }) => severity === "invalid")) return "invalid";
  return verdicts.some(({ severity }) => severity === "limited") ? "limited" : "valid";
}

/** "message; remedy", as the command line prints it. */
export const verdictText = ({ message, remedy }: VerdictEntry): string => (remedy ? `${message}; ${remedy}` : message);
