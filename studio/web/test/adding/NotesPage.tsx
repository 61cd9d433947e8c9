// The browser's part of a page, as docs/architecture.md describes; the server's is tests/adding/page_example.cc.
import { signal } from "@preact/signals";
import { call } from "../../src/net/connection";
import { edit, section } from "../../src/state/document";
import { Button } from "../../src/ui/Button";
import { PageLayout } from "../../src/ui/PageLayout";
import { Panel } from "../../src/ui/Panel";
import { TextField } from "../../src/ui/TextField";

/** The page's section of the document. */
export interface NotesSection {
  text: string;
}

const notes = section<NotesSection>("notes");
const words = signal<number | null>(null);

async function count(): Promise<void> {
  words.value = (await call<{ words: number }>("notes.count")).words;
}

/** A note on the scanned object. */
export default function NotesPage() {
  return (
    <PageLayout title="Notes">
      <Panel title="Note" actions={<Button onClick={count}>Count words</Button>}>
        <TextField label="Text" value={notes.value.text} onChange={(text) => edit("/notes/text", text, "write a note")} />
        {words.value !== null && <p>{words.value} words</p>}
      </Panel>
    </PageLayout>
  );
}
